#pragma once

#include <string>

#include "api/wire/field_reader.hpp"
#include "run/interpreter.hpp"

namespace fitgauge::api {

/// What of a setup belongs to the run and not to the machine: `m_functions` and `cycles` of the
/// machine builder, and the `decimal_separator` of FN 15. The tables stand in the setup, or below
/// its `machine`. What cannot be accepted goes to `errors`.
void decode_builder(const JsonValue& setup, const std::string& pointer,
                    interpreter::RunOptions& options, FieldErrors& errors);

}  // namespace fitgauge::api
