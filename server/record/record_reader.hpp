#pragma once

#include <string_view>

#include "base/json/json_value.hpp"
#include "base/json/text_arena.hpp"
#include "base/result.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {

/// Reads the record of a measurement, as RecordWriter writes it, back into the measurement: what it
/// corrects is named by `correction_of` and the digits of `corrected_elsewhere`. Members that
/// follow from others are skipped: whoever wants to know that the text was read whole writes it
/// again.
/// @param texts keeps what the measurement has views of.
/// @errors LogRecordInvalid.
Result<app::Measurement> read_record(const JsonValue& record, TextArena& texts);

}  // namespace fitgauge::api
