#include <doctest/doctest.h>

#include "record/record.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

app::Measurement hole() {
  app::Measurement m;
  m.id = 17;
  m.origin = "5f0c9a3e77d21b40";
  m.measured_at = m.received_at = {1'763'625'600'123'456'000};
  m.nominal_size = Length::millimetres(25);
  m.class_name = "H7";
  m.deviations = {.upper = Length::micrometres(21), .lower = Length()};
  m.size_range =
      iso286::NominalSizeRange{.over = Length::millimetres(18), .up_to = Length::millimetres(30)};
  m.table_revision = "1-00000000";
  m.measured = Length::micrometres(25'013);
  app::judge(m);
  return m;
}

std::string text_of(const app::Measurement& m) {
  std::string out;
  app::append_record(out, m);
  return out;
}

/// One record of each kind.
std::vector<app::Measurement> samples() {
  std::vector<app::Measurement> rows(15, hole());
  rows[1].comment = "\"\\\b\f\n\r\t\x01\x7f \xC3\x98 25 \xF0\x9F\x98\x80";
  rows[1].caller = "press-3";
  rows[1].temperature = -1;
  rows[2].standard_uncertainty = Length::nanometres(800);
  rows[2].coverage_factor = gauging::CoverageFactor::from_millionths(1'960'000).value();
  rows[2].rule =
      gauging::DecisionRule::guard_band(Length::nanometres(800), *rows[2].coverage_factor).value();
  rows[3].standard_uncertainty = Length::micrometres(2);
  rows[3].rule = gauging::DecisionRule::conformance(*rows[3].standard_uncertainty).value();
  rows[3].corrected = Length::micrometres(25'003);
  rows[3].scale_temperature = 21'500'000;
  rows[3].part_expansion = 11'500'000;
  rows[3].scale_material = "steel";
  rows[4].basis = app::LimitsBasis::Explicit;
  rows[4].class_name.reset();
  rows[4].table_revision = {};
  rows[4].size_range.reset();
  rows[4].deviations.upper = app::kNoLimit;
  rows[5] = rows[4];
  rows[5].deviations = {.upper = Length(), .lower = -app::kNoLimit};
  rows[6].basis = app::LimitsBasis::Custom;
  rows[6].correction_of = 3;
  rows[6].correction_reason = "misread";
  rows[7] = rows[4];
  rows[7].source = app::Source::Simulation;
  rows[7].run_id = 5;
  rows[7].cycle = 421;
  rows[7].measured = -Length::nanometres(1);
  rows[8].standard_uncertainty = Length::nanometres(400);
  rows[8].rule = gauging::DecisionRule::conformance(
                     *rows[8].standard_uncertainty,
                     gauging::ConformanceProbability::from_millionths(500'000).value())
                     .value();
  rows[8].measured = Length::millimetres(27);
  rows[9] = rows[2];
  rows[9].gauge = "G-07";
  rows[9].uncertainty_budget = "bore gauge";
  rows[9].calibration_due = "2026-03-31";
  rows[10] = rows[3];
  rows[10].temperature_uncertainty = 100'000;
  rows[10].scale_temperature_uncertainty = 1;
  rows[10].part_expansion_uncertainty = 577'350;
  rows[10].scale_expansion_uncertainty = 0;
  rows[10].added_uncertainty = 1'500'000;  // 1.5 µm, with 2 µm: 2.5 µm
  rows[10].rule = gauging::DecisionRule::conformance(Length::nanometres(2500)).value();
  using gauging::Quantity;
  rows[11].quantity = Quantity::Position;
  rows[11].measured = -Length::micrometres(50'080);
  app::apply_no_limits(rows[11], -Length::millimetres(50));
  rows[11].class_name.reset();
  rows[11].table_revision = {};
  rows[11].size_range.reset();
  rows[12] = rows[11];
  app::apply_no_limits(rows[12], std::nullopt);
  rows[12].quantity = Quantity::Diameter;
  rows[12].source = app::Source::Simulation;
  rows[12].cycle = 421;
  rows[12].points = 3;
  rows[12].start_angle = -22'500'000;
  rows[12].diameter_factor = 1'154'701;
  rows[12].size_operator = "GG";
  rows[13].quantity = Quantity::Width;
  rows[13].envelope = app::kEnvelopeRequired;
  rows[13].go_gauge = app::kGoFails;
  rows[13].standard_uncertainty = Length::micrometres(1);
  rows[13].degrees_of_freedom = 2'500'000;
  rows[13].rule = gauging::DecisionRule::conformance({Length::micrometres(1), 2.5}).value();
  rows[14] = rows[12];
  rows[14].points = 4;
  rows[14].form = 12'345;
  for (app::Measurement& m : rows) app::judge(m);
  return rows;
}

}  // namespace

TEST_CASE("a record that was read gives its own text again") {
  for (const app::Measurement& m : samples()) {
    const std::string text = text_of(m);
    CAPTURE(text);
    TextArena texts;
    const auto read = read_record(parse_json(text).value(), texts).value();
    CHECK(text_of(read) == text);
    CHECK(read.id == m.id);
    CHECK(read.run_id == m.run_id);
    CHECK(read.result.verdict == m.result.verdict);
    CHECK(read.rule == m.rule);
  }
}

TEST_CASE("a record that lacks a member or has one of nonsense is not read") {
  const std::string text = text_of(hole());
  const auto read = [](std::string record, std::string_view from, std::string_view to) {
    record.replace(record.find(from), from.size(), to);
    TextArena texts;
    return read_record(parse_json(record).value(), texts);
  };
  CHECK(read(text, "\"verdict\":\"good\"", "\"verdict\":\"fine\"").error().code ==
        ErrorCode::LogRecordInvalid);
  CHECK_FALSE(read(text, "\"id\":\"m17-", "\"id\":\"m-17-").has_value());
  CHECK_FALSE(read(text, "\"id\":\"m17-", "\"id\":\"r17-").has_value());
  CHECK_FALSE(read(text, "\"source\":\"gauge\",", "").has_value());
  CHECK_FALSE(read(text, "25.013", "1e300").has_value());
  CHECK_FALSE(read(text, "25.013", "9000000000000").has_value());
  CHECK_FALSE(read(text, "25.013", "\"25,013\"").has_value());
  CHECK_FALSE(read(text, "\"rule\":\"simple\"", "\"rule\":\"conformance\"").has_value());
  CHECK_FALSE(read(text, "{\"over\":18,\"up_to\":30}", "[18,30]").has_value());
  CHECK_FALSE(read(text, "2025-", "25-").has_value());
}

TEST_CASE("every plain field is in the record under its name and is read from there") {
  for (const app::MeasurementField& field : app::kMeasurementFields) {
    CAPTURE(field.name);
    app::Measurement m = hole();
    if (field.text != nullptr) {
      m.*field.text = "\"1";
    } else {
      m.*field.number = field.accepted.is_truth ? 1 : 42;
    }
    const std::string text = text_of(m);
    CHECK(text.find(fmt::format("\"{}\":", field.name)) != std::string::npos);
    TextArena texts;
    const auto read = read_record(parse_json(text).value(), texts).value();
    CHECK(text_of(read) == text);
    for (const app::MeasurementField& other : app::kMeasurementFields) {
      if (other.text != nullptr) CHECK(read.*other.text == m.*other.text);
      if (other.number != nullptr) CHECK(read.*other.number == m.*other.number);
    }
  }
}
