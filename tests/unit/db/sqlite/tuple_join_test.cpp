// A node over nodes has what these have together: they are made up, as a million rows take long.

#include <doctest/doctest.h>

#include <random>

#include "db/sql/index_nodes.hpp"
#include "fixture.hpp"

using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

constexpr int kMachineField = number_of(TextField::Machine);
constexpr int kGauge = number_of(TextField::Gauge);
constexpr int kOperatorField = number_of(TextField::Operator);

using Tuple = std::tuple<std::string, std::string, int>;
using Sums = std::map<Tuple, ExactStatistics>;

/// The tuples of a hundred rows, by machine, gauge and, of all nodes but one, operator.
PairIndex::Node any_node(std::mt19937_64& random, bool has_operator, Sums& all) {
  std::array<NumberedColumn, kBlockColumns> columns;
  std::vector<std::uint8_t> kinds;
  std::vector<std::int64_t> lengths;
  for (auto& column : columns) column.give_up();
  for (const int field : {kMachineField, kGauge, kOperatorField}) {
    if (field != kOperatorField || has_operator) columns[column_of_field(field)] = {};
  }
  const auto add = [&](int field, std::string_view value) {
    NumberedColumn& column = columns[column_of_field(field)];
    const std::optional<std::string_view> one(value);
    if (column.fits()) column.add(column.numbers_of(std::span(&one, 1)).front());
  };
  for (int row = 0; row < 100; ++row) {
    const std::string machine = "M" + std::to_string(random() % 20);
    const std::string gauge = "G" + std::to_string(random() % 15);
    add(kMachineField, machine);
    add(kGauge, gauge);
    add(kOperatorField, "42");
    kinds.push_back(static_cast<std::uint8_t>(9 + random() % 2));
    lengths.push_back(static_cast<std::int64_t>(random() % 1000));
    all[{machine, gauge, kinds.back()}].add(lengths.back());
  }
  TupleWriter writer(columns, kinds, 4'096);
  for (std::size_t row = 0; row < lengths.size(); ++row) writer.add(row, lengths[row]);
  PairIndex::Node node;
  writer.visit_columns([&](int field, std::string bytes) { node.pairs[{field, 0}] = bytes; });
  int by = 0;
  writer.visit_sums([&](std::string bytes) { node.pairs[{PairIndex::kSums, by++}] = bytes; });
  return node;
}

}  // namespace

TEST_CASE("the tuples of a node are those of the nodes below, by the fields that all have") {
  Fixture fixture;
  fixture.database.reset();
  sqlite::Connection connection(fixture.directory.file(), sqlite::Mode::Write);
  PairIndex index(connection);
  std::mt19937_64 random(14);
  Sums expected;
  const IndexNode parent{2, 3};
  for (std::int64_t i = 0; i < kFanOut; ++i) {
    index.insert(parent.child(i), any_node(random, i != 5, expected));
  }
  const PairIndex::Node joined = index.derive(parent);
  CHECK_FALSE(joined.pairs.contains({kOperatorField, 0}));
  TupleColumn machines, gauges;
  REQUIRE(machines.read(joined.pairs.at({kMachineField, 0})));
  REQUIRE(gauges.read(joined.pairs.at({kGauge, 0})));
  REQUIRE(expected.size() > kTuplesTogether);
  REQUIRE(machines.numbers.size() == expected.size());
  std::size_t next = 0;
  const auto check = [&](std::size_t, int kind, const auto& read) {
    const std::size_t tuple = next++;
    const auto value_of = [&](const TupleColumn& column) {
      return std::string(column.values[static_cast<unsigned char>(column.numbers[tuple])].value());
    };
    const ExactStatistics& of = expected.at({value_of(machines), value_of(gauges), kind});
    const ExactStatistics found = read();
    CHECK(found.count() == of.count());
    CHECK(found.mean_mm() == of.mean_mm());
    CHECK(found.min_nm() == of.min_nm());
    CHECK(found.max_nm() == of.max_nm());
    if (of.count() > 1) CHECK(found.standard_deviation_mm() == of.standard_deviation_mm());
  };
  for (int by = 0; next < expected.size(); ++by) {
    TupleSums sums;
    REQUIRE(sums.read(joined.pairs.at({PairIndex::kSums, by})));
    sums.visit(check);
  }
  CHECK(next == expected.size());
}

TEST_CASE("that a node has no tuples is written down as well") {
  Fixture fixture;
  fixture.database.reset();
  sqlite::Connection connection(fixture.directory.file(), sqlite::Mode::Write);
  PairIndex index(connection);
  for (const IndexNode& node : {IndexNode{1, 0}, IndexNode{2, 0}}) {
    const PairIndex::Node none = index.derive(node);
    CHECK(none.pairs.at({PairIndex::kSums, 0}).empty());
    index.insert(node, none);
    CHECK(index.is_stored(node, none));
    index.erase(node);
    CHECK(index.count_surplus() == 0);
  }
}
