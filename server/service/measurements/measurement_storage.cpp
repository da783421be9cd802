#include "service/measurements/measurement_storage.hpp"

#include "record/measurement.hpp"
#include "record/note.hpp"
#include "service/measurements/mapping.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

/// The store knows ids as numbers: this error names them as the outside does.
Error corrected_before(const Stores& stores, const Measurement& correction, std::int64_t row) {
  std::string newer = "one of another folder";
  stores.measurements.find(stores.measurements.replaced_by(row).value_or(0),
                           [&](const MeasurementRow& found) {
                             if (found.is_forwarded()) return;
                             newer = measurement_id_text(found.id, correction.origin);
                           });
  return {ErrorCode::MeasurementCorrected,
          fmt::format("measurement {0} was corrected by {1}: correct {1}",
                      corrected_id_text(correction), newer)};
}

}  // namespace

void number_revisions(std::span<Measurement> measurements, const TableCatalog& tables) {
  std::string_view last;
  std::optional<std::int64_t> number;
  for (Measurement& m : measurements) {
    if (m.table_revision.empty()) continue;
    if (m.table_revision != last) {
      last = m.table_revision;
      number = tables.revision_number(last);
    }
    m.revision_number = number;
  }
}

std::int64_t number_from(std::int64_t first, std::string_view origin,
                         std::span<Measurement> measurements) {
  for (Measurement& measurement : measurements) {
    measurement.id = first++;
    measurement.origin = origin;
  }
  return first;
}

void append_rows(std::vector<MeasurementRow>& rows, std::span<const Measurement> measurements,
                 LeafMaker& leaves) {
  const auto made = leaves(measurements);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    rows.push_back(to_store(measurements[i]));
    rows.back().hash = made[i];
  }
}

Result<std::int64_t> append(Stores& stores, std::span<Measurement> measurements,
                            std::string_view origin, Rendering* rendering) {
  const std::int64_t first = stores.measurements.last_id() + 1;
  number_from(first, origin, measurements);
  LeafMaker leaves;
  std::vector<MeasurementRow> rows;
  while (!measurements.empty()) {
    const std::size_t count = std::min(measurements.size(), kRowsAtATime);
    rows.clear();
    append_rows(rows, measurements.first(count), leaves);
    const auto appended = stores.measurements.append(rows);
    if (!appended && appended.error().code == ErrorCode::MeasurementCorrected) {
      return corrected_before(stores, measurements.front(), *rows.front().correction_of);
    }
    if (!appended) return appended.error();
    if (rendering != nullptr) rendering->add(measurements.first(count), leaves.records());
    measurements = measurements.subspan(count);
  }
  return first;
}

std::optional<std::int64_t> row_of(const Stores& stores, const RecordName& name) {
  if (name.origin == 0) return name.number;
  return stores.measurements.find_forwarded(name.origin, name.number);
}

Result<std::int64_t> existing_row_of(const Stores& stores, const RecordName& name,
                                     const Origins& origins) {
  const auto row = row_of(stores, name);
  if (row && stores.measurements.find(*row, [](const MeasurementRow&) {})) return *row;
  return unknown_measurement(name, origins);
}

Error unknown_measurement(const RecordName& name, const Origins& origins) {
  return {ErrorCode::MeasurementUnknown,
          "measurement not found: '" +
              measurement_id_text(name.number, origins.digits(name.origin, name.number)) + "'"};
}

Error too_much_work() { return {ErrorCode::StorageBusy, "the storage is busy: try again soon"}; }

void append_note(Stores& stores, std::int64_t row, const Origins& origins, Note& note,
                 std::int64_t now_ns, const RecordName& there) {
  const std::int64_t id = stores.notes.append({.measurement = row,
                                               .cause = note.cause,
                                               .measure = note.measure,
                                               .text = note.text,
                                               .operator_id = note.operator_id,
                                               .caller = note.caller,
                                               .received_at_ns = note.received_at.nanoseconds,
                                               .origin = there.origin,
                                               .number = there.number});
  if (there.origin == 0) note.id = note_id_text(id, origins.own(Counted::Note, id));
  stores.events.append("note.added", api::body_json(note), now_ns);
}

Note from_store(store::Note&& note, const std::string& measurement, const Origins& origins) {
  const std::int64_t number = note.origin == 0 ? note.id : note.number;
  return {.id = note_id_text(number, origins.digits(note.origin, number, Counted::Note)),
          .measurement = measurement,
          .cause = std::move(note.cause),
          .measure = std::move(note.measure),
          .text = std::move(note.text),
          .operator_id = std::move(note.operator_id),
          .caller = std::move(note.caller),
          .received_at = {note.received_at_ns}};
}

std::vector<Note> notes_of(const Stores& stores, std::int64_t row, const std::string& measurement,
                           const Origins& origins) {
  std::vector<Note> notes;
  for (store::Note& note : stores.notes.list(row)) {
    notes.push_back(from_store(std::move(note), measurement, origins));
  }
  return notes;
}

}  // namespace fitgauge::app
