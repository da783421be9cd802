// Every way to sum up against a plain pass over the rows: each field and the designation as the
// filter, each field to group by, with verdicts, sources, times and corrections, and with the index
// in every state it can be in.

#include <random>

#include "db/sql/index_nodes.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/measurement_statistics.hpp"
#include "fixture.hpp"
#include "measurement_sample.hpp"
#include "support/deep.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// One node of level 1, three blocks, and rows that are not indexed.
constexpr std::size_t kSize = 36'000;
/// So many at the beginning, two blocks, have no size at 20 °C.
constexpr std::size_t kMeasuredAlone = 2'048;
constexpr std::size_t kDesignation = kTextColumns.size();
constexpr std::size_t kNoFilter = kDesignation + 1;
constexpr std::size_t kTwoFilters = kNoFilter + 1;
constexpr std::size_t kThreeFilters = kTwoFilters + 1;
constexpr std::size_t kFilters = kThreeFilters + 1;

std::string line(std::optional<std::string_view> value, std::int64_t count,
                 const std::array<std::int64_t, 5>& verdicts, const std::string& mean,
                 const std::optional<std::string>& deviation, std::int64_t min, std::int64_t max) {
  return fmt::format("{}: {}x {} mean {} s {} {}..{}\n",
                     value ? '"' + std::string(*value) + '"' : "none", count,
                     fmt::join(verdicts, " "), mean, deviation.value_or("none"), min, max);
}

struct Shop : Fixture {
  explicit Shop(unsigned seed) : random(seed), sample(seed, kSize) {
    for (std::size_t i = 0; i < sample.rows.size(); ++i) {
      MeasurementRow& row = sample.rows[i];
      // Mostly in order, so that a range of times holds whole nodes and cuts others.
      row.measured_at_ns = static_cast<std::int64_t>(i + random() % 50);
      row.received_at_ns = static_cast<std::int64_t>(i);
      if (random() % 10 == 0) row.verdict = Verdict::Indeterminate;
      if (i >= kMeasuredAlone && random() % 10 == 0 &&
          row.measured_nm + 3 <= row.upper_limit_nm()) {
        row.corrected_nm = row.measured_nm + 3;  // what is summed up
      }
      if (random() % 4 != 0) {
        row.tolerance_class = random() % 2 == 0 ? "H7" : "H8";
        row.table_revision = 1;
        row.size_over_nm = 18'000'000;
        row.size_up_to_nm = 30'000'000;
        row.basis = Basis::Iso286;
      }
      row.rule = Rule::GuardBand;
      row.coverage_factor = 2'000'000;
      row.uncertainty_nm = 1;
      // Too many values for a block, too many for a node, those of a part of the rows alone, one.
      texts.push_back(fmt::format("SN-{}", i));
      texts.push_back(fmt::format("{}", i / 25));
      row.part_id = *texts[texts.size() - 2];
      if (i % 7 != 0) row.subgroup = *texts.back();
      row.unit = "mm";
      if (i > 5'000 && i < 30'000) row.caller.reset();
    }
    REQUIRE(import_it7(21).has_value());
    sample.add_corrections(random, 40);
    append_from(0);
  }

  /// A correction names a row that is stored, so it begins a batch.
  void append_from(std::size_t first) {
    const auto end = sample.rows.end();
    for (auto begin = sample.rows.begin() + static_cast<std::ptrdiff_t>(first); begin != end;) {
      const auto next =
          std::find_if(begin + 1, end, [](const MeasurementRow& row) { return row.correction_of; });
      REQUIRE(append(std::span<const MeasurementRow>(begin, next)).has_value());
      begin = next;
    }
  }

  /// Corrects some of what is indexed, corrections among it.
  void correct(std::size_t count) {
    const std::size_t first = sample.rows.size();
    while (count > 0) {
      const std::size_t earlier = random() % first;
      if (sample.corrections.contains(earlier)) continue;
      MeasurementRow row = sample.rows[earlier];
      row.correction_of.reset();
      row.measured_nm += 1'000;
      row.verdict = Verdict::Rework;
      row.received_at_ns = static_cast<std::int64_t>(sample.rows.size());
      sample.rows.push_back(row);
      sample.correct(earlier, sample.rows.size() - 1);
      --count;
    }
    append_from(first);
  }

  void index(std::int64_t most_steps) {
    while (most_steps-- > 0 && index_step()) {
    }
  }

