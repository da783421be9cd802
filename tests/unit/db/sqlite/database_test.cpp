#include "db/store/database.hpp"

#include <unistd.h>

#include <sys/stat.h>

#include "db/sqlite/connection.hpp"
#include "db/sqlite/database_file.hpp"
#include "fixture.hpp"
#include "full_disk.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

Error refusal(const TempDirectory& directory, OpenOptions options = {}) {
  const ManualClock clock;
  options.directory = directory.path();
  return sqlite::open_database(options, clock).error();
}

/// Refused with this code, and every byte still there.
void check_refused_untouched(const TempDirectory& directory, ErrorCode code) {
  const std::string before = content_of(directory.file());
  const Error error = refusal(directory);
  CHECK_MESSAGE(error.code == code, error.message);
  CHECK(error.message.find(directory.file().string()) != std::string::npos);
  CHECK(content_of(directory.file()) == before);
}

void create_database(const TempDirectory& directory) {
  const ManualClock clock;
  OpenOptions options;
  options.directory = directory.path();
  REQUIRE(sqlite::open_database(options, clock).has_value());
}

void alter(const TempDirectory& directory, const std::string& sql) {
  sqlite::Connection(directory.file(), sqlite::Mode::Write).execute(sql);
}

}  // namespace

TEST_CASE("a new database is created and opened again") {
  Fixture fixture;
  CHECK(fixture.database->health().state == HealthState::Ok);
  REQUIRE(fixture.append(sample_row()).has_value());
  fixture.database.reset();
  CHECK_FALSE(std::filesystem::exists(fixture.directory.path() / "fitgauge.db-wal"));
  CHECK_FALSE(std::filesystem::exists(fixture.directory.path() / "fitgauge.db.new"));
  fixture.open();
  CHECK(fixture.last_id() == 1);
}

TEST_CASE("a second instance on the directory is refused") {
  Fixture fixture;
  CHECK(refusal(fixture.directory).code == ErrorCode::DatabaseInUse);
  fixture.database.reset();
  fixture.open();
}

TEST_CASE("an existing file that is not ours is refused and left as it is") {
  const TempDirectory directory;
  SUBCASE("empty") { write_file(directory.file(), ""); }
  SUBCASE("garbage") { write_file(directory.file(), std::string(4096, '\xAB')); }
  SUBCASE("shorter than a header") { write_file(directory.file(), "SQLite"); }
  SUBCASE("a database of another program") {
    sqlite::Connection(directory.file(), sqlite::Mode::Create).execute("CREATE TABLE t (x)");
  }
  check_refused_untouched(directory, ErrorCode::DatabaseForeign);
}

TEST_CASE("a log without its database is refused") {
  const TempDirectory directory;
  write_file(directory.path() / "fitgauge.db-wal", "log");
  CHECK(refusal(directory).code == ErrorCode::DatabaseForeign);
}

TEST_CASE("what a killed creation left behind is no obstacle") {
  const TempDirectory directory;
  write_file(directory.path() / "fitgauge.db.new", "half");
  write_file(directory.path() / "fitgauge.db.new-journal", "half");
  create_database(directory);
}

TEST_CASE("a newer schema and altered migrations are refused") {
  const TempDirectory directory;
  create_database(directory);
  SUBCASE("newer") {
    alter(directory, "PRAGMA user_version = 999");
    check_refused_untouched(directory, ErrorCode::DatabaseNewer);
  }
  SUBCASE("altered") {
    alter(directory, "UPDATE schema_migrations SET checksum = randomblob(32) WHERE number = 1");
    check_refused_untouched(directory, ErrorCode::DatabaseForeign);
  }
  SUBCASE("missing") {
    alter(directory, "DELETE FROM schema_migrations WHERE number = 1");
    check_refused_untouched(directory, ErrorCode::DatabaseForeign);
  }
}

