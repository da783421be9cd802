#include "api/measurements/measurements.hpp"

#include <doctest/doctest.h>

#include "base/json/json_writer.hpp"
#include "record/record.hpp"
#include "service/log/leaves.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

app::Measurement hole_25_h7() {
  app::Measurement m;
  m.id = 17;
  m.origin = "5f0c9a3e77d21b40";
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

std::string record(const app::Measurement& m) {
  std::string out;
  app::append_record(out, m);
  return out;
}

}  // namespace

TEST_CASE("a record has what was given, in the order of RFC 8785") {
  app::Measurement m = hole_25_h7();
  m.part_id = "SN-1";
  m.temperature = 20'400'000;
  CHECK(
      record(m) ==
      R"({"basis":"iso286","designation":"25 H7","deviation_um":13,"excess_um":0,)"
      R"("feature":"hole","id":"m17-5f0c9a3e77d21b40","lower_deviation_um":0,"lower_limit_mm":25,)"
      R"("measured_at":"1970-01-01T00:00:00Z","measured_mm":25.013,"nominal_mm":25,)"
      R"("part_id":"SN-1","received_at":"1970-01-01T00:00:00Z","rule":"simple",)"
      R"("size_range_mm":{"over":18,"up_to":30},"source":"gauge",)"
      R"("table_revision":"1-00000000","temperature_c":20.4,"tolerance_class":"H7",)"
      R"("tolerance_um":21,"upper_deviation_um":21,"upper_limit_mm":25.021,"verdict":"good"})");
}

TEST_CASE("a record says what decided beside the reading") {
  app::Measurement m = hole_25_h7();
  m.standard_uncertainty = Length::micrometres(2);
  m.rule = gauging::DecisionRule::conformance(*m.standard_uncertainty).value();
  m.temperature = 25'000'000;
  m.scale_temperature = 21'500'000;
  m.part_expansion = 11'500'000;
  m.scale_material = "steel";
  m.corrected = Length::millimetres(25) + Length::nanometres(3290);
  app::judge(m);
  // The probability to lie above 25 with 1.645 standard uncertainties: normal tables have 0.950015.
  CHECK(record(m) ==
        R"({"basis":"iso286","conformance_probability":0.950015094,"corrected_mm":25.00329,)"
        R"("designation":"25 H7","deviation_um":3.29,"excess_um":0,)"
        R"("feature":"hole","guard_band_um":3.289707254,"id":"m17-5f0c9a3e77d21b40",)"
        R"("lower_deviation_um":0,"lower_limit_mm":25,)"
        R"("measured_at":"1970-01-01T00:00:00Z","measured_mm":25.013,"nominal_mm":25,)"
        R"("part_expansion_um_per_m_k":11.5,"probability":0.95,)"
        R"("received_at":"1970-01-01T00:00:00Z","rule":"conformance","scale_material":"steel",)"
        R"("scale_temperature_c":21.5,"size_range_mm":{"over":18,"up_to":30},"source":"gauge",)"
        R"("table_revision":"1-00000000","temperature_c":25,"tolerance_class":"H7",)"
        R"("tolerance_um":21,"uncertainty_um":2,"upper_deviation_um":21,"upper_limit_mm":25.021,)"
        R"("verdict":"good"})");
  const auto probability = [&](std::int64_t value) {
    m.conformance->probability = value;
    const std::string text = record(m);
    const std::size_t begin = text.find("y\":") + 3;
    return text.substr(begin, text.find(',') == 0 ? 0 : text.find(',', begin) - begin);
  };
  // As RFC 8785 takes them from ECMAScript: an exponent below 1e-6.
  CHECK(probability(0) == "0");
  CHECK(probability(1) == "1e-9");
  CHECK(probability(25) == "2.5e-8");
  CHECK(probability(30) == "3e-8");
  CHECK(probability(999) == "9.99e-7");
  CHECK(probability(1000) == "0.000001");
  CHECK(probability(1'000'000'000) == "1");
}

TEST_CASE("records with the times and limits of the one before or others are as each by itself") {
  std::vector<app::Measurement> rows(12, hole_25_h7());
  rows[3].class_name = "H8";
  rows[4].nominal_size = Length::millimetres(26);
  rows[6].deviations.upper = Length::micrometres(52);
  rows[7].size_range.reset();
  rows[8].table_revision = "2-00000000";
  rows[9].basis = app::LimitsBasis::Explicit;
  rows[10].feature = iso286::Feature::Shaft;
  rows[2].measured_at = {1'000'000'000};
  rows[3].received_at = {2'000'000'000};
  rows[5].source = app::Source::Simulation;
  std::string each;
  for (const app::Measurement& m : rows) each += (each.empty() ? "" : ",") + record(m);
  app::LeafMaker leaves;
  const auto made = leaves(rows);
  CHECK(leaves.records() == each);
  for (std::size_t i = 0; i < rows.size(); ++i) CHECK(made[i] == tlog::leaf_hash(record(rows[i])));
}

TEST_CASE("every character of a text is written as a JSON string has it") {
  std::string text;
  for (int c = 1; c < 128; ++c) text += static_cast<char>(c);
  text += "Ø 25";
  app::Measurement m = hole_25_h7();
  m.comment = text;
  std::string quoted;
  append_json_string(quoted, text);
  CHECK(record(m).find("\"comment\":" + quoted + ",\"designation\"") != std::string::npos);
}

TEST_CASE("the longest numbers and texts of nothing but escapes have room") {
  const std::string text(2000, '\1');
  constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min() / 2 + 1;
  app::Measurement m = hole_25_h7();
  for (const app::MeasurementField& field : app::kMeasurementFields) {
    if (field.text != nullptr) {
      m.*field.text = text;
    } else {
      m.*field.number = kLowest;
    }
  }
  m.class_name = text;
  m.table_revision = text;
  m.nominal_size = m.deviations.upper = m.deviations.lower = Length::nanometres(kLowest);
  m.size_range = {.over = Length::nanometres(kLowest), .up_to = Length::nanometres(kLowest)};
  m.result = {.verdict = gauging::Verdict::Indeterminate, .excess = Length::nanometres(kLowest)};
  m.measured = m.result.excess;
  m.standard_uncertainty = m.measured;
  m.coverage_factor = gauging::CoverageFactor();
  m.id = kLowest;
  m.corrected = m.measured;
  m.conformance = {.probability = kLowest, .guard_band = kLowest};
  m.run_id = m.correction_of = m.corrected_by = kLowest;
  m.measured_at = m.received_at = {1'795'000'000'123'456'789};
  CHECK(record(m).size() > text.size() * 14 * 6);
}
