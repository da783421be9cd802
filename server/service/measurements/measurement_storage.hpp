#pragma once

#include "db/store/stores.hpp"
#include "service/log/leaves.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::app {

/// @pre a measurement with a table revision also has the number of this revision
MeasurementRow to_store(const Measurement& measurement);

/// Outside names of the numbers in a row; valid as long as the catalog and the origins.
struct RowNames {
  std::function<std::string_view(std::int64_t number)> revision_id;
  /// The digits of the id that this number of an origin has.
  std::function<std::string_view(std::int64_t origin, std::int64_t number)> origin;
};
RowNames row_names(const TableCatalog& tables, const Origins& origins);
Measurement from_store(const MeasurementRow& row, const RowNames& names);

store::IdempotentRequest to_store(const IdempotencyScope& scope);

/// Few enough that their rows stay in the processor's cache.
inline constexpr std::size_t kRowsAtATime = 128;

/// Sets in each measurement the number of the table revision that judged it, before it is stored.
void number_revisions(std::span<Measurement> measurements, const TableCatalog& tables);

/// Gives the measurements their ids. @returns the next id.
std::int64_t number_from(std::int64_t first, std::string_view origin,
                         std::span<Measurement> measurements);

/// Adds a row for each measurement. @pre they have their ids. The rows view their texts.
void append_rows(std::vector<MeasurementRow>& rows, std::span<const Measurement> measurements,
                 LeafMaker& leaves);

/// Numbers and stores measurements.
/// @param rendering receives them, if there is one. @returns the id of the first.
/// @errors MeasurementUnknown and MeasurementCorrected of a correction.
Result<std::int64_t> append(Stores& stores, std::span<Measurement> measurements,
                            std::string_view origin, Rendering* rendering = nullptr);

/// The row of a measurement in this folder; none when there is no such measurement.
std::optional<std::int64_t> row_of(const Stores& stores, const RecordName& name);

/// Finds a row that must exist. @errors MeasurementUnknown.
Result<std::int64_t> existing_row_of(const Stores& stores, const RecordName& name,
                                     const Origins& origins);

Error unknown_measurement(const RecordName& name, const Origins& origins);

/// The error when the queue of writes is full.
Error too_much_work();

// Notes as rows of this folder; the service calls these in its jobs.

/// Stores a note on a row with a new id, and its event.
/// @param there name and id of a note that a station has forwarded
void append_note(Stores& stores, std::int64_t row, const Origins& origins, Note& note,
                 std::int64_t now_ns, const RecordName& there = {});

/// @param measurement the id of its record
Note from_store(store::Note&& note, const std::string& measurement, const Origins& origins);

/// The notes of a row, oldest first. @param measurement as from_store() has it
std::vector<Note> notes_of(const Stores& stores, std::int64_t row, const std::string& measurement,
                           const Origins& origins);

}  // namespace fitgauge::app
