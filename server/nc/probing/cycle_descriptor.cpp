#include "nc/probing/cycle_descriptor.hpp"

#include <algorithm>
#include <array>

namespace fitgauge::probing {
namespace {

bool is_limited(const ValueRange& range) {
  const ValueRange any;
  return range.min != any.min || range.max != any.max;
}

}  // namespace

std::string_view word(CycleKind kind) {
  switch (kind) {
    case CycleKind::Measuring: return "measuring";
    case CycleKind::Preset: return "preset";
    case CycleKind::Alignment: return "alignment";
    case CycleKind::Calibration: return "calibration";
    case CycleKind::Kinematics: return "kinematics";
    case CycleKind::Tool: return "tool";
    case CycleKind::Machining: return "machining";
    case CycleKind::Other: return "other";
  }
  return {};
}

std::string_view symbol(Unit unit) {
  switch (unit) {
    case Unit::None: return "";
    case Unit::Length: return "mm";
    case Unit::Angle: return "deg";
    case Unit::Feed: return "mm/min";
  }
  return {};
}

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
