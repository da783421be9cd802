#include "api/resources.hpp"
#include "record/measurement_row_reader.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {
namespace {

using schema::Others;

std::string given_json(const RowField& field) {
  switch (field.kind) {
    case RowField::Kind::Length:
    case RowField::Kind::Decimal: return schema::exact();
    case RowField::Kind::Text: return schema::text(field.longest);
    case RowField::Kind::Time: return schema::time();
    case RowField::Kind::Feature: return feature_words();
    case RowField::Kind::Quantity: return quantity_words();
    case RowField::Kind::Rule: return schema::words({"simple", "guard_band", "conformance"});
    case RowField::Kind::Truth: return schema::boolean();
  }
  return {};
}

std::string stored_json(const RowField& field) {
  const bool is_number =
      field.kind == RowField::Kind::Length || field.kind == RowField::Kind::Decimal;
  return is_number ? schema::number() : given_json(field);
}

schema::Fields given_fields() {
  schema::Fields fields;
  for (const RowField& field : kRowFields) {
    const bool required = &field == &kRowFields[RowField::Measured];
    fields.push_back(
        {std::string(field.name), given_json(field), std::string(field.meaning), required});
  }
  return fields;
}

/// Other fields of the caller come back as they were stored.
schema::Fields echoed_fields() {
  schema::Fields fields;
  for (std::size_t i = RowField::Labels; i < RowField::Count; ++i) {
    const RowField& field = kRowFields.at(i);
    if (i == RowField::MeasuredAt) continue;
    fields.push_back(
        {std::string(field.name), stored_json(field), std::string(field.meaning), false});
  }
  return fields;
}

std::string basis_of_records() {
  return schema::words({"iso286", "custom", "explicit", "standard", "none"});
}

schema::Fields record_fields() {
  const schema::Fields origin = {
      {"id", schema::text(), "Opaque; sorts nowhere"},
      {"source", source_words(), "A gauge at a part, or a run on the simulated machine"},
      {"measured_at", schema::time(), "In UTC"},
      {"received_at", schema::time(), "In UTC"},
  };
  const schema::Fields links = schema::optional({
      {"corrected_mm", schema::number(), "At 20 degrees, where an expansion is given: it decides"},
      {"added_uncertainty_um", schema::number(),
       "Standard uncertainty that the correction adds to uncertainty_um, where one of a "
       "temperature or expansion is given; the rule decides with both"},
      {"conformance_probability", schema::number(0, 1), "Of rule conformance: to 1e-9"},
      {"guard_band_um", schema::number(), "Of rule conformance: to 1e-9"},
      {"uncertainty", schema::text(),
       "Of a gauge in use: the budget that `uncertainty_um` was taken from"},
      {"calibration_due", schema::text(),
       "Of a gauge in use whose calibration was overdue when it measured: since when"},
      {"calibration_certificate", schema::text(),
       "Of a gauge in use: the number of the calibration certificate in date when it measured"},
      {"calibration_laboratory", schema::text(), "Of a gauge in use: who calibrated it"},
      {"calibration_overdue", schema::boolean(), "True where it was; else it is not there"},
      {"quantity", quantity_words(), "What it is; absent in records of older versions"},
      {"envelope_result", schema::words({"verified", "not_verified", "failed"}),
       "Where the envelope is required: what the GO gauge says of it"},
      {"points", schema::count(), "Of a cycle: how many it touched"},
      {"start_angle_deg", schema::number(), "Of a cycle: where the first of them lies"},
      {"diameter_factor", schema::number(),
       "Of a cycle: standard deviation of the diameter over that of a touch"},
      {"form_um", schema::null_or(schema::number()),
       "Of a cycle: the form that its points show; null where they are too few"},
      {"caller", schema::text(), "Name of the key that stored the record"},
      {"run_id", schema::text(), "Of a simulation: the run"},
      {"cycle", schema::count(), "Of a simulation: the measuring cycle"},
      {"correction_of", schema::text(), "The id of the record it corrects"},
      {"reason", schema::text(), "Why it was corrected"},
      {"corrected_by", schema::text(),
       "The id of its correction; shown where one record is asked for"},
      {"conflict", schema::boolean(),
       "Another correction of the same record was made apart from this one; the later one stands"},
  });
  schema::Fields limits = limits_fields();
  for (schema::Field& field : limits) {
    // A drawing may have one of the two, a value none; a position is no hole or shaft.
    field.required = field.name == "basis";
    if (field.name == "basis") field.json = basis_of_records();
  }
  schema::Fields verdict = verdict_fields();
  for (schema::Field& field : verdict) field.required = field.name == "measured_mm";
  return origin + limits + verdict + echoed_fields() + links;
}

std::string verdict_counts() {
  return schema::object(
      {{"good", schema::count(), ""},
       {"rework", schema::count(), ""},
       {"reject", schema::count(), ""},
       {"indeterminate", schema::count(), ""},
       {"unjudged", schema::count(), "Without limits; where there are any", false}});
}

/// The field the groups are of comes first, by its own name.
schema::Fields group_fields() {
  schema::Fields fields;
  for (const std::string_view name : app::kTextFilters) {
    fields.push_back({std::string(name), schema::null_or(schema::text()),
                      "The value of the group, with group_by of this name; null: without", false});
  }
  return fields + schema::Fields{
                      {"count", schema::count(), "Values of the group"},
                      {"verdicts", schema::ref("VerdictCounts"), ""},
                      {"mean_mm", schema::number(), "To 1e-12 mm"},
                      {"standard_deviation_mm", schema::null_or(schema::number()),
                       "With n - 1; null for one value"},
                      {"min_mm", schema::number(), ""},
                      {"max_mm", schema::number(), ""},
                  };
}

void add_request_schemas(Schemas& schemas) {
  schemas.push_back({"NewMeasurement", schema::object(given_fields(), Others::Refused)});
  schemas.push_back(
      {"NewMeasurements", schema::any_of({schema::ref("NewMeasurement"),
                                          schema::array(schema::ref("NewMeasurement"), 1)})});
  const schema::Fields reason = {
      {"reason", schema::text(app::kLongestComment), "Why it is corrected"}};
  schemas.push_back({"Correction", schema::object(reason + given_fields(), Others::Refused)});
}

}  // namespace

