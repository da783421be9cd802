#include "db/store/block_columns.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace fitgauge::store;

namespace {

constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
const std::string kNames[] = {"", "a", "b", std::string(300, 'x')};

std::vector<MeasuredValue> any_values(std::mt19937_64& random, unsigned kinds) {
  std::vector<MeasuredValue> values;
  for (std::int64_t row = 0; row < kBlock; ++row) {
    const auto kind = static_cast<std::int64_t>(random() % kinds);
    MeasuredValue value{.measured_nm = 25'000'000 + static_cast<std::int64_t>(random() % 40'000),
                        .lower_limit_nm = 25'000'000 + kind,
                        .upper_limit_nm = 25'021'000};
    if (random() % 50 == 0) value.measured_nm = random() % 2 == 0 ? kLeast : kMost;
    if (random() % 50 == 0) value.lower_limit_nm = random() % 2 == 0 ? kLeast : kMost;
    if (kinds > 1 && random() % 3 != 0) value.subgroup = kNames[random() % 4];
    values.push_back(value);
  }
  return values;
}

std::string encoded(const std::vector<MeasuredValue>& values) {
  ValueBlockWriter writer;
  for (const MeasuredValue& value : values) writer.add(value);
  return writer.encode();
}

}  // namespace

TEST_CASE("the values of a block come back as they were") {
  std::mt19937_64 random(3);
  ValueBlock block;
  for (const unsigned kinds : {1U, 2U, 300U, 1'000'000U}) {
    const std::vector<MeasuredValue> values = any_values(random, kinds);
    const std::string bytes = encoded(values);
    REQUIRE(block.read(bytes));
    RowSet some;
    for (std::int64_t row = 0; row < kBlock; ++row) {
      if (random() % 3 != 0) some.add(row);
    }
    constexpr std::int64_t kFirst = 7'168;
    const IdSpan among{.first = kFirst + 5, .last = kFirst + kBlock - 9};
    std::int64_t next = among.first;
    const bool all = block.visit_runs(some, kFirst, among, [&](const MeasuredRun& run) {
      REQUIRE(!run.values.empty());
      for (const MeasuredRun::Value& found : run.values) {
        while (!some.contains(next - kFirst)) ++next;
        REQUIRE(found.id == next);
        REQUIRE(found.number == found.id);
        const MeasuredValue& expected = values[static_cast<std::size_t>(next++ - kFirst)];
        REQUIRE(found.measured_nm == expected.measured_nm);
        REQUIRE(run.lower_limit_nm == expected.lower_limit_nm);
        REQUIRE(run.upper_limit_nm == expected.upper_limit_nm);
        REQUIRE(run.subgroup == expected.subgroup);
      }
      return true;
    });
    CHECK(all);
    while (next <= among.last && !some.contains(next - kFirst)) ++next;
    CHECK(next == among.last + 1);
    CHECK_FALSE(
        block.visit_runs(RowSet::all(), kFirst, among, [](const MeasuredRun&) { return false; }));
  }
}

TEST_CASE("values of one size take three bytes each") {
  std::vector<MeasuredValue> values(
      kBlock,
      {.measured_nm = 25'010'500, .lower_limit_nm = 25'000'000, .upper_limit_nm = 25'021'000});
  CHECK(encoded(values).size() < 3 * kBlock + 16);
}

TEST_CASE("bytes that are not of a block are refused") {
  std::mt19937_64 random(4);
  const std::string bytes = encoded(any_values(random, 20));
  ValueBlock block;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    REQUIRE_FALSE(block.read(std::string_view(bytes).substr(0, size)));
  }
  CHECK_FALSE(block.read(bytes + '\0'));
  CHECK_FALSE(block.read(std::string(2'000, '\xFF')));
  for (int i = 0; i < 2'000; ++i) {  // changed bytes: read or refused, no byte beyond them
    std::string changed = bytes;
    for (int k = 0; k < 3; ++k) changed[random() % changed.size()] = static_cast<char>(random());
    block.read(changed);
  }
}
