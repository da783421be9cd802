#include <random>

#include "db/store/measurement_index.hpp"
#include "fixture.hpp"
#include "measurement_sample.hpp"
#include "support/deep.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// The groups from the sample alone, in sums of whole nanometres.
std::string expected_summary(const Sample& sample, const MeasurementFilter& filter,
                             TextField group_by) {
  struct Group {
    std::int64_t count = 0, rejects = 0, sum = 0, min = 0, max = 0;
  };
  std::map<std::optional<std::string_view>, Group> groups;
  for (std::size_t i = 0; i < sample.rows.size(); ++i) {
    if (!sample.matches(i, filter)) continue;
    const MeasurementRow& row = sample.rows[i];
    Group& group = groups[row.*kTextColumns[index_of(group_by)].text];
    group.min = group.count == 0 ? row.measured_nm : std::min(group.min, row.measured_nm);
    group.max = group.count == 0 ? row.measured_nm : std::max(group.max, row.measured_nm);
    ++group.count;
    group.rejects += row.verdict == Verdict::Reject ? 1 : 0;
    group.sum += row.measured_nm;
  }
  std::string text;
  for (const auto& [value, group] : groups) {
    text += fmt::format("{}:{}x {}r {}..{} mean {:.3f}\n", value.value_or("none"), group.count,
                        group.rejects, group.min, group.max,
                        static_cast<double>(group.sum) / static_cast<double>(group.count) / 1e6);
  }
  return text;
}

std::int64_t count_of(const SummaryGroup& group, Verdict verdict) {
  return group.verdicts[static_cast<std::size_t>(verdict)];
}

std::string found_summary(Fixture& fixture, const MeasurementFilter& filter, TextField group_by) {
  return fixture.see([&](const Stores& stores) {
    std::string text;
    for (const SummaryGroup& group : *stores.measurements.summary(filter, group_by)) {
      text += fmt::format("{}:{}x {}r {}..{} mean {:.3f}\n", group.value.value_or("none"),
                          group.count, count_of(group, Verdict::Reject), group.min_nm, group.max_nm,
                          std::stod(group.mean_mm));
    }
    return text;
  });
}

/// The ids a filter finds from the newest on, read page by page.
std::vector<std::int64_t> newest_first(Fixture& fixture, const MeasurementFilter& filter,
                                       std::size_t page) {
  std::vector<std::int64_t> ids;
  std::optional<std::int64_t> after = 0;
  while (after) {
    after = fixture.see([&](const Stores& stores) {
      return stores.measurements.list(
          filter, *after, page, [&](const MeasurementRow& row) { ids.push_back(row.id); },
          ListOrder::NewestFirst);
    });
  }
  return ids;
}

/// The rows a filter finds as figures read them, page by page, against those that lists give.
void check_values(Fixture& fixture, const MeasurementFilter& filter, std::size_t page) {
  std::vector<std::string> expected;
  fixture.see([&](const Stores& stores) {
    return stores.measurements.list(filter, 0, 1'000'000, [&](const MeasurementRow& row) {
      expected.push_back(fmt::format("{} {} {} {} {}", row.id, row.measured_nm,
                                     row.lower_limit_nm(), row.upper_limit_nm(),
                                     row.subgroup.value_or("none")));
    });
  });
  std::vector<std::string> found;
  std::optional<std::int64_t> after = 0;
  while (after) {
    after = fixture.see([&](const Stores& stores) {
      std::size_t taken = 0;
      const auto next =
          stores.measurements.list_values(filter, *after, page, [&](const MeasuredRun& run) {
            taken += run.values.size();
            for (const MeasuredRun::Value& value : run.values) {
              found.push_back(fmt::format("{} {} {} {} {}", value.id, value.measured_nm,
                                          run.lower_limit_nm, run.upper_limit_nm,
                                          run.subgroup.value_or("none")));
            }
          });
      CHECK(taken <= page);
      return next;
    });
  }
  CHECK(found == expected);
}

