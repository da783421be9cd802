#include "service/measurements/measurement_storage.hpp"

#include "record/note.hpp"
#include "record/verdict_codec.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

template <class T>
std::optional<std::int64_t> count_of(const std::optional<T>& length) {
  return length ? std::optional(length->count()) : std::nullopt;
}

std::optional<Length> length_of(std::optional<std::int64_t> nanometres) {
  return nanometres ? std::optional(Length::nanometres(*nanometres)) : std::nullopt;
}

iso286::NominalSizeRange range_of(std::int64_t over_nm, std::int64_t up_to_nm) {
  return {.over = Length::nanometres(over_nm), .up_to = Length::nanometres(up_to_nm)};
}

/// The rule of a row. @throws boost::system::system_error for numbers that no rule has.
gauging::DecisionRule rule_of(const MeasurementRow& row) {
  if (row.rule == store::Rule::Simple) return {};
  const bool is_guarded = row.rule == store::Rule::GuardBand;
  return api::make_rule({.kind = row.rule,
                         .standard_uncertainty = length_of(row.uncertainty_nm.value_or(0)),
                         .coverage_millionths = is_guarded ? row.coverage_factor : std::nullopt,
                         .probability_millionths = row.probability,
                         .degrees_of_freedom = row.degrees_of_freedom,
                         .added_uncertainty = row.added_uncertainty})
      .value();
}

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

store::IdempotentRequest to_store(const IdempotencyScope& scope) {
  return {.caller = scope.caller,
          .method = scope.method,
          .path = scope.path,
          .key = scope.key,
          .body = sha256(scope.body),
          .is_kept_for_ever = scope.is_kept_for_ever};
}

RowNames row_names(const TableCatalog& tables, const Origins& origins) {
  return {.revision_id = [&tables](std::int64_t number) { return tables.revision_id(number); },
          .origin = [&origins](std::int64_t origin,
                               std::int64_t number) { return origins.digits(origin, number); }};
}

MeasurementRow to_store(const Measurement& m) {
  MeasurementRow row;
  static_cast<MeasurementFields&>(row) = m;
  row.id = m.id;
  row.measured_at_ns = m.measured_at.nanoseconds;
  row.received_at_ns = m.received_at.nanoseconds;
  row.nominal_nm = m.nominal_size.count();
  row.tolerance_class = m.class_name;
  row.upper_deviation_nm = m.deviations.upper.count();
  row.lower_deviation_nm = m.deviations.lower.count();
  if (m.size_range) {
    row.size_over_nm = m.size_range->over.count();
    row.size_up_to_nm = m.size_range->up_to.count();
  }
  row.table_revision = m.revision_number;
  row.measured_nm = m.measured.count();
  row.verdict = m.result.verdict;
  row.rule = m.rule.kind();
  row.uncertainty_nm = count_of(m.standard_uncertainty);
  if (m.coverage_factor) row.coverage_factor = m.coverage_factor->millionths();
  if (m.conformance) {
    row.probability = m.rule.probability().millionths();
    row.conformance = m.conformance->probability;
    row.guard_band = m.conformance->guard_band;
  }
  row.corrected_nm = count_of(m.corrected);
  row.correction_of = m.correction_of;
  if (m.corrected_elsewhere) {
    row.correction_of = m.corrected_elsewhere->row;
    row.corrected_origin = m.corrected_elsewhere->origin;
    row.corrected_number = m.correction_of;
  }
  return row;
}

Measurement from_store(const MeasurementRow& row, const RowNames& names) {
  Measurement m;
  static_cast<MeasurementFields&>(m) = row;
  m.id = row.public_number();
  m.origin_number = row.origin.value_or(0);
  m.origin = names.origin(m.origin_number, m.id);
  m.row = row.id;
  m.measured_at = {row.measured_at_ns};
  m.received_at = {row.received_at_ns};
  m.nominal_size = Length::nanometres(row.nominal_nm);
  m.class_name = row.tolerance_class;
  m.deviations = {.upper = Length::nanometres(row.upper_deviation_nm),
                  .lower = Length::nanometres(row.lower_deviation_nm)};
  if (row.size_over_nm && row.size_up_to_nm) {
    m.size_range = range_of(*row.size_over_nm, *row.size_up_to_nm);
  }
  m.revision_number = row.table_revision;
  if (row.table_revision) m.table_revision = names.revision_id(*row.table_revision);
  m.measured = Length::nanometres(row.measured_nm);
  m.standard_uncertainty = length_of(row.uncertainty_nm);
  if (row.coverage_factor) {
    m.coverage_factor = gauging::CoverageFactor::from_millionths(*row.coverage_factor).value();
  }
  m.rule = rule_of(row);
  m.corrected = length_of(row.corrected_nm);
  m.result = gauging::gauge(m.feature, m.upper_limit(), m.lower_limit(), m.decisive());
  m.result.verdict = row.verdict;  // the excess is not stored
  if (row.conformance && row.guard_band) {
    m.conformance = {.probability = *row.conformance, .guard_band = *row.guard_band};
  }
  m.correction_of = row.corrected_number ? row.corrected_number : row.correction_of;
  if (row.corrected_origin && row.correction_of) {
    m.corrected_elsewhere = {.row = *row.correction_of,
                             .origin = *row.corrected_origin,
                             .digits = names.origin(*row.corrected_origin, *m.correction_of)};
  }
  return m;
}

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
