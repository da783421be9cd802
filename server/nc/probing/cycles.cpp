#include "nc/probing/cycles.hpp"

#include <cassert>

#include "log_templates.hpp"

namespace fitgauge::probing {
namespace {

bool is_limited(const ValueRange& range) {
  const ValueRange any;
  return range.min != any.min || range.max != any.max;
}

CycleResult<void> check_number(const CycleParameter& parameter, double value) {
  const auto said = [&] { return fmt::format("{} = {}", name(parameter), value); };
  if (parameter.is_text()) return nc_error(1011, said() + " must be a text in quotes");
  if (parameter.kind == ValueKind::NumberOrMax && std::isinf(value) && value > 0) return {};
  if (!std::isfinite(value)) return nc_error(1011, said() + " is not a finite number");
  if (!parameter.range.contains(value)) {
    return nc_error(1004, "{} is not in {} to {}", said(), parameter.range.min,
                    parameter.range.max);
  }
  if (parameter.kind == ValueKind::Whole && value != std::nearbyint(value))
    return nc_error(1011, said() + " must be a whole number");
  return {};
}

}  // namespace

std::string_view word(CycleKind kind) {
  return word_of(kind, {"measuring", "preset", "alignment", "calibration", "kinematics", "tool",
                        "machining", "other"});
}

std::string_view symbol(Unit unit) { return word_of(unit, {"", "mm", "deg", "mm/min"}); }

std::string name(const CycleParameter& parameter) {
  const auto id = static_cast<int>(parameter.id);
  if (is_word(parameter.id)) {
    return std::string(
        word_of(id - static_cast<int>(ParameterId::WordResult),
                {"Q", "axis", "direction", "X", "Y", "Z", "ANGLE", "ABST", "F", "MB",
                 "REFERENCE SYSTEM", "ERRORMODE", "CHECK", "HEIGHT", "PROBING THE TEETH"}));
  }
  return (parameter.is_text() ? "QS" : "Q") + std::to_string(id);
}

const CycleParameter* CycleDescriptor::find(ParameterId id) const {
  const auto found = std::ranges::find(parameters, id, &CycleParameter::id);
  return found == parameters.end() ? nullptr : &*found;
}

std::set<int> errors_of(const CycleDescriptor& cycle) {
  std::set<int> errors;
  for (const CycleParameter& parameter : cycle.parameters) {
    if (is_limited(parameter.range)) errors.insert(1004);
    if (parameter.kind == ValueKind::Whole && !cycle.dotted) errors.insert(1011);
  }
  for (int number = 1000; number < 1128; ++number) {
    if (cycle.errors.contains(number)) errors.insert(number);
  }
  return errors;
}

CycleResult<void> check(const CycleParameter& parameter, const ArgumentValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return check_number(parameter, *number);
  if (std::holds_alternative<std::string>(value)) {
    if (parameter.takes_text()) return {};
    return nc_error(1011, name(parameter) + " must be a number");
  }
  if (parameter.required && !parameter.default_value)
    return nc_error(1017, "{} {} is missing", name(parameter), parameter.meaning);
  return {};
}

CycleResult<void> check_amount(const CycleParameter& parameter, double value) {
  const ValueRange& range = parameter.range;
  if (std::abs(value) >= range.least) return {};
  if (parameter.unit == Unit::Angle) return nc_error(value == 0 ? 1066 : 1067);
  if (range.max == 1) return nc_error(1042, "{} must be -1 or +1", name(parameter));
  return nc_error(1042, "{} must be {} to {} without 0", name(parameter), range.min, range.max);
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
    if (std::holds_alternative<std::monostate>(value) && parameter.default_value)
      value = *parameter.default_value;
    TRY(check(parameter, value));
    if (const auto* number = std::get_if<double>(&value)) TRY(check_amount(parameter, *number));
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

std::string_view error_text(int number) {
  constexpr int kFirst = 1000;
  constexpr std::string_view kTexts = templates::error_texts::all;
  static_assert(std::ranges::count(kTexts, '\n') == 110, "the errors 1000 to 1109");
  std::string_view rest = kTexts;
  for (int at = kFirst; at < number && !rest.empty(); ++at)
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  return number < kFirst ? std::string_view() : rest.substr(0, rest.find('\n'));
}

CycleFault nc_error(int number, std::string_view detail) {
  std::string text(error_text(number));
  if (!detail.empty()) text += fmt::format(": {}", detail);
  return {machine::FaultKind::Error, number, std::move(text)};
}

CycleFault tolerance_stop(int number) {
  return {machine::FaultKind::Stop, number, std::string(error_text(number))};
}

std::span<const TouchProbeCycle* const> cycles() {
  static const std::vector<const TouchProbeCycle*> kCycles = [] {
    std::vector<const TouchProbeCycle*> all;
    for (const auto& file :
         {kAlignmentCycles, kCalibrationCycles, kDottedCycles, kKinematicsCycles, kObjectCycles,
          kOtherCycles, kPresetCycles, kProbing3dCycles, kSizeCycles, kToolCycles}) {
      for (const TouchProbeCycle& cycle : file) all.push_back(&cycle);
    }
    std::ranges::sort(all, {}, [](const TouchProbeCycle* cycle) {
      return std::pair(cycle->descriptor.family == CycleFamily::CyclDef, cycle->descriptor.number);
    });
    return all;
  }();
  return kCycles;
}

const TouchProbeCycle* find_cycle(CycleFamily family, int number) {
  const auto found = std::ranges::find_if(cycles(), [&](const TouchProbeCycle* cycle) {
    return cycle->descriptor.family == family && cycle->descriptor.number == number;
  });
  return found == cycles().end() ? nullptr : *found;
}

CycleResult<void> run_cycle(const TouchProbeCycle& cycle, Arguments arguments,
                            machine::Machine& machine, CycleHost& host) {
  TRY(arguments.complete());
  if (cycle.check != nullptr) TRY(cycle.check(arguments));
  auto done = cycle.execute({std::move(arguments), machine, host});
  assert(done || done.error().number == 0 ||
         errors_of(cycle.descriptor).contains(done.error().number));
  return done;
}

}  // namespace fitgauge::probing