void check_filters(Fixture& fixture, const Sample& sample, std::mt19937& random, int count) {
  for (int i = 0; i < count; ++i) {
    const MeasurementFilter filter = any_filter(random, sample.rows.size());
    std::vector<std::int64_t> expected = sample.ids(filter);
    const auto page = [&] {  // of any size, but no more than 100 of them
      return 1 + std::max<std::size_t>(random() % 2000, expected.size() / 100);
    };
    CHECK(fixture.list(filter, page()) == expected);
    check_values(fixture, filter, page());
    const std::size_t last = 1 + random() % 50;
    const auto first = fixture.see(
        [&](const Stores& stores) { return stores.measurements.first_of_newest(filter, last); });
    CHECK(first.value_or(0) ==
          (expected.empty() ? 0 : expected[expected.size() - std::min(last, expected.size())]));
    std::reverse(expected.begin(), expected.end());
    CHECK(newest_first(fixture, filter, page()) == expected);
    const TextField field = any_field(random);
    CHECK(found_summary(fixture, filter, field) == expected_summary(sample, filter, field));
  }
}

}  // namespace

TEST_CASE("a filter finds the same rows however many of them are indexed" *
          doctest::skip(kUnderThreadSanitizer)) {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  Fixture fixture;
  Sample sample(seed, 4000);
  sample.add_corrections(random, 30);
  // The maintenance indexes meanwhile, so that these are met with any part of the rows indexed.
  // A correction names a row that is stored, so it begins a batch.
  for (auto begin = sample.rows.begin(); begin != sample.rows.end();) {
    const auto end = std::find_if(begin + 1, sample.rows.end(),
                                  [](const MeasurementRow& row) { return row.correction_of; });
    REQUIRE(fixture.append(std::span<const MeasurementRow>(begin, end)).has_value());
    begin = end;
  }
  add_notes(fixture, sample, random, 300);
  check_filters(fixture, sample, random, rounds(20, 40));
  fixture.index_all();
  check_filters(fixture, sample, random, rounds(20, 40));
  CHECK(fixture.database->verify()->findings.empty());
}

TEST_CASE("of corrections that were made apart the one received last stands, indexed or not" *
          doctest::skip(kUnderThreadSanitizer)) {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  Fixture fixture;
  Sample sample(seed, 4000);
  sample.add_rivals(random, 300);
  for (MeasurementRow& row : sample.rows) {  // runs are of their folder: the filters name none
    row.source = Source::Gauge;
    row.run_id.reset();
  }
  std::int64_t number = 0;
  const auto append = [&](std::size_t begin, std::size_t end) {
    fixture.change([&](Stores& stores) {
      if (number == 0) number = stores.origins.add("5f0c9a3e77d21b40");
      std::vector<MeasurementRow> rows;
      for (std::size_t i = begin; i < end; ++i) {
        MeasurementRow& row = rows.emplace_back(sample.rows[i]);
        row.id = static_cast<std::int64_t>(i) + 1;
        row.hash = hash_of(row);
        row.origin = number;
        row.seq = row.id;
      }
      stores.measurements.append_forwarded(rows);
    });
  };
  append(0, 2500);
  fixture.index_all();
  append(2500, sample.rows.size());  // makes what is indexed stale
  check_filters(fixture, sample, random, rounds(12, 30));
  fixture.index_all();
  check_filters(fixture, sample, random, rounds(12, 30));
  for (std::size_t i = 0; i < sample.rows.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i) + 1;
    const auto [first, last] = sample.corrections.equal_range(i);
    if (first == last) continue;
    const auto stands = std::max_element(first, last, [&](const auto& a, const auto& b) {
      return sample.moment(a.second) < sample.moment(b.second);
    });
    const auto found = fixture.see([&](const Stores& stores) {
      return std::pair(stores.measurements.corrected_by(id).value_or(0),
                       stores.measurements.has_rivals(id));
    });
    CHECK(found.first == static_cast<std::int64_t>(stands->second) + 1);
    CHECK(found.second == (std::distance(first, last) > 1));
  }
}

