#pragma once

#include <string>

#include "api/runs/setup_fields.hpp"
#include "base/json/field_reader.hpp"
#include "nc/run/interpreter.hpp"

namespace fitgauge::api {

/// Names `m_functions` and `cycles`, which decode_builder reads.
void name_builder_actions(SetupFields& fields);
/// Names `decimal_separator` and `fn16_default_path`, which decode_builder reads.
void name_printing(SetupFields& fields);

/// What of a setup belongs to the run and not to the machine: `m_functions` and `cycles` of the
/// machine builder, the `decimal_separator` of FN 15 and the `fn16_default_path`. The tables stand
/// in the setup, or below its `machine`. What cannot be accepted goes to `errors`.
void decode_builder(const JsonValue& setup, const std::string& pointer,
                    interpreter::RunOptions& options, FieldErrors& errors);

}  // namespace fitgauge::api
