// A list passes over the nodes that cannot have what it looks for. Real ones have a million rows:
// this one is made up, and says other things than its rows, so that it shows where it was believed.

#include <doctest/doctest.h>

#include "db/sql/index_nodes.hpp"
#include "db/sql/measurement_query.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

constexpr std::int64_t kTheOne = 1'500;
constexpr int kMachine = number_of(TextField::Machine);
constexpr int kOperator = number_of(TextField::Operator);
const IndexNode kNode{2, 0};

/// Two blocks where M1 is operator 7's and M2 operator 8's, but for one row; as if it were the
/// first million.
struct Shop : Fixture {
  Shop() {
    std::vector<MeasurementRow> rows(2 * kBlock, sample_row());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].machine = i % 2 == 0 ? "M1" : "M2";
      rows[i].operator_id = i % 2 == 0 ? "7" : "8";
    }
    rows.at(kTheOne - 1).machine = "M1";
    rows.at(kTheOne - 1).operator_id = "8";
    REQUIRE(append(rows).has_value());
    index_all();
    const auto t = sample_row().measured_at_ns;
    for (const auto& [level, node] :
         {std::pair{0, kNode.ids().last / kBlock - 1}, {2, std::int64_t{0}}}) {
      execute(fmt::format("INSERT INTO measurement_nodes VALUES ({}, {}, {}, {}, {}, {}, 0, 1)",
                          level, node, t, t, t, t));
    }
  }

  void correct_one() {
    MeasurementRow row = sample_row();
    row.correction_of = 3;
    row.correction_reason = "wrong";
    REQUIRE(append(std::span(&row, 1)).has_value());
  }

  /// What the node says of a machine: that it has measurements of this kind.
  void say(std::string_view machine, int kind) {
    execute(fmt::format("INSERT INTO measurement_aggregates VALUES (2, 0, {}, '{}', {}, x'00')",
                        kMachine, machine, kind));
  }

  /// And which machines and operators meet.
  void say_tuples(const std::vector<std::pair<std::string_view, std::string_view>>& rows) {
    std::array<NumberedColumn, kBlockColumns> columns;
    for (auto& column : columns) column.give_up();
    const auto add = [&](int field, std::optional<std::string_view> value) {
      columns.at(column_of_field(field))
          .add(columns.at(column_of_field(field)).numbers_of(std::span(&value, 1)).front());
    };
    columns.at(column_of_field(kMachine)) = columns.at(column_of_field(kOperator)) = {};
    for (const auto& [machine, operator_id] : rows) {
      add(kMachine, machine);
      add(kOperator, operator_id);
    }
    const std::vector<std::uint8_t> kinds(rows.size(), 9);
    PairIndex::Node node;
    TupleWriter(columns, kinds, 4'096).visit_columns([&](int field, std::string bytes) {
      node.pairs[{field, PairIndex::kColumns}] = std::move(bytes);
    });
    sqlite::Connection connection(directory.file(), sqlite::Mode::Write);
    PairIndex index(connection);
    index.erase(kNode);
    index.insert(kNode, node);
  }

  std::vector<std::int64_t> list(const MeasurementFilter& filter) {
    sqlite::Connection connection(directory.file(), sqlite::Mode::Read);
    MeasurementQuery query(connection, "m.id");
    std::vector<std::int64_t> ids, backward;
    const auto into = [](std::vector<std::int64_t>& all) {
      return
          [&all](const sql::Rows& rows) { return all.push_back(rows.get<std::int64_t>(0)), true; };
    };
    const IdSpan all{.first = 1, .last = kLastId};
    query.run(filter, all, ListOrder::OldestFirst, into(ids));
    query.run(filter, all, ListOrder::NewestFirst, into(backward));
    CHECK(std::equal(ids.begin(), ids.end(), backward.rbegin(), backward.rend()));
    return ids;
  }
};

MeasurementFilter the_one() {
  MeasurementFilter filter;
  filter.text(TextField::Machine) = "M1";
  filter.text(TextField::Operator) = "8";
  return filter;
}

const std::vector<std::int64_t> kFound{kTheOne};
const std::vector<std::int64_t> kNone;

}  // namespace

TEST_CASE("a list passes over a node that lacks a value, or the kind of measurement") {
  Shop shop;
  CHECK(shop.list(the_one()) == kFound);  // the node says nothing
  shop.say("M2", 9);
  CHECK(shop.list(the_one()) == kNone);
  shop.say("M1", 9);
  CHECK(shop.list(the_one()) == kFound);
  MeasurementFilter filter = the_one();
  filter.verdict = Verdict::Good;
  CHECK(shop.list(filter) == kFound);
  shop.execute("UPDATE measurement_aggregates SET kind = 11 WHERE level = 2 AND value = 'M1'");
  CHECK(shop.list(filter) == kNone);
  // A part of it is read as before.
  filter.text(TextField::Operator).reset();
  filter.verdict.reset();
  CHECK(shop.list(filter).size() == kBlock + 1);  // one value leads to its blocks
}

TEST_CASE("a list passes over a node whose values do not meet") {
  Shop shop;
  shop.say_tuples({{"M1", "7"}, {"M2", "8"}});
  CHECK(shop.list(the_one()) == kNone);
  shop.say_tuples({{"M1", "7"}, {"M2", "8"}, {"M1", "8"}});
  CHECK(shop.list(the_one()) == kFound);
  shop.say_tuples({{"M1", "7"}});
  CHECK(shop.list(the_one()) == kNone);
}

TEST_CASE("what was corrected is not in what a node says, and is looked for in its rows") {
  Shop shop;
  shop.say_tuples({{"M1", "7"}, {"M2", "8"}});
  MeasurementFilter history = the_one(), now = the_one();
  history.history = true;
  now.as_of_id = kNode.ids().last;
  CHECK(shop.list(history) == kNone);
  CHECK(shop.list(now) == kNone);
  shop.correct_one();
  CHECK(shop.list(the_one()) == kNone);
  CHECK(shop.list(now) == kNone);
  CHECK(shop.list(history) == kFound);
}

TEST_CASE("a list passes over a node of other times") {
  Shop shop;
  MeasurementFilter filter = the_one();
  filter.from_ns = sample_row().measured_at_ns;
  CHECK(shop.list(filter) == kFound);
  shop.execute(
      "UPDATE measurement_nodes SET min_measured_at = 1, max_measured_at = 2 WHERE level = 2");
  CHECK(shop.list(filter) == kNone);
  filter.from_ns.reset();
  CHECK(shop.list(filter) == kFound);
}
