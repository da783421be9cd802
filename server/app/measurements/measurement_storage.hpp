#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/log/leaf.hpp"
#include "app/measurements/measurement.hpp"
#include "store/stores.hpp"

namespace fitgauge::app {

class Origins;
class Rendering;
class TableCatalog;

/// So many that their rows stay in the cache.
inline constexpr std::size_t kRowsAtATime = 128;

/// Gives measurements the numbers of the revisions that have judged them, before they are stored.
void number_revisions(std::span<Measurement> measurements, const TableCatalog& tables);

/// Gives the measurements their ids. @returns the next id.
std::int64_t number_from(std::int64_t first, std::string_view origin,
                         std::span<Measurement> measurements);

/// Adds the rows that store the measurements, which have their ids; the rows' texts are theirs.
void append_rows(std::vector<store::MeasurementRow>& rows,
                 std::span<const Measurement> measurements, LeafMaker& leaves);

/// Numbers and stores measurements.
/// @param rendering takes them, if there is one. @returns the id of the first.
/// @errors MeasurementUnknown and MeasurementCorrected of a correction.
Result<std::int64_t> append(store::Stores& stores, std::span<Measurement> measurements,
                            std::string_view origin, Rendering* rendering = nullptr);

/// The row of a measurement in this folder, none where there is no such.
std::optional<std::int64_t> row_of(const store::Stores& stores, const RecordName& name);

/// The same of one that is there. @errors MeasurementUnknown.
Result<std::int64_t> existing_row_of(const store::Stores& stores, const RecordName& name,
                                     const Origins& origins);

Error unknown_measurement(const RecordName& name, const Origins& origins);

/// More waits to be stored than may.
Error too_much_work();

}  // namespace fitgauge::app
