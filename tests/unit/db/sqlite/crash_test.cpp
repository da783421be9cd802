// A process that is killed at any step leaves the old state or the new one.

#include <sys/wait.h>
#include <unistd.h>

#include "db/sqlite/connection.hpp"
#include "db/sqlite/database_file.hpp"
#include "fixture.hpp"
#include "steps.hpp"
#include "support/deep.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

const int kRounds = rounds(8, 80);

/// Kills `work` at kRounds of its steps, the first and the last among them. `work` makes the same
/// steps each time; `prepare` comes before each, `look` after it.
template <class Prepare, class Work, class Look>
void kill_at_many_steps(Prepare prepare, Work work, Look look) {
  prepare();
  const int before = steps_made();
  work();
  const int steps = steps_made() - before;
  REQUIRE(steps >= kRounds);
  for (int round = 0; round < kRounds; ++round) {
    prepare();
    const int step = 1 + (steps - 1) * round / (kRounds - 1);
    CAPTURE(step);
    REQUIRE(is_killed([&] {
      kill_at(step);
      work();
    }));
    look();
  }
}

std::vector<sqlite::Migration> with_large_step() {
  const auto known = sqlite::migrations();
  std::vector<sqlite::Migration> all(known.begin(), known.end());
  all.push_back({.number = static_cast<int>(all.size()) + 1,
                 .name = "large",
                 .sql = "CREATE TABLE large (x BLOB);"
                        "INSERT INTO large WITH RECURSIVE n(i) AS "
                        "(VALUES (1) UNION ALL SELECT i + 1 FROM n WHERE i < 3000) "
                        "SELECT randomblob(1000) FROM n;"});
  return all;
}

}  // namespace

TEST_CASE("a creation that is killed can be repeated") {
  std::optional<TempDirectory> directory;
  OpenOptions options;
  const auto prepare = [&] { options.directory = directory.emplace().path(); };
  const auto create = [&] { REQUIRE(prepare_file(options, sqlite::migrations(), 1).has_value()); };
  kill_at_many_steps(prepare, create, [&] {
    const ManualClock clock;
    const auto opened = sqlite::open_database(options, clock).value();
    CHECK(opened->verify()->findings.empty());
  });
}

TEST_CASE("an upgrade that is killed leaves the old schema or the new one") {
  const auto newer = with_large_step();
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  fixture.database.reset();
  const std::string before = content_of(fixture.directory.file());
  const auto prepare = [&] {
    std::filesystem::remove_all(fixture.directory.path());
    std::filesystem::create_directory(fixture.directory.path());
    write_file(fixture.directory.file(), before);
  };
  const auto upgrade = [&] { REQUIRE(prepare_file(fixture.options, newer, 1).has_value()); };
  kill_at_many_steps(prepare, upgrade, [&] {
    {
      sqlite::Connection connection(fixture.directory.file(), sqlite::Mode::Write);
      CHECK(connection.query_text("PRAGMA integrity_check") == "ok");
      const int version = sqlite::schema_version(connection);
      const bool upgraded = version == static_cast<int>(newer.size());
      CHECK((upgraded || version == static_cast<int>(newer.size()) - 1));
      CHECK(connection.query_integer("SELECT count(*) FROM sqlite_schema WHERE name = 'large'") ==
            (upgraded ? 1 : 0));
      CHECK(connection.query_integer("SELECT count(*) FROM measurements") == 1);
    }
    // And the upgrade can be done again.
    CHECK(prepare_file(fixture.options, newer, 1).has_value());
  });
}

TEST_CASE("a kill while the file is changed to WAL mode is no obstacle") {
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  fixture.database.reset();
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    sqlite::Connection connection(fixture.directory.file(), sqlite::Mode::Create);
    connection.execute(
        "PRAGMA journal_mode = DELETE; BEGIN; UPDATE storage_probe SET probed_at = 9");
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  REQUIRE(std::filesystem::exists(fixture.directory.path() / "fitgauge.db-journal"));
  fixture.open();
  CHECK(fixture.last_id() == 1);
  CHECK(fixture.database->verify()->findings.empty());
}

TEST_CASE("measurements acknowledged before a kill are there after it") {
  TempDirectory directory;
  OpenOptions options;
  options.directory = directory.path();
  options.checkpoint_pages = 20;  // many a kill comes while the log is copied
  const SystemClock clock;
  std::int64_t stored = 0;
  for (int round = 0; round < kRounds; ++round) {
    // Every other kill comes at a step of the start, or soon after it.
    const std::int64_t rows = round % 2 == 0 ? 0 : 3 * round;
    const int step = 1 + 5 * round;
    CAPTURE(rows);
    CAPTURE(step);
    int channel[2];
    REQUIRE(::pipe(channel) == 0);
    REQUIRE(is_killed([&] {
      if (rows == 0) kill_at(step);
      const auto database = sqlite::open_database(options, clock);
      for (std::int64_t made = 1; database.has_value(); ++made) {
        MeasurementRow row = sample_row();
        const auto ids = (*database)->writer().wait(
            [&](Stores& stores) { return append_numbered(stores, std::span(&row, 1)); });
        if (!ids || ::write(channel[1], &ids->last, sizeof ids->last) < 0) return;
        if (made == rows) kill_at(step);
      }
    }));
    ::close(channel[1]);
    std::int64_t acknowledged = stored;
    std::int64_t id = 0;
    while (::read(channel[0], &id, sizeof id) == sizeof id) acknowledged = id;
    ::close(channel[0]);
    CHECK(acknowledged >= stored + rows);

    const auto opened = sqlite::open_database(options, clock).value();
    stored = *opened->readers().wait(
        [](const Stores& stores) -> Result<std::int64_t> { return stores.measurements.last_id(); });
    CHECK(stored >= acknowledged);
    CHECK(stored <= acknowledged + 1);  // the row that was on its way
    const auto report = opened->verify();
    CHECK_MESSAGE(report->findings.empty(), report->findings.front());
  }
}
