#include "db/store/tuple_statistics.hpp"

#include <doctest/doctest.h>

#include <random>

#include "damaged_bytes.hpp"

using namespace fitgauge::store;

namespace {

using Text = std::optional<std::string>;
using Tuple = std::pair<std::vector<Text>, int>;  ///< a value of each field, and the kind

/// Rows of three fields with 1, 4 and up to 64 values, and of one with too many.
struct Rows {
  explicit Rows(std::mt19937_64& random) {
    for (auto& column : values) column.resize(kSize);
    for (std::size_t row = 0; row < kSize; ++row) {
      values[0][row] = "H7";
      if (const auto value = random() % 4; value != 3) values[1][row] = std::to_string(value);
      values[2][row] = std::to_string(random() % 64);
      values[3][row] = std::to_string(row);
      kinds.push_back(static_cast<std::uint8_t>(9 + random() % 3));
      measured_nm.push_back(25'000'000 + static_cast<std::int64_t>(random() % 21'000));
    }
    for (std::size_t column = 0; column < kColumns; ++column) {
      const std::vector<std::optional<std::string_view>> views(values[column].begin(),
                                                               values[column].end());
      for (const auto number : columns[column].numbers_of(views)) columns[column].add(number);
    }
  }

  TupleWriter tuples(std::size_t most) const {
    TupleWriter tuples(columns, kinds, most);
    for (std::size_t row = 0; row < kSize; ++row) tuples.add(row, measured_nm[row]);
    return tuples;
  }

  static constexpr std::size_t kSize = 3'000;
  static constexpr std::size_t kColumns = 4;
  std::array<std::vector<Text>, kColumns> values;
  std::array<NumberedColumn, kColumns> columns;
  std::vector<std::uint8_t> kinds;
  std::vector<std::int64_t> measured_nm;
};

/// What is read of the tuples that are written, by the fields taken.
std::map<Tuple, std::string> written(const TupleWriter& writer, std::set<int>& fields) {
  std::vector<std::string> bytes;
  writer.visit_columns([&](int field, std::string column) {
    fields.insert(field);
    bytes.push_back(std::move(column));
  });
  std::vector<TupleColumn> columns(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) REQUIRE(columns[i].read(bytes[i]));
  std::map<Tuple, std::string> found;
  std::size_t first = 0;
  writer.visit_sums([&](const std::string& together) {
    TupleSums sums;
    REQUIRE(sums.read(together));
    CHECK(sums.size() <= kTuplesTogether);
    sums.visit([&](std::size_t tuple, int kind, const auto& read) {
      Tuple key{{}, kind};
      for (const TupleColumn& column : columns) {
        key.first.emplace_back(
            column.values[static_cast<unsigned char>(column.numbers.at(first + tuple))]);
      }
      read().pack(found[key]);
    });
    first += sums.size();
  });
  for (const TupleColumn& column : columns) CHECK(column.numbers.size() == first);
  CHECK(found.size() == first);
  return found;
}

std::map<Tuple, std::string> expected(const Rows& rows, const std::set<int>& fields) {
  std::map<Tuple, ExactStatistics> sums;
  for (std::size_t row = 0; row < Rows::kSize; ++row) {
    Tuple key{{}, rows.kinds[row]};
    for (const int field : fields) {
      key.first.push_back(rows.values.at(column_of_field(field))[row]);
    }
    sums[key].add(rows.measured_nm[row]);
  }
  std::map<Tuple, std::string> found;
  for (const auto& [key, statistics] : sums) statistics.pack(found[key]);
  return found;
}

}  // namespace

TEST_CASE("tuples have the statistics of their rows, by as many fields as are few enough") {
  std::mt19937_64 random(11);
  const Rows rows(random);
  for (const auto& [most, taken] : std::vector<std::pair<std::size_t, std::set<int>>>{
           {4'096, {1, 2, 3}}, {3 * 64, {1, 2}}, {3 * 4, {1, 2}}, {3, {1}}}) {
    CAPTURE(most);
    std::set<int> fields;
    const auto found = written(rows.tuples(most), fields);
    CHECK(fields == taken);
    CHECK(found.size() <= most);
    CHECK(found == expected(rows, fields));
  }
}

TEST_CASE("tuples with the same value of the field with the fewest stand together") {
  std::mt19937_64 random(15);
  const Rows rows(random);
  rows.tuples(4'096).visit_columns([](int field, const std::string& bytes) {
    TupleColumn column;
    REQUIRE(column.read(bytes));
    if (field == 2) CHECK(std::is_sorted(column.numbers.begin(), column.numbers.end()));
  });
}

TEST_CASE("a column of tuples keeps those with a value") {
  std::mt19937_64 random(12);
  const Rows rows(random);
  std::map<int, std::string> bytes;
  rows.tuples(4'096).visit_columns(
      [&](int field, std::string column) { bytes[field] = std::move(column); });
  TupleColumn column;
  REQUIRE(column.read(bytes.at(2)));
  std::vector<std::uint8_t> kept(column.numbers.size(), 1);
  kept[0] = 0;
  CHECK_FALSE(column.keep("4", kept));
  REQUIRE(column.keep("2", kept));
  CHECK(kept[0] == 0);
  for (std::size_t i = 1; i < kept.size(); ++i) {
    const auto& value = column.values[static_cast<unsigned char>(column.numbers[i])];
    REQUIRE((kept[i] == 1) == (value == "2"));
  }
}

TEST_CASE("bytes that are no tuples are refused or read as some, never behind their end") {
  std::mt19937_64 random(13);
  const Rows rows(random);
  std::string whole;
  rows.tuples(200).visit_sums([&](std::string bytes) { whole = std::move(bytes); });
  const auto read_all = [](const std::string& bytes) {
    TupleSums sums;
    std::size_t count = 0;
    if (sums.read(bytes)) sums.visit([&](auto, int, const auto& read) { read(), ++count; });
    return count > 0;
  };
  CHECK(read_all(whole));
  test::read_damaged(whole, random, read_all);
  TupleColumn column;
  CHECK_FALSE(column.read(""));
  CHECK_FALSE(column.read(std::string("\x01\x03H7\x01", 5)));
  CHECK(column.read(std::string("\x01\x03H7\0", 5)));
}
