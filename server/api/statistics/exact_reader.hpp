#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/json/field_reader.hpp"
#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/decimals.hpp"

// Decimals of a body, exactly: JSON numbers and strings with one. What cannot be read goes to the
// FieldErrors with its pointer.

namespace fitgauge::api {

/// A member that is one decimal; none when it is absent or cannot be read.
std::optional<metrology::Exact> read_exact(FieldReader& fields, std::string_view name,
                                           bool required, FieldErrors& errors);

/// One decimal to the end of `to`; also reports what is neither a number nor a string.
void add_exact(const JsonValue& value, const std::string& pointer, metrology::Decimals& to,
               FieldErrors& errors);

/// A member that is a non-empty array of decimals.
metrology::Decimals read_values(FieldReader& fields, std::string_view name, FieldErrors& errors);

/// A member that is an array of arrays of decimals, none of them empty.
metrology::Groups read_groups(FieldReader& fields, std::string_view name, FieldErrors& errors);

/// `values`, or `subgroups` of one size.
metrology::Subgroups read_subgroups(FieldReader& fields, FieldErrors& errors);

/// Puts the error of a computation at a member, with the error's own code.
Error at_member(std::string_view name, Error error);

}  // namespace fitgauge::api
