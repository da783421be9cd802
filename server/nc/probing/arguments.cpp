#include "nc/probing/arguments.hpp"

#include <cassert>

#include "base/result.hpp"

namespace fitgauge::probing {
namespace {

CycleResult<void> check_number(const CycleParameter& parameter, double value) {
  const auto said = [&] { return fmt::format("{} = {}", name(parameter), value); };
  if (parameter.is_text()) return nc_error(1011, said() + " must be a text in quotes");
  if (parameter.kind == ValueKind::NumberOrMax && std::isinf(value) && value > 0) return {};
  if (!std::isfinite(value)) return nc_error(1011, said() + " is not a finite number");
  if (!parameter.range.contains(value)) {
    return nc_error(1004, fmt::format("{} is not in {} to {}", said(), parameter.range.min,
                                      parameter.range.max));
  }
  if (parameter.kind == ValueKind::Whole && value != std::nearbyint(value)) {
    return nc_error(1011, said() + " must be a whole number");
  }
  return {};
}

}  // namespace

CycleResult<void> check(const CycleParameter& parameter, const ArgumentValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return check_number(parameter, *number);
  if (std::holds_alternative<std::string>(value)) {
    if (parameter.takes_text()) return {};
    return nc_error(1011, name(parameter) + " must be a number");
  }
  if (parameter.required && !parameter.default_value) {
    return nc_error(1017, fmt::format("{} {} is missing", name(parameter), parameter.meaning));
  }
  return {};
}

std::size_t Arguments::index(ParameterId id) const {
  const CycleParameter* found = descriptor_->find(id);
  assert(found != nullptr);
  return static_cast<std::size_t>(found - descriptor_->parameters.data());
}

void Arguments::set(ParameterId id, ArgumentValue value) { values_[index(id)] = std::move(value); }

CycleResult<void> Arguments::complete() {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const CycleParameter& parameter = descriptor_->parameters[i];
    ArgumentValue& value = values_[i];
    if (std::holds_alternative<std::monostate>(value) && parameter.default_value) {
      value = *parameter.default_value;
    }
    TRY(check(parameter, value));
  }
  return {};
}

double Arguments::number(ParameterId id) const { return std::get<double>(values_[index(id)]); }

double Arguments::number_or(int parameter, double fallback) const {
  return descriptor_->find(q(parameter)) == nullptr ? fallback : number(parameter);
}

bool Arguments::has_number(ParameterId id) const {
  return std::holds_alternative<double>(values_[index(id)]);
}

const std::string* Arguments::text(ParameterId id) const {
  return std::get_if<std::string>(&values_[index(id)]);
}

}  // namespace fitgauge::probing
