#include "probing/cycle_errors.hpp"

#include <algorithm>
#include <initializer_list>

namespace fitgauge::probing {
namespace {

struct Range {
  int first;
  int last;
};

/// Errors, and the cycles that may end with them.
struct ErrorGroup {
  std::initializer_list<int> errors;
  std::initializer_list<Range> cycles;
};

const ErrorGroup kGroups[] = {
    // Tool axis, tool, touch probe (30 to 33, 480 to 484: none), FUNCTION MODE MILL.
    {{1001, 1092, 1093, 1097}, {{0, 4}, {30, 33}, {400, 431}, {444, 444}, {451, 484}}},
    // Nothing within reach. Cycle 4 goes on then.
    {{1014}, {{0, 3}, {30, 33}, {400, 403}, {405, 431}, {444, 444}, {451, 484}}},
    {{1007, 1008}, {{400, 403}, {405, 419}, {444, 444}, {460, 463}}},
    {{1108}, {{0, 1}, {420, 431}}},
    // Inclined coordinates, calibrated values below zero, tool data that cannot be.
    {{1075}, {{30, 33}, {460, 484}}},
    {{1080}, {{460, 463}}},
    {{1079}, {{30, 33}, {480, 484}}},
    {{1109}, {{30, 33}, {480, 484}}},
    {{1099}, {{444, 444}}},
    // Where a datum or a rotation goes.
    {{1078}, {{408, 419}}},
    {{1043}, {{403, 403}, {405, 405}, {408, 419}}},
    {{1085}, {{400, 404}, {408, 419}, {451, 451}, {453, 453}}},
    {{1019}, {{403, 403}}},
    {{1100}, {{401, 403}, {405, 405}, {451, 453}}},
    // Directions, step angles and points that contradict.
    {{1042}, {{0, 0}, {4, 4}, {400, 400}, {403, 403}, {419, 420}, {427, 427}, {444, 444}}},
    {{1066, 1067}, {{405, 405}, {412, 413}, {421, 422}}},
    {{1081}, {{400, 403}, {405, 405}, {412, 416}, {418, 418}, {420, 422}, {430, 431}}},
    // Feed and way of a touch that the block gives itself.
    {{1010, 1011}, {{3, 4}}},
    // Limits, Q309, the tool of Q330.
    {{1016, 1065}, {{421, 430}}},
    {{1044, 1045}, {{421, 424}, {430, 430}}},
    {{1046, 1047}, {{421, 421}}},
    {{1048, 1049}, {{422, 422}}},
    {{1050, 1051, 1052, 1053}, {{423, 423}}},
    {{1054, 1055, 1056, 1057}, {{424, 424}}},
    {{1058, 1059}, {{425, 425}}},
    {{1060, 1061}, {{426, 426}}},
    {{1062, 1063}, {{430, 430}}},
    {{1072}, {{427, 427}, {444, 444}, {451, 453}}},
    // Tolerance and names as text.
    {{1004, 1011}, {{444, 444}}},
    {{1011}, {{247, 247}, {450, 450}}},
    {{1017, 1096, 1097}, {{450, 450}}},
    // Rotary axes.
    {{1082, 1101}, {{451, 453}}},
    {{1102}, {{452, 452}}},
};

bool is_limited(const ValueRange& range) {
  const ValueRange any;
  return range.min != any.min || range.max != any.max;
}

}  // namespace

std::set<int> errors_of(const CycleDescriptor& cycle) {
  std::set<int> errors;
  for (const CycleParameter& parameter : cycle.parameters) {
    if (is_limited(parameter.range)) errors.insert(1004);
    if (parameter.kind == ValueKind::Whole && !cycle.dotted) errors.insert(1011);
  }
  for (const ErrorGroup& group : kGroups) {
    const bool has = std::ranges::any_of(group.cycles, [&](const Range& range) {
      return cycle.number >= range.first && cycle.number <= range.last;
    });
    if (has) errors.insert(group.errors);
  }
  return errors;
}

}  // namespace fitgauge::probing
