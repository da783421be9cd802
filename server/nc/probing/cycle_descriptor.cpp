#include "nc/probing/cycle_descriptor.hpp"

#include "base/text.hpp"

namespace fitgauge::probing {
namespace {

bool is_limited(const ValueRange& range) {
  const ValueRange any;
  return range.min != any.min || range.max != any.max;
}

}  // namespace

std::string_view word(CycleKind kind) {
  return word_of(kind, {"measuring", "preset", "alignment", "calibration", "kinematics", "tool",
                        "machining", "other"});
}

std::string_view symbol(Unit unit) { return word_of(unit, {"", "mm", "deg", "mm/min"}); }

std::string name(const CycleParameter& parameter) {
  constexpr std::array<std::string_view, 15> kWords{"Q",
                                                    "axis",
                                                    "direction",
                                                    "X",
                                                    "Y",
                                                    "Z",
                                                    "ANGLE",
                                                    "ABST",
                                                    "F",
                                                    "MB",
                                                    "REFERENCE SYSTEM",
                                                    "ERRORMODE",
                                                    "CHECK",
                                                    "HEIGHT",
                                                    "PROBING THE TEETH"};
  const auto id = static_cast<std::uint16_t>(parameter.id);
  if (is_word(parameter.id)) {
    return std::string(kWords.at(id - static_cast<std::size_t>(ParameterId::WordResult)));
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
  for (int number = ErrorSet::kFirst; number <= ErrorSet::kLast; ++number) {
    if (cycle.errors.contains(number)) errors.insert(number);
  }
  return errors;
}

}  // namespace fitgauge::probing
