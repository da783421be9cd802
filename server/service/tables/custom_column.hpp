#pragma once

#include <vector>

#include "base/json/json_value.hpp"
#include "base/json/json_writer.hpp"
#include "base/result.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::api {

/// Reads the body of a custom column: `{"rows":[{"over_mm","up_to_mm","upper_um","lower_um"}]}`.
/// @errors RequestInvalid with every bad field.
Result<std::vector<iso286::CustomRow>> decode_custom_rows(const JsonValue& body);

/// Writes `[{"over_mm","up_to_mm","upper_um","lower_um"}]`.
void write_custom_rows(JsonWriter& json, const std::vector<iso286::CustomRow>& rows);

}  // namespace fitgauge::api