  std::string expected(const std::vector<bool>& current, const MeasurementFilter& filter,
                       TextField group_by) const {
    struct Group {
      ExactStatistics statistics;
      std::array<std::int64_t, 5> verdicts{};
    };
    MeasurementFilter all = filter;
    all.history = true;
    all.designation.reset();
    std::map<std::optional<std::string_view>, Group> groups;
    for (std::size_t i = 0; i < sample.rows.size(); ++i) {
      const MeasurementRow& row = sample.rows[i];
      if (!filter.history && !current[i]) continue;
      if (filter.designation && (row.nominal_nm != filter.designation->nominal_nm ||
                                 row.tolerance_class != filter.designation->tolerance_class)) {
        continue;
      }
      if (!sample.matches(i, all)) continue;
      Group& group = groups[row.*kTextColumns[index_of(group_by)].text];
      group.statistics.add(row.corrected_nm.value_or(row.measured_nm));
      ++group.verdicts.at(static_cast<std::size_t>(row.verdict));
    }
    if (groups.size() > 10'000) return "too many";
    std::string text;
    for (const auto& [value, group] : groups) {
      const ExactStatistics& of = group.statistics;
      text += line(value, of.count(), group.verdicts, of.mean_mm(),
                   of.count() > 1 ? std::optional(of.standard_deviation_mm()) : std::nullopt,
                   of.min_nm(), of.max_nm());
    }
    return text;
  }

  std::string found(const MeasurementFilter& filter, TextField group_by) {
    const auto made = read([&](const Stores& stores) -> Result<std::string> {
      const auto groups = stores.measurements.summary(filter, group_by);
      if (!groups) return std::string("too many");
      std::string text;
      for (const SummaryGroup& group : *groups) {
        text += line(group.value, group.count, group.verdicts, group.mean_mm,
                     group.standard_deviation_mm, group.min_nm, group.max_nm);
      }
      return text;
    });
    return made ? *made : made.error().message;
  }

  /// @param number of the filter: a field, the designation, none, or two or three fields
  MeasurementFilter filter(std::size_t number, TextField group_by) {
    MeasurementFilter filter;
    const auto any = [&](TextField field) {
      const MeasurementRow& row = sample.rows[random() % sample.rows.size()];
      const auto value = row.*kTextColumns[index_of(field)].text;
      filter.text(field) = std::string(value.value_or("nobody"));
    };
    if (number < kDesignation) any(kTextColumns[number].field);
    if (number == kDesignation) {
      filter.designation = {.nominal_nm = 25'000'000 + static_cast<std::int64_t>(random() % 2),
                            .tolerance_class = random() % 2 == 0 ? "H7" : "H8"};
    }
    for (std::size_t i = 0; number >= kTwoFilters && i < number - kTwoFilters + 2; ++i) {
      any(any_field(random));
    }
    if (random() % 5 == 0) any(group_by);
    if (random() % 3 == 0) filter.verdict = random() % 2 == 0 ? Verdict::Reject : Verdict::Rework;
    if (random() % 3 == 0) filter.source.reset();
    if (random() % 3 == 0) {
      const auto from = static_cast<std::int64_t>(random() % kSize);
      if (random() % 2 == 0) filter.from_ns = from / 8;
      if (random() % 2 == 0) filter.to_ns = 36'100 - from / 30;
      if (random() % 3 == 0) filter.received_from_ns = from;
      if (random() % 3 == 0) filter.received_to_ns = from + 9'000;
    }
    filter.history = random() % 4 == 0;
    if (random() % 16 == 0) filter.as_of_id = static_cast<std::int64_t>(random() % kSize);
    return filter;
  }

  /// @param part one of so many of all combinations, drawn
  void check(const std::string& state, int part = rounds(60, 8)) {
    CAPTURE(state);
    std::vector<bool> current(sample.rows.size());
    for (std::size_t i = 0; i < current.size(); ++i) {
      current[i] = sample.is_current(i, sample.rows.size());
    }
    for (std::size_t number = 0; number < kFilters; ++number) {
      for (const TextColumn& by : kTextColumns) {
        if (random() % static_cast<unsigned>(part) != 0) continue;
        const MeasurementFilter asked = filter(number, by.field);
        std::vector<bool> then = current;
        for (std::size_t i = 0; asked.as_of_id && i < then.size(); ++i) {
          then[i] = sample.is_current(i, static_cast<std::size_t>(*asked.as_of_id));
        }
        CAPTURE(number);
        CAPTURE(by.column);
        CHECK(found(asked, by.field) == expected(then, asked, by.field));
      }
    }
  }

  std::int64_t count(const std::string& from) const {
    return query_integer("SELECT count(*) FROM " + from);
  }

  std::mt19937 random;
  Sample sample;
  std::vector<std::optional<std::string>> texts = reserved();

 private:
  static std::vector<std::optional<std::string>> reserved() {
    std::vector<std::optional<std::string>> texts;
    texts.reserve(2 * kSize);
    return texts;
  }
};

}  // namespace

