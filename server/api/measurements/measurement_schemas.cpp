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

/// Fields of the caller that are returned as they were stored.
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
      {"id", schema::text(), "Opaque id, without an order"},
      {"source", source_words(), "A gauge at a part, or a run on the simulated machine"},
      {"measured_at", schema::time(), "Time in UTC"},
      {"received_at", schema::time(), "Time in UTC"},
  };
  const schema::Fields links = schema::optional({
      {"corrected_mm", schema::number(),
       "Size at 20 °C if an expansion is given; the verdict uses it"},
      {"added_uncertainty_um", schema::number(),
       "Standard uncertainty that the correction adds to uncertainty_um, if an uncertainty of a "
       "temperature or expansion is given; the rule uses both"},
      {"conformance_probability", schema::number(0, 1),
       "Figure of rule conformance, exact to 1e-9"},
      {"guard_band_um", schema::number(), "Figure of rule conformance, exact to 1e-9"},
      {"uncertainty", schema::text(),
       "Name of the budget that `uncertainty_um` comes from, with a gauge in use"},
      {"calibration_due", schema::text(),
       "Due date of the gauge in use, if its calibration was overdue when it measured"},
      {"calibration_certificate", schema::text(),
       "Number of the calibration certificate that was valid when the gauge in use measured"},
      {"calibration_laboratory", schema::text(), "Laboratory that calibrated the gauge in use"},
      {"calibration_overdue", schema::boolean(), "true; absent if not"},
      {"gauge_blocked", schema::boolean(),
       "true if the gauge in use was blocked when it measured; absent if not"},
      {"quantity", quantity_words(), "Quantity; absent in records of older versions"},
      {"envelope_result", schema::words({"verified", "not_verified", "failed"}),
       "Result of the GO gauge, if the envelope is required"},
      {"points", schema::count(), "Number of points that the cycle touched"},
      {"start_angle_deg", schema::number(), "Cycle: angle of the first point"},
      {"diameter_factor", schema::number(),
       "Cycle: standard deviation of the diameter divided by that of a touch"},
      {"form_um", schema::null_or(schema::number()),
       "Cycle: form deviation of its points; null if they are too few"},
      {"caller", schema::text(), "Name of the key that stored the record"},
      {"run_id", schema::text(), "Run of a simulation"},
      {"cycle", schema::count(), "Measuring cycle of a simulation"},
      {"correction_of", schema::text(), "The id of the record it corrects"},
      {"reason", schema::text(), "Reason for the correction"},
      {"corrected_by", schema::text(),
       "The id of its correction; shown if one record is requested"},
      {"conflict", schema::boolean(),
       "Another correction of the record was made independently; the later correction counts"},
  });
  schema::Fields limits = limits_fields();
  for (schema::Field& field : limits) {
    // A drawing may have one limit, a value no limit; a position is neither hole nor shaft.
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
       {"unjudged", schema::count(), "Values without limits; absent if there are none", false}});
}

/// The field of group_by comes first, with its name.
schema::Fields group_fields() {
  schema::Fields fields;
  for (const std::string_view name : app::kTextFilters) {
    fields.push_back({std::string(name), schema::null_or(schema::text()),
                      "The value of the group, with group_by of this name; null: without", false});
  }
  return fields + schema::Fields{
                      {"count", schema::count(), "Number of values of the group"},
                      {"verdicts", schema::ref("VerdictCounts"), ""},
                      {"mean_mm", schema::number(), "Mean, to 1e-12 mm"},
                      {"standard_deviation_mm", schema::null_or(schema::number()),
                       "Standard deviation with n - 1; null for one value"},
                      {"min_mm", schema::number(), ""},
                      {"max_mm", schema::number(), ""},
                  };
}

void add_request_schemas(Schemas& schemas) {
  schemas.push_back({"NewMeasurement", schema::object(given_fields(), Others::Refused)});
  schemas.push_back(
      {"NewMeasurements", schema::one_of({schema::ref("NewMeasurement"),
                                          schema::array(schema::ref("NewMeasurement"), 1)})});
  const schema::Fields reason = {
      {"reason", schema::text(app::kLongestComment), "Reason for the correction"}};
  schemas.push_back({"Correction", schema::object(reason + given_fields(), Others::Refused)});
}

}  // namespace

