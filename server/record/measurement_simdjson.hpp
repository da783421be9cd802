#pragma once

#include <string_view>

#include "record/measurement_batch.hpp"
#include "record/measurement_row_reader.hpp"

namespace fitgauge::api {

// The fast way into a batch, for plain well-formed JSON. It takes no key with an escape, no nested
// value and no duplicate key, and is strict where simdjson's on-demand reading is not (it hands out
// number tokens unchecked). Where it returns false, the exact reader decides what is wrong, so both
// accept the same texts.

/// Reads a whole body: an object or an array of objects. False may leave rows in the batch.
/// @param body followed by http::Request::kBodyPadding readable bytes.
bool read_body_fast(std::string_view body, const BatchContext& context, MeasurementBatch& batch,
                    FieldErrors& errors);

/// Reads one object into one row, after reader.begin(); false leaves the batch as it was.
/// @param object followed by as many readable bytes, as above.
bool read_object_fast(std::string_view object, MeasurementRowReader& reader,
                      MeasurementBatch& batch);

}  // namespace fitgauge::api
