#pragma once

#include <string_view>

#include "api/wire/json_writer.hpp"
#include "iso286/tolerance_tables.hpp"

namespace fitgauge::api {

/// Writes the members of the limits object, without its braces, so that a verdict can go on after
/// them.
void write_limits_members(JsonWriter& json, const iso286::LimitsOfSize& limits,
                          const iso286::ToleranceTables& tables);

/// The limits object.
void write_limits(JsonWriter& json, const iso286::LimitsOfSize& limits,
                  const iso286::ToleranceTables& tables);

/// `25 H7`
std::string designation_text(Length nominal_size, std::string_view class_name);

/// The entity tag of what is derived from the tables: it changes with their revision.
std::string etag_of(const iso286::ToleranceTables& tables);

}  // namespace fitgauge::api