TEST_CASE("summaries add nodes of every level, and mend those with a corrected row" *
          doctest::skip(kUnderThreadSanitizer)) {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  Fixture fixture;
  // One node of level 1, some blocks, some rows.
  Sample sample(seed, 36'000);
  for (std::size_t i = 0; i < sample.rows.size(); ++i) {
    MeasurementRow& row = sample.rows[i];
    row.measured_at_ns = row.received_at_ns = static_cast<std::int64_t>(i);
  }
  REQUIRE(fixture.append(sample.rows).has_value());
  fixture.index_all();
  const auto nodes = [&](const char* condition) {
    return fixture.query_integer(
        fmt::format("SELECT count(*) FROM measurement_nodes WHERE {}", condition));
  };
  CHECK(nodes("level = 1") == 1);
  CHECK(nodes("level = 0") == 35);
  check_filters(fixture, sample, random, rounds(5, 10));
  // Corrections of rows that are indexed: right at once, and after the maintenance.
  for (int i = 0; i < 3; ++i) {
    const std::size_t corrected = random() % 35'000;
    MeasurementRow row = sample.rows[corrected];
    row.correction_of = static_cast<std::int64_t>(corrected) + 1;
    row.correction_reason = "wrong";
    row.measured_nm += 1;
    REQUIRE(fixture.append(row).has_value());
    sample.rows.push_back(row);
    sample.correct(corrected, sample.rows.size() - 1);
  }
  check_filters(fixture, sample, random, 5);
  fixture.index_all();
  CHECK(nodes("stale = 1") == 0);
  check_filters(fixture, sample, random, 5);
  CHECK(fixture.database->verify()->findings.empty());
}

TEST_CASE("a field with many values has groups of its own where a summary can show them" *
          doctest::skip(kUnderThreadSanitizer)) {
  Fixture fixture;
  std::vector<std::string> texts;
  for (int i = 0; i < 1'000; ++i) texts.push_back("WO-" + std::to_string(i));
  std::vector<MeasurementRow> rows(33'000, sample_row());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].order = texts[i % texts.size()];
  REQUIRE(fixture.append(rows).has_value());
  fixture.index_all();
  const auto count = [&](const char* where) {
    return fixture.query_integer(
        fmt::format("SELECT count(*) FROM measurement_aggregates WHERE {}", where));
  };
  CHECK(count("level = 0 AND field = 2") == 0);
  CHECK(count("level = 1 AND field = 2") == 1'000);
  const auto groups = *fixture.read(
      [](const Stores& stores) { return stores.measurements.summary({}, TextField::Order); });
  REQUIRE(groups.size() == 1'000);
  CHECK(groups.front().count == 33);
  MeasurementFilter one;
  one.text(TextField::Order) = "WO-7";
  const auto found = *fixture.read(
      [&](const Stores& stores) { return stores.measurements.summary(one, TextField::Order); });
  REQUIRE(found.size() == 1);
  CHECK(found.front().count == 33);
}

TEST_CASE("rows of a block are kept as their numbers or as a bit each") {
  for (const std::int64_t step : {1, 3, 16, 17, 500, 1023}) {
    RowSet set;
    for (std::int64_t row = 0; row < kBlock; row += step) set.add(row);
    const RowSet again = RowSet::decode(set.encode());
    for (std::int64_t row = 0; row < kBlock; ++row) CHECK(again.contains(row) == set.contains(row));
    CHECK(set.encode().size() <= 128);
  }
}

TEST_CASE("the writer indexes whole blocks when it is idle") {
  Fixture fixture;
  REQUIRE(fixture.append(std::vector<MeasurementRow>(2500, sample_row())).has_value());
  const auto blocks = [&] {
    return fixture.query_integer("SELECT count(*) FROM measurement_nodes");
  };
  while (blocks() < 2) std::this_thread::yield();
  CHECK_FALSE(fixture.index_step());
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
    return stores.measurements.summary({}, TextField::Characteristic);
  });
  REQUIRE(groups.size() == 3);
  CHECK(groups[0].value == std::nullopt);
  CHECK(groups[0].count == 1);
  CHECK(groups[0].standard_deviation_mm == std::nullopt);
  CHECK(groups[1].value == "bore-A");
  CHECK(groups[1].count == 2);
  CHECK(count_of(groups[1], Verdict::Good) == 1);
  CHECK(count_of(groups[1], Verdict::Reject) == 1);
  CHECK(groups[1].mean_mm == "25.0175");
  CHECK(groups[1].standard_deviation_mm == "0.006363961031");
  CHECK(groups[1].min_nm == 25'013'000);
  CHECK(groups[1].max_nm == 25'022'000);
  CHECK(groups[2].value == "bore-B");

  const auto too_many = fixture.read([](const Stores& stores) {
    return stores.measurements.summary({}, TextField::Characteristic, 2);
  });
  CHECK(too_many.error().code == ErrorCode::QueryInvalid);
}
