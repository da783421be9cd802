#pragma once

#include "base/json/json_value.hpp"
#include "record/measurement_batch.hpp"

// A plan: the characteristics of a part in their order.

namespace fitgauge::api {

inline constexpr std::size_t kMostCharacteristics = 500;

/// Checks a plan and returns its stored text: `part` first, the rest as written. Every
/// characteristic must be valid for a measurement: its limits exist, its rule has its numbers, its
/// name is unique.
/// @errors RequestInvalid with every bad field.
Result<std::string> read_plan(const JsonValue& body, std::string_view part,
                              const BatchContext& context);

/// The entry of a stored plan in a list.
struct PlanHead {
  std::string name;  ///< empty without one
  std::size_t characteristics = 0;
};
/// @errors StorageCorrupt.
Result<PlanHead> read_plan_head(std::string_view text);

}  // namespace fitgauge::api
