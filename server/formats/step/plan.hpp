#pragma once

#include "base/json/json_value.hpp"
#include "formats/step/drawing.hpp"

namespace fitgauge::step {

/// A plan that was made from a drawing, with the differences of its characteristics from the stored
/// plan.
struct DrawnPlan {
  std::string text{};  ///< JSON
  std::string digest{};
  std::uint64_t characteristics = 0;
  Comparison compared{};
  std::vector<NotRead> not_read{};
};

void members(auto& v, const DrawnPlan& plan) {
  v.member("digest", plan.digest, "SHA-256 of the file, which the plan keeps");
  v.member("characteristics", plan.characteristics, "Number of characteristics of the plan");
  comparison_members(v, plan.compared);
  v.member("not_read", plan.not_read, "Content of the file that is not in the plan");
}

/// Makes each size a characteristic with its name. Settings of people for that name (gauge, rule,
/// sample, reaction) stay; characteristics without a drawing stay after the drawing's.
/// @param before the plan of the part; null if there is none
/// @errors DrawingNoSizes.
Result<DrawnPlan> plan_of(const Drawing& drawing, std::string_view part, const JsonValue* before);

}  // namespace fitgauge::step
