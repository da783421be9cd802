#pragma once

#include <string_view>

#include "api/wire/text_arena.hpp"
#include "app/measurements/measurement.hpp"
#include "base/json_value.hpp"
#include "base/result.hpp"

namespace fitgauge::api {

/// Reads the record of a measurement, as RecordWriter writes it, back into the measurement: what it
/// corrects is named by `correction_of` and the digits of `corrected_elsewhere`. Members that
/// follow from others are skipped: whoever wants to know that the text was read whole writes it
/// again.
/// @param texts keeps what the measurement has views of.
/// @errors LogRecordInvalid.
Result<app::Measurement> read_record(const JsonValue& record, TextArena& texts);

}  // namespace fitgauge::api
