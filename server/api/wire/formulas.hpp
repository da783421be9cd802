#pragma once

#include <span>
#include <string_view>

#include "base/json/json_writer.hpp"

namespace fitgauge::api {

/// What an answer was computed by, and where that is from. docs/reference/statistics.md has all of
/// them with their conditions.
struct Formula {
  std::string_view of;
  std::string_view formula;
  std::string_view clause;
};
std::span<const Formula> formulas();

/// Writes the members `formula` and `clause`. @param of a name in formulas(); another is a bug
void write_formula(JsonWriter& json, std::string_view of);

}  // namespace fitgauge::api