void add_measurement_schemas(Schemas& schemas) {
  add_request_schemas(schemas);
  const schema::Fields notes = {
      {"notes", schema::array(schema::ref("Note")), "Notes, in lists with notes=shown", false},
      {"set_aside", schema::boolean(), "true if the notes set the value aside; given with `notes`",
       false}};
  schemas.push_back({"Measurement", schema::object(record_fields() + notes + warnings_field())});
  schemas.push_back(
      {"Proof",
       schema::object({{"index", schema::count(), "Index of the leaf, from 0"},
                       {"size", schema::count(), "Size of the tree in the checkpoint"},
                       {"leaf", schema::text(), "SHA-256(0x00, the record in its RFC 8785 form)"},
                       {"hashes", schema::array(schema::text()),
                        "Hashes of the path to the root, from the leaf up (RFC 6962)"},
                       {"checkpoint", schema::text(), "A signed note"}})});
  schemas.push_back(
      {"LogHead", schema::object({{"size", schema::count(), "Records of the origin that are here"},
                                  {"root", schema::text(), "Root of the tree, in base64"}})});
  const std::string column_row =
      schema::object({{"over_mm", schema::number(), ""},
                      {"up_to_mm", schema::number(), ""},
                      {"upper_um", schema::number(), "The upper deviation"},
                      {"lower_um", schema::number(), "The lower deviation"}});
  const std::string column =
      schema::object({{"feature", schema::words({"hole", "shaft"}), "Table of the class"},
                      {"tolerance_class", schema::text(), "Name"},
                      {"rows", schema::array(column_row), "Sorted by size"}});
  schemas.push_back(
      {"Revisions",
       schema::object(
           {{"origin", schema::text(), "Ending of the centre's ids"},
            {"size", schema::count(), "Records of the station's log that are here"},
            {"notes", schema::count(),
             "The number in the id of the newest of the station's notes that are here; 0: none is"},
            {"branched", schema::boolean(), "true if a branch of the station's log is here"},
            {"position", schema::text(), "The next request names it in `after`"},
            {"more", schema::boolean(), "true if there is a next page"},
            {"revisions",
             schema::array(schema::object(
                 {{"number", schema::count(), "Number of the change at the centre"},
                  {"kind",
                   schema::words({"tables", "key", "setup", "plan", "correction", "catalogue"}),
                   ""},
                  {"name", schema::text(), "Name of the key, setup, plan or catalogue", false},
                  {"removed", schema::boolean(), "true if it was deleted or revoked", false},
                  {"text", schema::text(), "Text of the setup, plan or catalogue, as stored",
                   false},
                  {"table_revision", schema::text(), "Table revision, as in records", false},
                  {"columns", schema::array(column), "The shop's own", false},
                  {"role", schema::words({"viewer", "operator"}), "Role of a key", false},
                  {"token_sha256", schema::text(), "SHA-256 of a key's token, in hexadecimal",
                   false},
                  {"place", schema::count(), "Place of a correction in the centre's log", false},
                  {"record", schema::text(), "Record of a correction, as returned", false}})),
             "Sorted by number; of each document the newest revision"}})});
  schemas.push_back({"VerdictCounts", verdict_counts()});
  const std::string gauge = schema::object(
      {{"name", schema::text(), ""},
       {"calibration_due", schema::text(), "Due date of an overdue calibration", false},
       {"calibration_certificate", schema::text(),
        "Number of the certificate that was valid when it measured", false},
       {"calibration_laboratory", schema::text(), "Laboratory that calibrated it", false},
       {"gauge_blocked", schema::boolean(), "true if it was blocked when it measured", false},
       {"uncertainty", schema::text(), "The name of its budget", false},
       {"uncertainty_um", schema::number(), "Uncertainty of the budget", false}});
  schemas.push_back(
      {"Certificate",
       schema::object(
           {{"order", schema::text(), "Order or part of the report", false},
            {"part_id", schema::text(), "Order or part of the report", false},
            {"title", schema::text(), ""},
            {"company", schema::text(), "", false},
            {"customer", schema::text(), "", false},
            {"made_at", schema::time(), ""},
            {"count", schema::count(), "Number of measurements"},
            {"verdicts", schema::ref("VerdictCounts"), ""},
            {"parts", schema::count(), "Different part numbers"},
            {"worst_id", schema::text(),
             "Id of the worst value that counts: by verdict, then by position within the limits; "
             "absent if none has limits",
             false},
            {"verdict", verdict_words(),
             "Worst verdict of the values that count; absent if none has limits, or if it is good "
             "but a value is missing",
             false},
            {"measured_again", schema::array(schema::text()),
             "Ids of the values that do not count: of their characteristic of a part another was "
             "measured later",
             false},
            {"plan", schema::text(),
             "Plan that the part is checked against; absent if there is none", false},
            {"missing", schema::array(schema::text()),
             "Characteristics of the plan without a value; absent without `part_id`", false},
            {"gauges", schema::array(gauge), "Gauges, as in the records"},
            {"checkpoint", schema::text(), "The signed head of the log: a note"},
            {"measurements", schema::array(schema::ref("Measurement")), ""}})});
  schemas.push_back(
      {"Accepted",
       schema::object(schema::Fields{{"accepted", schema::count(), "Number of stored measurements"},
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
      {"Recorded", schema::one_of({schema::ref("Measurement"), schema::ref("Accepted"),
                                   schema::ref("Measurements")})});
  schemas.push_back(
      {"MeasurementList",
       schema::object({{"measurements", schema::array(schema::ref("Measurement")), ""},
                       {"next", schema::null_or(schema::text()),
                        "Cursor for `after`; null on the last page"}})});
  schemas.push_back({"SummaryGroup", schema::object(group_fields())});
  schemas.push_back(
      {"Summary",
       schema::object(formula_fields() +
                      schema::Fields{{"groups", schema::array(schema::ref("SummaryGroup")),
                                      "One group for each value of the field in group_by"}})});
}

}  // namespace fitgauge::api