TEST_CASE("a damaged page is found at the start") {
  const TempDirectory directory;
  create_database(directory);
  std::string content = content_of(directory.file());
  SUBCASE("in the middle") { content.replace(20'480, 200, 200, '\xFF'); }
  SUBCASE("the schema") { content.replace(100, 300, 300, '\xFF'); }
  SUBCASE("cut off") { content.resize(content.size() - 8'192); }
  write_file(directory.file(), content);
  check_refused_untouched(directory, ErrorCode::StorageCorrupt);
}

TEST_CASE("a large file is checked in the background, and damage stops writes") {
  Fixture fixture;
  fixture.database.reset();
  fixture.options.check_at_open_limit = 0;
  SUBCASE("sound") {
    fixture.open();
    while (fixture.database->health().state == HealthState::Checking) std::this_thread::yield();
    CHECK(fixture.database->health().state == HealthState::Ok);
    CHECK(fixture.append(sample_row()).has_value());
  }
  SUBCASE("damaged") {
    // The free bytes of a page in the middle: reads still work, quick_check sees it.
    std::string content = content_of(fixture.directory.file());
    content.replace(20'480, 200, 200, '\xFF');
    write_file(fixture.directory.file(), content);
    fixture.open();
    while (fixture.database->health().state == HealthState::Checking) std::this_thread::yield();
    const Health health = fixture.database->health();
    CHECK(health.state == HealthState::Damaged);
    CHECK(health.reason.find("damaged") != std::string::npos);
    CHECK(fixture.append(sample_row()).error().code == ErrorCode::StorageCorrupt);
  }
}

TEST_CASE("a directory that cannot be made or written is refused with its name") {
  const TempDirectory directory;
  write_file(directory.path() / "file", "");
  const ManualClock clock;
  OpenOptions options;
  options.directory = directory.path() / "file" / "data";
  const auto opened = sqlite::open_database(options, clock);
  CHECK(opened.error().code == ErrorCode::StorageUnavailable);
  CHECK(opened.error().message.find("data") != std::string::npos);
}

TEST_CASE("a read-only directory is refused with its name") {
  const TempDirectory directory;
  create_database(directory);
  for (const auto& entry : std::filesystem::directory_iterator(directory.path())) {
    std::filesystem::permissions(entry.path(), std::filesystem::perms::owner_read);
  }
  if (::geteuid() == 0) {
    MESSAGE("skipped: root may write to a read-only file");
    return;
  }
  const Error error = refusal(directory);
  CHECK(error.code == ErrorCode::StorageUnavailable);
  CHECK(error.message.find(directory.path().string()) != std::string::npos);
}

TEST_CASE("a background check ends with the database") {
  Fixture fixture;
  REQUIRE(fixture.append(std::vector<MeasurementRow>(20'000, sample_row())).has_value());
  fixture.database.reset();
  fixture.options.check_at_open_limit = 0;
  for (int i = 0; i < 5; ++i) {
    fixture.open();
    fixture.database.reset();
  }
  fixture.open();
  while (fixture.database->health().state == HealthState::Checking) std::this_thread::yield();
  CHECK(fixture.database->health().state == HealthState::Ok);
}

TEST_CASE("a command attaches beside the running daemon") {
  Fixture fixture;
  OpenOptions options = fixture.options;
  options.access = Access::Attach;
  const auto attached = sqlite::open_database(options, fixture.clock).value();
  const auto created = attached->writer().wait(
      [](Stores& stores) { return stores.keys.create("press-3", Role::Operator, new_token(), 1); });
  REQUIRE(created.has_value());
  CHECK(fixture.see([](const Stores& stores) { return stores.keys.list().size(); }) == 1);
}

TEST_CASE("attaching creates nothing") {
  const TempDirectory directory;
  OpenOptions options;
  options.access = Access::Attach;
  CHECK(refusal(directory, options).code == ErrorCode::StorageUnavailable);
  CHECK(std::filesystem::is_empty(directory.path()));
}

TEST_CASE("a backup is a complete database of its own and overwrites nothing") {
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  const TempDirectory other;
  REQUIRE(fixture.database->backup(other.file()).has_value());
  REQUIRE(fixture.append(sample_row()).has_value());

  CHECK(fixture.database->backup(other.file()).error().code == ErrorCode::StorageUnavailable);

  OpenOptions options;
  options.directory = other.path();
  const auto restored = sqlite::open_database(options, fixture.clock).value();
  CHECK(*restored->readers().wait([](const Stores& stores) -> Result<std::int64_t> {
    return stores.measurements.last_id();
  }) == 1);
}

TEST_CASE("a backup that ends early leaves no file under its name") {
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  const TempDirectory other;
  {
    const FullDisk full(rlim_t{8} << 10);
    CHECK(fixture.database->backup(other.file()).has_error());
  }
  CHECK(std::filesystem::is_empty(other.path()));
  SUBCASE("what a killed one left aside is replaced") {
    write_file(other.file().string() + ".partial", "half a page");
    REQUIRE(fixture.database->backup(other.file()).has_value());
    CHECK_FALSE(std::filesystem::exists(other.file().string() + ".partial"));
  }
  SUBCASE("nothing that has the name is replaced, even when nothing is in it") {
    write_file(other.file(), "");
    CHECK(fixture.database->backup(other.file()).error().code == ErrorCode::StorageUnavailable);
    CHECK(content_of(other.file()).empty());
  }
}

TEST_CASE("nobody but owner and group reads the files, whatever the umask") {
  using std::filesystem::perms;
  const mode_t before = ::umask(0);
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  const TempDirectory other;
  REQUIRE(fixture.database->backup(other.file()).has_value());
  const auto rights = [](const std::filesystem::path& file) {
    return std::filesystem::status(file).permissions();
  };
  const perms expected = perms::owner_read | perms::owner_write | perms::group_read;
  const std::string file = fixture.directory.file().string();
  for (const std::string& name : {file, file + "-wal", file + "-shm", other.file().string()}) {
    CAPTURE(name);
    CHECK(rights(name) == expected);
  }
  SUBCASE("files of an older version are closed at the start") {
    fixture.database.reset();
    std::filesystem::permissions(file, expected | perms::others_read);
    fixture.open();
    CHECK(rights(file) == expected);
  }
  ::umask(before);
}
