#include "sqlite/migrator.hpp"

#include <vector>

#include "fixture.hpp"
#include "sqlite/database_file.hpp"
#include "store/storage_failure.hpp"

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
  const auto older = sqlite::open_database(fixture.options, fixture.clock);
  REQUIRE(older.has_error());
  CHECK(older.error().code == ErrorCode::DatabaseNewer);
}

TEST_CASE("setups of before become documents, and one that does not fit its seal is still found") {
  constexpr std::size_t kBefore = 10;
  TempDirectory directory;
  OpenOptions options;
  options.directory = directory.path();
  REQUIRE(prepare_file(options, sqlite::migrations().first(kBefore), 7).has_value());
  {
    sqlite::Connection connection(directory.file(), sqlite::Mode::Write);
    connection.execute(
        "INSERT INTO documents VALUES (2, 'G-07', '{}', 5, NULL, row_digest(2, 'G-07', '{}', 5, "
        "NULL));"
        "INSERT INTO setups (name, text, modified_at, caller, seal) VALUES "
        "('sealed', '{}', 5, 'press-3', row_digest('sealed', '{}', 5, 'press-3')),"
        "('unsealed', '{}', 5, NULL, NULL),"
        "('altered', '{1}', 5, NULL, row_digest('altered', '{}', 5, NULL))");
  }
  REQUIRE(prepare_file(options, sqlite::migrations(), 8).has_value());
  ManualClock clock;
  auto database = sqlite::open_database(options, clock);
  REQUIRE(database.has_value());
  const auto text_of = [&](DocumentKind kind, const char* name) {
    return (*database)->readers().wait([=](const Stores& stores) -> Result<std::string> {
      const auto found = stores.documents.find(kind, name);
      return found ? found->text + found->caller.value_or("") : "none";
    });
  };
  CHECK(text_of(DocumentKind::Setup, "sealed").value() == "{}press-3");
  CHECK(text_of(DocumentKind::Setup, "unsealed").value() == "{}");
  CHECK(text_of(DocumentKind::GaugeInUse, "G-07").value() == "{}");
  CHECK(text_of(DocumentKind::Plan, "sealed").value() == "none");
  CHECK(text_of(DocumentKind::Setup, "altered").error().code == ErrorCode::StorageCorrupt);
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
