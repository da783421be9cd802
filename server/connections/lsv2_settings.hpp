#pragma once

#include "api/wire/field_reader.hpp"
#include "connections/definition.hpp"

namespace fitgauge::connections {

/// Reads what the kind lsv2 takes: `address`, `paths`, `machine`, `interval_s`, and `patterns`,
/// each
/// `{"file","text"}`. What is wrong goes to `errors`.
void read_lsv2(api::FieldReader& fields, api::FieldErrors& errors, Definition& into);

}  // namespace fitgauge::connections
