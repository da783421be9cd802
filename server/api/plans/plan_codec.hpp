#pragma once

#include <string>
#include <string_view>

#include "base/json/json_value.hpp"
#include "record/measurement_batch.hpp"

// A plan: what is measured at a part, in order.

namespace fitgauge::api {

inline constexpr std::size_t kMostCharacteristics = 500;

/// Checks a plan and gives the text it is stored and answered as: `part` first, the rest as
/// written. Every characteristic is one a measurement could have: its limits exist, its rule has
/// what it needs, its name is its own.
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
