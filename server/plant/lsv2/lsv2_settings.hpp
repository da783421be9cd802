#pragma once

#include "base/json/field_reader.hpp"
#include "plant/lsv2/collector_options.hpp"

namespace fitgauge::connections {

/// Reads what the kind lsv2 takes: `address`, `paths`, `machine`, `interval_s`, and `patterns`,
/// each
/// `{"file","text"}`. What is wrong goes to `errors`.
MachineOptions read_lsv2(std::string_view name, api::FieldReader& fields, api::FieldErrors& errors);

}  // namespace fitgauge::connections
