#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.hpp"

// What fitgauge exports, taken back: what was computed is left out, and limits of a class are those
// of the class.

namespace fitgauge::sheet {

/// What an export calls the fields of a drawing's limits; a class of the tables says them as well.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kLimitsOfExport = {
    {{"feature", "feature"},
     {"upper_deviation_um", "upper_um"},
     {"lower_deviation_um", "lower_um"}}};

/// Why a record of a simulation is none of a gauge.
inline constexpr std::string_view kOfSimulation =
    "is of a simulation, and would come in as measured: export with source=gauge";

/// Appends a line of NDJSON as /v1/measurements takes it: a record of a list with the fields it was
/// recorded with, any other line as it is. @param line without its end
/// @errors CsvMalformed, without a place: it is of a simulation.
Result<void> append_as_given(std::string& out, std::string_view line);

/// Whether the name of a file says that it has records: `.ndjson`, `.jsonl`.
bool is_ndjson(std::string_view file_name);

}  // namespace fitgauge::sheet
