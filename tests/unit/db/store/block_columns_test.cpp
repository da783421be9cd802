#include "db/store/block_columns.hpp"

#include <doctest/doctest.h>

#include <random>

#include "damaged_bytes.hpp"
#include "db/store/tuple_statistics.hpp"

using namespace fitgauge::store;

namespace {

constexpr auto kGreatest = std::numeric_limits<std::int64_t>::max();

struct Row {
  std::array<std::optional<std::string>, kBlockColumns> texts{};
  int kind = 0;
  bool is_current = true;
  std::int64_t measured_nm = 0;
};

/// Column i has up to as many values as 2 to the power of i, and now and then none.
std::vector<Row> any_rows(std::mt19937_64& random, std::int64_t spread) {
  std::vector<Row> rows(kBlockRows);
  for (Row& row : rows) {
    for (std::size_t column = 0; column < kBlockColumns; ++column) {
      const auto value = random() % (std::uint64_t{1} << column);
      if (value % 7 != 3) row.texts[column] = std::string(value % 5, 'x') + std::to_string(value);
    }
    row.kind = static_cast<int>(random() % 3 + 9);
    row.is_current = random() % 10 != 0;
    row.measured_nm = 25'000'000 + static_cast<std::int64_t>(random() % 64) * spread;
  }
  return rows;
}

std::optional<std::string> encoded(const std::vector<Row>& rows) {
  BlockColumnsWriter writer;
  const Row* before = nullptr;
  for (const Row& row : rows) {
    for (std::size_t column = 0; column < kBlockColumns; ++column) {
      if (before != nullptr && before->texts[column] == row.texts[column]) {
        writer.repeat_text(column);
      } else {
        writer.add_text(column, row.texts[column]);
      }
    }
    writer.add(row.kind, row.is_current, row.measured_nm);
    before = &row;
  }
  return writer.encode();
}

}  // namespace

TEST_CASE("the columns of a block come back as they were") {
  std::mt19937_64 random(7);
  for (const std::int64_t spread : {std::int64_t{0}, std::int64_t{700}, kGreatest / 64 / 100}) {
    const std::vector<Row> rows = any_rows(random, spread);
    const auto bytes = encoded(rows).value();
    BlockColumns block;
    REQUIRE(block.read(bytes));
    for (std::size_t i = 0; i < kBlockRows; ++i) {
      const std::size_t kind = block.kind_of_row(i);
      REQUIRE(block.kind(kind) == rows[i].kind);
      REQUIRE(block.is_current(kind) == rows[i].is_current);
      REQUIRE(block.measured_nm(i) == rows[i].measured_nm);
    }
    for (std::size_t column = 0; column < kBlockColumns; ++column) {
      BlockColumns::Column found;
      REQUIRE(block.read(column, found) == (column <= 8));
      if (column > 8) continue;
      for (std::size_t i = 0; i < kBlockRows; ++i) {
        REQUIRE(found.values[found.rows[i]] == rows[i].texts[column]);
      }
    }
  }
}

TEST_CASE("columns are not written of lengths that are too far from each other, nor of few rows") {
  std::mt19937_64 random(8);
  std::vector<Row> rows = any_rows(random, 700);
  rows[3].measured_nm = -kGreatest;
  CHECK_FALSE(encoded(rows).has_value());
  rows = any_rows(random, 700);
  rows.pop_back();
  CHECK_FALSE(encoded(rows).has_value());
}

TEST_CASE("bytes that are no columns are refused or read as some, never behind their end") {
  std::mt19937_64 random(9);
  const std::string whole = *encoded(any_rows(random, 700));
  const auto read_all = [](const std::string& bytes) {
    BlockColumns block;
    const bool is_read = block.read(bytes);
    BlockColumns::Column column;
    for (std::size_t i = 0; is_read && i < kBlockColumns; ++i) {
      if (!block.read(i, column)) continue;
      bool all = true;
      for (std::size_t row = 0; row < kBlockRows; ++row) {
        all = all && column.rows[row] < column.values.size();
        all = all && block.kind_of_row(row) < block.kinds();
      }
      REQUIRE(all);
    }
    return is_read;
  };
  test::read_damaged(whole, random, read_all);
}

TEST_CASE("statistics of pairs come back as they were") {
  PairStatistics pairs;
  for (const char* value : {"", "a", "M7"}) {
    for (const auto& by : {std::optional<std::string>(), std::optional<std::string>("bore-3")}) {
      ExactStatistics& of = pairs[value][by][9];
      for (const std::int64_t nm : {25'013'000, -25'013'000, 0}) of.add(nm);
      pairs[value][by][11].add(100'000'000'000'000);
      pairs[value][by][11].add(-100'000'000'000'000);
    }
  }
  CHECK(count_of(pairs) == 12);
  PairStatistics again;
  visit_values(encode(pairs), [&](std::string_view value, std::string_view bytes) {
    visit_pairs_of(bytes, [&](std::optional<std::string_view> by, int kind,
                              const ExactStatistics& statistics) {
      again[std::string(value)][by ? std::optional(std::string(*by)) : std::nullopt][kind] =
          statistics;
    });
    return true;
  });
  CHECK(encode(again) == encode(pairs));
  CHECK(again["M7"][std::nullopt][9].encode() == pairs["M7"][std::nullopt][9].encode());
  CHECK(again["M7"]["bore-3"][11].encode() == pairs["M7"]["bore-3"][11].encode());
}
