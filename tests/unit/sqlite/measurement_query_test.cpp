#include <random>
#include <vector>

#include "fixture.hpp"
#include "sqlite/connection.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// Few values, so that filters meet many rows.
const std::string kTexts[] = {"", "A", "B", "a", "C"};

std::optional<std::string> any_text(std::mt19937& random) {
  const auto choice = random() % 6;
  return choice == 5 ? std::nullopt : std::optional(kTexts[choice]);
}

/// Rows whose texts are kept here, as the row has views only.
struct Sample {
  explicit Sample(unsigned seed, std::size_t size) {
    std::mt19937 random(seed);
    texts.reserve(size * 4);
    for (std::size_t i = 0; i < size; ++i) {
      MeasurementRow row = sample_row();
      for (auto* field : {&row.part_id, &row.characteristic, &row.order, &row.machine}) {
        texts.push_back(any_text(random));
        if (texts.back()) *field = *texts.back();
      }
      // The clock goes forth and back.
      row.measured_at_ns = static_cast<std::int64_t>(i + random() % 2000);
      row.source = random() % 4 == 0 ? Source::Simulation : Source::Gauge;
      row.measured_nm += static_cast<std::int64_t>(random() % 9000);
      row.verdict = row.measured_nm > row.upper_limit_nm() ? Verdict::Reject : Verdict::Good;
      rows.push_back(row);
    }
  }

  std::vector<std::optional<std::string>> texts;
  std::vector<MeasurementRow> rows;
};

MeasurementFilter any_filter(std::mt19937& random, std::int64_t last_id) {
  MeasurementFilter filter;
  const auto text = [&] { return random() % 3 == 0 ? any_text(random) : std::nullopt; };
  filter.part_id = text();
  filter.characteristic = text();
  filter.order = text();
  filter.machine = text();
  if (random() % 3 == 0) filter.verdict = Verdict::Reject;
  if (random() % 2 == 0) filter.source.reset();
  if (random() % 3 == 0) filter.from_ns = random() % 6000;
  if (random() % 3 == 0) filter.to_ns = random() % 6000;
  if (random() % 4 == 0) filter.as_of_id = random() % (static_cast<unsigned>(last_id) + 10);
  return filter;
}

bool matches(const MeasurementRow& row, std::int64_t id, const MeasurementFilter& filter) {
  const auto text = [](const auto& wanted, const auto& found) {
    return !wanted || found == wanted;
  };
  return text(filter.part_id, row.part_id) && text(filter.characteristic, row.characteristic) &&
         text(filter.order, row.order) && text(filter.machine, row.machine) &&
         (!filter.verdict || row.verdict == filter.verdict) &&
         (!filter.source || row.source == filter.source) &&
         (!filter.from_ns || row.measured_at_ns >= *filter.from_ns) &&
         (!filter.to_ns || row.measured_at_ns < *filter.to_ns) &&
         (!filter.as_of_id || id <= *filter.as_of_id);
}

std::int64_t count_in_summary(Fixture& fixture, const MeasurementFilter& filter) {
  return *fixture.read([&](const Stores& stores) -> Result<std::int64_t> {
    std::int64_t count = 0;
    for (const SummaryGroup& group :
         *stores.measurements.summary(filter, GroupBy::Characteristic)) {
      count += group.count;
    }
    return count;
  });
}

}  // namespace

TEST_CASE("a filter finds the same rows however many of them are indexed") {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  Fixture fixture;
  const Sample sample(seed, 4000);
  REQUIRE(fixture.append(sample.rows).has_value());
  std::mt19937 random(seed);
  for (int blocks = 0; blocks < 4; ++blocks) {
    for (int i = 0; i < 20; ++i) {
      const MeasurementFilter filter = any_filter(random, 4000);
      std::vector<std::int64_t> expected;
      for (std::size_t k = 0; k < sample.rows.size(); ++k) {
        const auto id = static_cast<std::int64_t>(k) + 1;
        if (matches(sample.rows[k], id, filter)) expected.push_back(id);
      }
      CHECK(fixture.list(filter, 1 + random() % 2000) == expected);
      CHECK(count_in_summary(fixture, filter) == static_cast<std::int64_t>(expected.size()));
    }
    static_cast<void>(fixture.write(
        [](Stores& stores) -> Result<bool> { return stores.measurements.index_block(); }));
  }
}

TEST_CASE("the writer indexes whole blocks when it is idle") {
  Fixture fixture;
  REQUIRE(fixture.append(std::vector<MeasurementRow>(2500, sample_row())).has_value());
  const auto blocks = [&] {
    return sqlite::Connection(fixture.directory.file(), sqlite::Mode::Read)
        .query_integer("SELECT count(*) FROM measurement_blocks");
  };
  while (blocks() < 2) std::this_thread::yield();
  CHECK_FALSE(*fixture.write(
      [](Stores& stores) -> Result<bool> { return stores.measurements.index_block(); }));
}

TEST_CASE("a summary groups by the values of a field") {
  Fixture fixture;
  std::vector<MeasurementRow> rows(4, sample_row());
  rows[0].characteristic = "bore-B";
  rows[1].characteristic = "bore-A";
  rows[2].characteristic = "bore-A";
  rows[2].measured_nm = 25'022'000;
  rows[2].verdict = Verdict::Reject;
  REQUIRE(fixture.append(rows).has_value());
  const auto groups = *fixture.read([](const Stores& stores) {
    return stores.measurements.summary({}, GroupBy::Characteristic);
  });
  REQUIRE(groups.size() == 3);
  CHECK(groups[0].value == std::nullopt);
  CHECK(groups[0].count == 1);
  CHECK(groups[0].standard_deviation_mm == std::nullopt);
  CHECK(groups[1].value == "bore-A");
  CHECK(groups[1].count == 2);
  CHECK(groups[1].verdict_count(Verdict::Good) == 1);
  CHECK(groups[1].verdict_count(Verdict::Reject) == 1);
  CHECK(groups[1].mean_mm == "25.0175");
  CHECK(groups[1].standard_deviation_mm == "0.006363961031");
  CHECK(groups[1].min_nm == 25'013'000);
  CHECK(groups[1].max_nm == 25'022'000);
  CHECK(groups[2].value == "bore-B");

  const auto too_many = fixture.read([](const Stores& stores) {
    return stores.measurements.summary({}, GroupBy::Characteristic, 2);
  });
  CHECK(too_many.error().code == ErrorCode::QueryInvalid);
}