void add_measurement_schemas(Schemas& schemas) {
  add_request_schemas(schemas);
  const schema::Fields notes = {
      {"notes", schema::array(schema::ref("Note")), "Of lists with notes=shown", false}};
  schemas.push_back({"Measurement", schema::object(record_fields() + notes + warnings_field())});
  schemas.push_back(
      {"Proof",
       schema::object({{"index", schema::count(), "Of the leaf, from 0"},
                       {"size", schema::count(), "Of the tree in the checkpoint"},
                       {"leaf", schema::text(), "SHA-256(0x00, the record in its RFC 8785 form)"},
                       {"hashes", schema::array(schema::text()),
                        "What stands beside the path to the root, from the leaf up (RFC 6962)"},
                       {"checkpoint", schema::text(), "A signed note"}})});
  schemas.push_back(
      {"LogHead", schema::object({{"size", schema::count(), "Records of the origin that are here"},
                                  {"root", schema::text(), "Of their tree, in base64"}})});
  const std::string column_row =
      schema::object({{"over_mm", schema::number(), ""},
                      {"up_to_mm", schema::number(), ""},
                      {"upper_um", schema::number(), "The upper deviation"},
                      {"lower_um", schema::number(), "The lower deviation"}});
  const std::string column =
      schema::object({{"feature", schema::words({"hole", "shaft"}), "Which table it is in"},
                      {"tolerance_class", schema::text(), "Its name"},
                      {"rows", schema::array(column_row), "By size"}});
  schemas.push_back(
      {"Revisions",
       schema::object(
           {{"origin", schema::text(), "Of the centre: what its ids end with"},
            {"size", schema::count(), "Records of the station's log that are here"},
            {"notes", schema::count(),
             "The number in the id of the newest of the station's notes that are here; 0: none is"},
            {"position", schema::text(), "The next request names it in `after`"},
            {"more", schema::boolean(), "There is a next page"},
            {"revisions",
             schema::array(schema::object(
                 {{"number", schema::count(), "Of the change at the centre"},
                  {"kind",
                   schema::words({"tables", "key", "setup", "plan", "correction", "catalogue"}),
                   ""},
                  {"name", schema::text(), "Of the key, setup, plan or catalogue", false},
                  {"removed", schema::boolean(), "It was deleted or revoked", false},
                  {"text", schema::text(), "Of the setup, plan or catalogue, as it was stored",
                   false},
                  {"table_revision", schema::text(), "Of tables: as records name it", false},
                  {"columns", schema::array(column), "The shop's own", false},
                  {"role", schema::words({"viewer", "operator"}), "Of a key", false},
                  {"token_sha256", schema::text(), "Of a key, in hexadecimal", false},
                  {"place", schema::count(), "Of a correction in the centre's log", false},
                  {"record", schema::text(), "Of a correction, as it was answered", false}})),
             "In the order of their numbers, of each thing the last"}})});
  schemas.push_back({"VerdictCounts", verdict_counts()});
  const std::string gauge = schema::object(
      {{"name", schema::text(), ""},
       {"calibration_due", schema::text(), "Of one that was overdue: since when", false},
       {"calibration_certificate", schema::text(), "Of the one in date: its number", false},
       {"calibration_laboratory", schema::text(), "The same: who calibrated it", false},
       {"uncertainty", schema::text(), "The name of its budget", false},
       {"uncertainty_um", schema::number(), "What it came to", false}});
  schemas.push_back(
      {"Certificate",
       schema::object(
           {{"order", schema::text(), "What it is of", false},
            {"part_id", schema::text(), "What it is of", false},
            {"title", schema::text(), ""},
            {"company", schema::text(), "", false},
            {"customer", schema::text(), "", false},
            {"made_at", schema::time(), ""},
            {"count", schema::count(), "Of the measurements"},
            {"verdicts", schema::ref("VerdictCounts"), ""},
            {"parts", schema::count(), "Different part numbers"},
            {"worst_id", schema::text(),
             "Of the worst value: by its verdict, then by its place in the limits"},
            {"verdict", verdict_words(), "The worst; none if no value has limits", false},
            {"gauges", schema::array(gauge), "What the records say of them"},
            {"checkpoint", schema::text(), "The signed head of the log: a note"},
            {"measurements", schema::array(schema::ref("Measurement")), ""}})});
  schemas.push_back(
      {"Accepted",
       schema::object(schema::Fields{{"accepted", schema::count(), "How many were stored"},
                                     {"first_id", schema::text(), ""},
                                     {"last_id", schema::text(), ""},
                                     {"verdicts", schema::ref("VerdictCounts"), ""}} +
                      warnings_field())});
  schemas.push_back(
      {"Measurements",
       schema::object(
           schema::Fields{{"measurements", schema::array(schema::ref("Measurement")), ""}} +
           warnings_field())});
  schemas.push_back(
      {"Recorded", schema::any_of({schema::ref("Measurement"), schema::ref("Accepted"),
                                   schema::ref("Measurements")})});
  schemas.push_back(
      {"MeasurementList",
       schema::object(
           {{"measurements", schema::array(schema::ref("Measurement")), ""},
            {"next", schema::null_or(schema::text()), "For `after`; null on the last page"}})});
  schemas.push_back({"SummaryGroup", schema::object(group_fields())});
  schemas.push_back(
      {"Summary",
       schema::object(formula_fields() +
                      schema::Fields{{"groups", schema::array(schema::ref("SummaryGroup")),
                                      "By the value of the field that group_by names"}})});
}

}  // namespace fitgauge::api
