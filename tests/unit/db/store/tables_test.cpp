#include "db/store/tables_store.hpp"

#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

iso286::NominalSizeRange range(std::int64_t over_nm, std::int64_t up_to_nm) {
  return {.over = Length::nanometres(over_nm), .up_to = Length::nanometres(up_to_nm)};
}

iso286::TableData iso_cells() {
  using enum iso286::TableId;
  return {
      .cells = {{ItGrades, range(18'000'000, 30'000'000), "IT7", Length::nanometres(21'000)},
                {ItGrades, range(10'000'000, 18'000'000), "IT7", Length::nanometres(18'000)},
                {ShaftFundamentalDeviations, range(10'000'000, 14'000'000), "ei_t", std::nullopt}},
      .custom_columns = {}};
}

/// The class H7 with one row.
std::vector<iso286::CustomColumn> custom_h7(iso286::NominalSizeRange range, std::int64_t upper_nm,
                                            std::int64_t lower_nm) {
  return {
      {iso286::Feature::Hole,
       "H7",
       {{range, {.upper = Length::nanometres(upper_nm), .lower = Length::nanometres(lower_nm)}}}}};
}

Result<TableRevision> import(Fixture& fixture, iso286::TableData content,
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
  return fixture.see([](const Stores& stores) { return stores.tables.load_latest(); });
}

}  // namespace

TEST_CASE("the digest of tables does not depend on their order and sees every number") {
  const iso286::TableData content = iso_cells();
  iso286::TableData other = content;
  std::swap(other.cells[0], other.cells[2]);
  CHECK(digest_of(other) == digest_of(content));
  other.cells[0].value = Length();
  CHECK(digest_of(other) != digest_of(content));
  other = content;
  other.custom_columns = custom_h7(range(0, 1), 0, 0);
  CHECK(digest_of(other) != digest_of(content));
}

TEST_CASE("a revision is loaded as it was imported") {
  Fixture fixture;
  CHECK_FALSE(latest(fixture).has_value());
  const auto imported = import(fixture, iso_cells(), std::nullopt).value();
  CHECK(imported.number == 1);
  CHECK(imported.id == "1-" + to_hex(imported.digest).substr(0, 8));
  CHECK(imported.source == "ISO 286-1:2010");
  CHECK(imported.caller == "admin");
  CHECK(imported.created_at_ns == 5);

  const auto loaded = latest(fixture).value();
  CHECK(loaded.computed == loaded.revision.digest);
  REQUIRE(loaded.content.has_value());
  CHECK(loaded.content->cells.size() == 3);
  CHECK(loaded.content->cells[0] == iso_cells().cells[1]);
  CHECK(loaded.content->cells[2].value == std::nullopt);
}

TEST_CASE("the tables of the standard are loaded in the order in which they are compiled in") {
  Fixture fixture;
  REQUIRE(import(fixture, iso286::compiled_in_tables(), std::nullopt).has_value());
  const auto loaded = latest(fixture).value();
  CHECK(loaded.computed == loaded.revision.digest);
  CHECK(iso286::has_compiled_in_cells(*loaded.content));
}

TEST_CASE("a custom column is a revision of its own on the same cells") {
  Fixture fixture;
  REQUIRE(import(fixture, iso_cells(), std::nullopt).has_value());
  iso286::TableData content = iso_cells();
  content.custom_columns = custom_h7(range(18'000'000, 30'000'000), 15'000, -3'000);
  const auto second = import(fixture, content, 1).value();
  CHECK(second.number == 2);
  CHECK(second.parent == 1);
  CHECK(latest(fixture)->content->custom_columns == content.custom_columns);

  const auto by_id = [&](const std::string& id) {
    return fixture.see([&](const Stores& stores) { return stores.tables.load(id); });
  };
  CHECK(by_id(second.id)->revision.number == 2);
  CHECK_FALSE(by_id("2-00000000").has_value());
  CHECK_FALSE(by_id("nonsense").has_value());
  CHECK(fixture.see([](const Stores& stores) { return stores.tables.list().size(); }) == 2);
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
  iso286::TableData content = iso_cells();
  SUBCASE("twice") { content.cells.push_back(content.cells[0]); }
  SUBCASE("empty range") { content.cells[0].range.up_to = content.cells[0].range.over; }
  SUBCASE("lower above upper") { content.custom_columns = custom_h7(range(0, 1), -1, 0); }
  const auto refused = import(fixture, content, std::nullopt);
  CHECK(refused.error().code == ErrorCode::TableRowsInvalid);
  CHECK_FALSE(refused.error().where.empty());
}

TEST_CASE("a table that no version knows is no content") {
  Fixture fixture;
  REQUIRE(import(fixture, iso_cells(), std::nullopt).has_value());
  fixture.execute("UPDATE table_cells SET table_name = 'it' WHERE column_name = 'IT7'");
  const auto loaded = latest(fixture);
  CHECK(loaded->content.error() == Error{ErrorCode::TablesInconsistent, "unknown table it", "it"});
  CHECK(loaded->computed != loaded->revision.digest);
}

TEST_CASE("a changed cell shows in the computed digest") {
  Fixture fixture;
  REQUIRE(import(fixture, iso_cells(), std::nullopt).has_value());
  fixture.execute("UPDATE table_cells SET value_nm = 53000 WHERE column_name = 'IT7'");
  const auto loaded = latest(fixture);
  CHECK(loaded->computed != loaded->revision.digest);
  CHECK(fixture.see([](const Stores& stores) { return stores.tables.compute_digest(1); }) ==
        loaded->computed);
}
