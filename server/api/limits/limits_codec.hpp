#pragma once

#include "base/json/json_writer.hpp"
#include "http/response.hpp"
#include "service/measurements/measurement_service.hpp"
#include "tables/iso286/tolerance_tables.hpp"
#include "tables/standards/designated_limits.hpp"

namespace fitgauge::api {

/// Reads a designation of ISO 286, or of another standard with tables here.
/// @errors those of iso286::parse_designation and standards::limits_of.
Result<store::DesignationFilter> parse_designation(std::string_view text);

/// Writes the members of the limits object without its braces, so that a verdict can follow.
void write_limits_members(JsonWriter& json, const iso286::LimitsOfSize& limits,
                          const iso286::ToleranceTables& tables);

void write_limits_members(JsonWriter& json, const standards::DesignatedLimits& limits);

/// `25 H7`
std::string designation_text(Length nominal_size, std::string_view class_name);

/// 200 with a JSON text and its entity tag, to which the release is added: another one may compute
/// another answer of the same tables.
Response tagged_json(std::string body, std::string etag);

/// Entity tag of results from the tables: it changes with their revision.
std::string etag_of(const iso286::ToleranceTables& tables);
std::string etag_of(const standards::Standard& standard);

}  // namespace fitgauge::api