TEST_CASE("a kind that no row has is not asked for, and is no damage") {
  const MeasurementFilter by_source{.source = Source::Gauge};
  const MeasurementFilter by_verdict{.verdict = Verdict::Good, .source = std::nullopt};
  for (const int kind : {0, 7, 24, 255}) {
    CHECK_FALSE(is_asked(by_source, kind));
    CHECK_FALSE(is_asked(by_verdict, kind));
  }
  CHECK(is_asked(by_source, 9));
  CHECK(is_asked(by_verdict, 9));
}

TEST_CASE("a summary is what a pass over the rows gives, whatever the index holds of them" *
          doctest::skip(kUnderThreadSanitizer)) {
  const unsigned seed = std::random_device{}();
  CAPTURE(seed);
  Shop shop(seed);
  const bool is_deep = rounds(0, 1) == 1;  // a verification derives the whole index
  shop.index(1'000'000);
  REQUIRE(shop.count("measurement_nodes WHERE level = 1 AND paired = 1") == 1);
  REQUIRE(shop.count("measurement_columns") == 35);
  REQUIRE(shop.count("measurement_pairs WHERE field = 4 AND by_field = 3") == 1);
  REQUIRE(shop.count("measurement_pairs WHERE field = 1 OR (by_field = 1 AND field > 0)") == 0);
  REQUIRE(shop.count("measurement_pairs WHERE field = 0 AND by_field = 0") == 1);
  REQUIRE(shop.count("measurement_pairs WHERE by_field = 0") > 4);
  shop.check("indexed", rounds(16, 1));

  shop.correct(20);
  shop.check("some of it stale, or mended meanwhile");
  shop.index(1'000'000);
  REQUIRE(shop.count("measurement_nodes WHERE stale = 1") == 0);
  shop.check("mended");
  if (is_deep) CHECK(shop.database->verify()->findings.empty());

  // As an earlier release leaves it.
  shop.execute("DELETE FROM measurement_columns");
  shop.execute("DELETE FROM measurement_pairs");
  shop.execute("UPDATE measurement_nodes SET paired = 0");
  if (is_deep) CHECK(shop.database->verify()->findings.empty());
  shop.check("without columns and pairs");
  shop.index(20);
  shop.check("with columns of some blocks");
  shop.index(1'000'000);
  REQUIRE(shop.count("measurement_nodes WHERE paired = 0") == 0);
  REQUIRE(shop.count("measurement_columns") == 35);
  REQUIRE(shop.count("measurement_pairs WHERE field = 4 AND by_field = 3") == 1);
  shop.check("with all of them again");
  if (is_deep) CHECK(shop.database->verify()->findings.empty());

  // As releases left it that summed up the values before their correction to 20 °C.
  shop.execute(
      "UPDATE measurement_aggregates SET statistics = (SELECT statistics FROM "
      "measurement_aggregates WHERE level = 1 LIMIT 1) WHERE level = 1 OR node > 1");
  shop.execute("DELETE FROM measurement_columns WHERE block > 1");
  shop.execute(migration(11));
  REQUIRE(shop.count("measurement_nodes WHERE stale = 1 AND paired = 0") == 34);
  REQUIRE(shop.count("measurement_nodes WHERE stale = 0 AND level = 0 AND node < 2") == 2);
  shop.check("with what was summed up before the correction");
  shop.index(1'000'000);
  shop.check("and summed up again");
  CHECK(shop.database->verify()->findings.empty());

  shop.execute("DELETE FROM measurement_pairs WHERE field = 0 AND by_field = 1");
  CHECK(shop.database->verify()->findings.size() == 1);
  shop.check("without some of the tuples");
  shop.execute("DELETE FROM measurement_pairs WHERE by_field = 0");
  if (is_deep) CHECK(shop.database->verify()->findings.size() == 1);
  shop.check("without tuples");
}
