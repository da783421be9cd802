#include "db/sqlite/database_file.hpp"
#include "db/store/stores.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

std::vector<sqlite::Migration> with(sqlite::Migration added) {
  const auto known = sqlite::migrations();
  std::vector<sqlite::Migration> all(known.begin(), known.end());
  added.number = static_cast<int>(all.size()) + 1;
  all.push_back(added);
  return all;
}

std::int64_t query(const std::filesystem::path& file, const std::string& sql) {
  return sqlite::Connection(file, sqlite::Mode::Read).query_integer(sql);
}

}  // namespace

TEST_CASE("migrations are numbered from 1 without a gap") {
  int expected = 1;
  for (const sqlite::Migration& migration : sqlite::migrations()) {
    CHECK(migration.number == expected++);
    CHECK_FALSE(migration.sql.empty());
  }
  CHECK(expected > 1);
}

TEST_CASE("an upgrade keeps the rows and leaves a backup of the state before") {
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  fixture.database.reset();
  const auto old = static_cast<int>(sqlite::migrations().size());
  const auto newer = with({.name = "more", .sql = "CREATE TABLE more (x INTEGER) STRICT"});
  REQUIRE(prepare_file(fixture.options, newer, 7).has_value());

  CHECK(query(fixture.directory.file(), "SELECT count(*) FROM more") == 0);
  CHECK(query(fixture.directory.file(), "SELECT count(*) FROM measurements") == 1);
  CHECK(query(fixture.directory.file(), "PRAGMA user_version") == old + 1);
  const std::filesystem::path backup =
      fixture.directory.path() / ("fitgauge.db.schema-" + std::to_string(old) + ".backup");
  CHECK(query(backup, "SELECT count(*) FROM measurements") == 1);
  CHECK(query(backup, "PRAGMA user_version") == old);

  // The older build refuses it now.
  CHECK(sqlite::open_database(fixture.options, fixture.clock).error().code ==
        ErrorCode::DatabaseNewer);
}

TEST_CASE("an upgrade that fails leaves the old state") {
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  fixture.database.reset();
  const auto broken =
      with({.name = "broken", .sql = "CREATE TABLE more (x); INSERT INTO nowhere VALUES (1)"});
  CHECK_THROWS(static_cast<void>(prepare_file(fixture.options, broken, 7)));
  CHECK(query(fixture.directory.file(), "SELECT count(*) FROM sqlite_schema WHERE name = 'more'") ==
        0);
  fixture.open();
  CHECK(fixture.last_id() == 1);
}
