#pragma once

#include "base/json/body_forms.hpp"

namespace fitgauge::api {

/// The formula of an answer and its source. docs/reference/statistics.md has all.
struct Formula {
  std::string_view of;
  std::string_view formula;
  std::string_view clause;
};

/// @param of its name; another is a bug
const Formula& formula_of(std::string_view of);

/// Writes the members `formula` and `clause`.
void write_formula(JsonWriter& json, std::string_view of);

/// Describes these members of a body.
void formula_members(auto& v, std::string_view of) {
  v.member("formula", formula_of(of).formula, "Computed figures");
  v.member("clause", formula_of(of).clause, "Source of the figure");
}

}  // namespace fitgauge::api
