#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/json/json_value.hpp"
#include "formats/step/drawing.hpp"

namespace fitgauge::step {

struct ChangedLimits {
  std::string name{};
  std::string before{};  ///< `nominal_mm 35, upper_um 200, lower_um 0`
  std::string after{};
};

/// A plan that was made of a drawing, and what its characteristics have that those before had not.
struct DrawnPlan {
  std::string text{};  ///< JSON
  std::string digest{};
  std::uint64_t characteristics = 0;
  std::vector<std::string> added{};
  std::vector<std::string> gone{};
  std::vector<ChangedLimits> changed{};
  std::vector<NotRead> not_read{};
};

void members(auto& v, const ChangedLimits& change) {
  v.member("name", change.name, "Of the characteristic");
  v.member("before", change.before, "Its limits in the plan that is replaced");
  v.member("after", change.after, "Its limits in the drawing");
}
void members(auto& v, const DrawnPlan& plan) {
  v.member("digest", plan.digest, "SHA-256 of the file, which the plan keeps");
  v.member("characteristics", plan.characteristics, "How many the plan has");
  v.member("added", plan.added, api::List<std::string, api::Text>{},
           "Names that the plan before had not");
  v.member("gone", plan.gone, api::List<std::string, api::Text>{},
           "Names of drawn ones that the drawing has not");
  v.member("changed", plan.changed, "Other limits under the same name");
  v.member("not_read", plan.not_read, "What stands in the file and is not in the plan");
}

/// Each size becomes the characteristic of its name. What people gave that one (gauge, rule,
/// sample, reaction) stays; characteristics that came from no drawing stay behind those of the
/// drawing.
/// @param before the plan of the part; null if there is none
/// @errors DrawingNoSizes.
Result<DrawnPlan> plan_of(const Drawing& drawing, std::string_view part, const JsonValue* before);

}  // namespace fitgauge::step
