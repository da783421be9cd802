#include "nc/program/cycle_arguments.hpp"

#include <limits>
#include <string>

namespace fitgauge::interpreter {

double scale_of(probing::Unit unit, bool is_inch) {
  if (!is_inch) return 1;
  switch (unit) {
    case probing::Unit::Length: return kMillimetresPerInch;
    case probing::Unit::Feed: return kMillimetresPerInch / 10;
    default: return 1;
  }
}

std::optional<probing::ArgumentValue> literal(const klartext::Program& program,
                                              const klartext::CycleParameter& written,
                                              const probing::CycleParameter& parameter) {
  switch (written.kind) {
    case klartext::CycleValue::Expression: break;
    case klartext::CycleValue::Max: return std::numeric_limits<double>::infinity();
    default: return std::nullopt;
  }
  if (const auto* number = std::get_if<double>(&written.value)) {
    const bool is_inch = program.unit() == klartext::Unit::Inch;
    return *number * scale_of(parameter.unit, is_inch);
  }
  if (const auto* text = std::get_if<klartext::Text>(&written.value)) {
    return std::string(program.text(*text));
  }
  return std::nullopt;
}

const probing::CycleParameter* find_parameter(const probing::CycleDescriptor& descriptor,
                                              klartext::QRef written) {
  if (written.space != klartext::QSpace::Q && written.space != klartext::QSpace::Qs) return nullptr;
  const auto* parameter = descriptor.find(probing::q(written.number));
  if (parameter == nullptr || !written.is_string()) return parameter;
  return parameter->takes_text() ? parameter : nullptr;
}

}  // namespace fitgauge::interpreter
