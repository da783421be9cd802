// A process that dies at a random moment leaves the old state or the new one.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>
#include <vector>

#include "db/sqlite/connection.hpp"
#include "db/sqlite/database_file.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

constexpr int kRounds = 8;

/// Runs `work` in a process of its own and kills that after a random part of `longest`.
template <class Work>
void run_and_kill(std::mt19937& random, std::chrono::microseconds longest, Work work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    work();
    ::_exit(0);
  }
  const auto delay = std::uniform_int_distribution<std::int64_t>(0, longest.count())(random);
  std::this_thread::sleep_for(std::chrono::microseconds(delay));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

std::vector<sqlite::Migration> with_slow_step() {
  const auto known = sqlite::migrations();
  std::vector<sqlite::Migration> all(known.begin(), known.end());
  all.push_back({.number = static_cast<int>(all.size()) + 1,
                 .name = "slow",
                 .sql = "CREATE TABLE slow (x BLOB);"
                        "INSERT INTO slow WITH RECURSIVE n(i) AS "
                        "(VALUES (1) UNION ALL SELECT i + 1 FROM n WHERE i < 3000) "
                        "SELECT randomblob(1000) FROM n;"});
  return all;
}

}  // namespace

TEST_CASE("a creation that is killed can be repeated") {
  std::mt19937 random(std::random_device{}());
  for (int round = 0; round < kRounds; ++round) {
    const TempDirectory directory;
    OpenOptions options;
    options.directory = directory.path();
    const auto create = [&] { static_cast<void>(prepare_file(options, sqlite::migrations(), 1)); };
    run_and_kill(random, std::chrono::milliseconds(60), create);
    const ManualClock clock;
    const auto opened = sqlite::open_database(options, clock);
    REQUIRE_MESSAGE(opened.has_value(), (opened ? "" : opened.error().message));
    CHECK((*opened)->verify()->findings.empty());
  }
}

TEST_CASE("an upgrade that is killed leaves the old schema or the new one") {
  std::mt19937 random(std::random_device{}());
  const auto newer = with_slow_step();
  for (int round = 0; round < kRounds; ++round) {
    Fixture fixture;
    REQUIRE(fixture.append(sample_row()).has_value());
    fixture.database.reset();
    const auto upgrade = [&] { static_cast<void>(prepare_file(fixture.options, newer, 1)); };
    run_and_kill(random, std::chrono::milliseconds(120), upgrade);

    sqlite::Connection connection(fixture.directory.file(), sqlite::Mode::Write);
    CHECK(connection.query_text("PRAGMA integrity_check") == "ok");
    const int version = sqlite::schema_version(connection);
    const bool upgraded = version == static_cast<int>(newer.size());
    CHECK((upgraded || version == static_cast<int>(newer.size()) - 1));
    CHECK(connection.query_integer("SELECT count(*) FROM sqlite_schema WHERE name = 'slow'") ==
          (upgraded ? 1 : 0));
    CHECK(connection.query_integer("SELECT count(*) FROM measurements") == 1);
    // And the upgrade can be done again.
    CHECK(prepare_file(fixture.options, newer, 1).has_value());
  }
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
  std::mt19937 random(std::random_device{}());
  TempDirectory directory;
  OpenOptions options;
  options.directory = directory.path();
  options.checkpoint_pages = 20;  // many a kill comes while the log is copied
  const SystemClock clock;
  std::int64_t acknowledged = 0;
  // A busy machine may kill every one of the first before it was served.
  for (int round = 0; round < kRounds || (acknowledged == 0 && round < 50 * kRounds); ++round) {
    int channel[2];
    REQUIRE(::pipe(channel) == 0);
    run_and_kill(random, std::chrono::milliseconds(300), [&] {
      const auto database = sqlite::open_database(options, clock);
      while (database.has_value()) {
        MeasurementRow row = sample_row();
        const auto ids = (*database)->writer().wait(
            [&](Stores& stores) { return append_numbered(stores, std::span(&row, 1)); });
        if (ids && ::write(channel[1], &ids->last, sizeof ids->last) < 0) ::_exit(1);
      }
    });
    ::close(channel[1]);
    std::int64_t id = 0;
    while (::read(channel[0], &id, sizeof id) == sizeof id) acknowledged = id;
    ::close(channel[0]);

    const auto opened = sqlite::open_database(options, clock);
    REQUIRE_MESSAGE(opened.has_value(), (opened ? "" : opened.error().message));
    const auto last_id = (*opened)->readers().wait(
        [](const Stores& stores) -> Result<std::int64_t> { return stores.measurements.last_id(); });
    CHECK(*last_id >= acknowledged);
    const auto report = (*opened)->verify();
    CHECK_MESSAGE(report->findings.empty(), report->findings.front());
  }
  CHECK(acknowledged > 0);
}
