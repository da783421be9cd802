#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/measurements/measurement.hpp"
#include "store/measurement_row.hpp"

namespace fitgauge::app {

class TableCatalog;

/// The number of the revision that has judged measurements of one request, which is the same for
/// all; none when all have explicit limits.
std::optional<std::int64_t> revision_of(std::span<const Measurement> measurements,
                                        const TableCatalog& tables);

/// Adds the rows that store the measurements; their texts are those of the measurements.
void append_rows(std::vector<store::MeasurementRow>& rows,
                 std::span<const Measurement> measurements, std::optional<std::int64_t> revision);

/// Gives the measurements their ids. @returns the next id.
std::int64_t number_from(std::int64_t first, std::span<Measurement> measurements);

/// More waits to be stored than may.
Error too_much_work();

}  // namespace fitgauge::app
