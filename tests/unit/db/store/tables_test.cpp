#include "db/store/tables_store.hpp"

#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

TableContent iso_cells() {
  return {.cells = {{"it_grades", "IT7", 18'000'000, 30'000'000, 21'000},
                    {"it_grades", "IT7", 10'000'000, 18'000'000, 18'000},
                    {"shaft", "ei_t", 10'000'000, 14'000'000, std::nullopt}},
          .custom = {}};
}

Result<TableRevision> import(Fixture& fixture, TableContent content,
                             std::optional<std::int64_t> parent) {
  return fixture.write([&](Stores& stores) {
    return stores.tables.import({.content = std::move(content),
                                 .source = "ISO 286-1:2010",
                                 .parent = parent,
                                 .caller = "admin"},
                                5);
  });
}

std::optional<LoadedTables> latest(Fixture& fixture) {
  return *fixture.read([](const Stores& stores) -> Result<std::optional<LoadedTables>> {
    return stores.tables.load_latest();
  });
}

}  // namespace

TEST_CASE("the digest of tables does not depend on their order and sees every number") {
  const TableContent content = iso_cells();
  TableContent other = content;
  std::swap(other.cells[0], other.cells[2]);
  CHECK(digest_of(other) == digest_of(content));
  other.cells[0].value_nm = 0;
  CHECK(digest_of(other) != digest_of(content));
  other = content;
  other.custom.push_back({"hole", "H7", 0, 1, 0, 0});
  CHECK(digest_of(other) != digest_of(content));
}

TEST_CASE("a revision is loaded as it was imported") {
  Fixture fixture;
  CHECK_FALSE(latest(fixture).has_value());
  const auto imported = import(fixture, iso_cells(), std::nullopt);
  REQUIRE(imported.has_value());
  CHECK(imported->number == 1);
  CHECK(imported->id == "1-" + to_hex(imported->digest).substr(0, 8));
  CHECK(imported->source == "ISO 286-1:2010");
  CHECK(imported->caller == "admin");
  CHECK(imported->created_at_ns == 5);

  const auto loaded = latest(fixture);
  REQUIRE(loaded.has_value());
  CHECK(loaded->computed == loaded->revision.digest);
  CHECK(loaded->content.cells.size() == 3);
  CHECK(loaded->content.cells[0] == iso_cells().cells[1]);
  CHECK(loaded->content.cells[2].value_nm == std::nullopt);
}

TEST_CASE("a custom column is a revision of its own on the same cells") {
  Fixture fixture;
  REQUIRE(import(fixture, iso_cells(), std::nullopt).has_value());
  TableContent content = iso_cells();
  content.custom = {{"hole", "H7", 18'000'000, 30'000'000, 15'000, -3'000}};
  const auto second = import(fixture, content, 1);
  REQUIRE(second.has_value());
  CHECK(second->number == 2);
  CHECK(second->parent == 1);
  CHECK(latest(fixture)->content.custom == content.custom);

  const auto by_id = [&](const std::string& id) {
    return *fixture.read([&](const Stores& stores) -> Result<std::optional<LoadedTables>> {
      return stores.tables.load(id);
    });
  };
  CHECK(by_id(second->id)->revision.number == 2);
  CHECK_FALSE(by_id("2-00000000").has_value());
  CHECK_FALSE(by_id("nonsense").has_value());
  CHECK(*fixture.read([](const Stores& stores) -> Result<std::size_t> {
    return stores.tables.list().size();
  }) == 2);
  CHECK(fixture.query_integer("SELECT count(*) FROM table_cells") == 3);
}

TEST_CASE("an import on top of an outdated revision is refused") {
  Fixture fixture;
  REQUIRE(import(fixture, iso_cells(), std::nullopt).has_value());
  CHECK(import(fixture, iso_cells(), std::nullopt).error().code == ErrorCode::PreconditionFailed);
  CHECK(import(fixture, iso_cells(), 7).error().code == ErrorCode::PreconditionFailed);
}

TEST_CASE("cells that are not a table are refused with their place") {
  Fixture fixture;
  TableContent content = iso_cells();
  SUBCASE("twice") { content.cells.push_back(content.cells[0]); }
  SUBCASE("empty range") { content.cells[0].up_to_nm = content.cells[0].over_nm; }
  SUBCASE("lower above upper") { content.custom = {{"hole", "H7", 0, 1, -1, 0}}; }
  const auto refused = import(fixture, content, std::nullopt);
  REQUIRE(refused.has_error());
  CHECK(refused.error().code == ErrorCode::TableRowsInvalid);
  CHECK_FALSE(refused.error().where.empty());
}

TEST_CASE("a changed cell shows in the computed digest") {
  Fixture fixture;
  REQUIRE(import(fixture, iso_cells(), std::nullopt).has_value());
  fixture.execute("UPDATE table_cells SET value_nm = 53000 WHERE column_name = 'IT7'");
  const auto loaded = latest(fixture);
  CHECK(loaded->computed != loaded->revision.digest);
  const auto computed = fixture.read(
      [](const Stores& stores) -> Result<Digest> { return stores.tables.compute_digest(1); });
  CHECK(computed.value() == loaded->computed);
}
