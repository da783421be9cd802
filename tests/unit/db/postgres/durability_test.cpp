#include <doctest/doctest.h>

#include "db/postgres/connection.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

constexpr int kTimes = 10;

/// Notes what each commit of measurements or names is committed with, and a place in the server's
/// log before its end: the trigger runs when all else has. Maintenance changes neither.
constexpr const char* kNoteCommits =
    "CREATE TABLE commits (number BIGSERIAL, setting TEXT, place pg_lsn);"
    "CREATE FUNCTION note_commit() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN"
    "  INSERT INTO fitgauge.commits (setting, place)"
    "    VALUES (current_setting('synchronous_commit'), pg_current_wal_insert_lsn());"
    "  RETURN NULL; END $$;"
    "CREATE CONSTRAINT TRIGGER note_commit AFTER UPDATE ON head"
    "  DEFERRABLE INITIALLY DEFERRED FOR EACH ROW"
    "  WHEN ((OLD.last_id, OLD.names) <> (NEW.last_id, NEW.names)) EXECUTE FUNCTION note_commit()";

/// How many of them are not on the server's disk. It writes of its own accord only every ten
/// seconds here (engine.cpp).
constexpr const char* kNotFlushed =
    "SELECT count(*) FROM commits WHERE place >= pg_current_wal_flush_lsn()";

std::int64_t commits_with(const Fixture& fixture, const std::string& setting) {
  return fixture.query_integer("SELECT count(*) FROM commits WHERE setting = '" + setting + "'");
}

}  // namespace

TEST_CASE("what is acknowledged is on the server's disk") {
  Fixture fixture;
  postgres::Connection(fixture.options.address).run_script(kNoteCommits);
  for (int i = 0; i < kTimes; ++i) {
    REQUIRE(fixture.append(sample_row()).has_value());
    CHECK(fixture.query_integer(kNotFlushed) == 0);
  }
  CHECK(fixture.query_integer("SELECT count(*) FROM commits") == kTimes);
}

TEST_CASE("nobody reads what is not on the server's disk") {
  Fixture fixture;
  postgres::Connection(fixture.options.address).run_script(kNoteCommits);
  REQUIRE(fixture.append(sample_row()).has_value());
  postgres::Connection other(fixture.options.address);
  other.send("SET synchronous_commit = off");
  int ahead = 0;
  for (int i = 0; i < kTimes; ++i) {
    other.send("UPDATE head SET last_id = last_id + 1");
    other.wait();
    ahead += fixture.query_integer(kNotFlushed) > 0 ? 1 : 0;
    CHECK(fixture.last_id() == 2 + i);
    CHECK(fixture.query_integer(kNotFlushed) == 0);
  }
  CHECK(ahead > 0);  // maintenance flushes some of them first
}

TEST_CASE("a commit frees the head before the disk has it, but not with new names") {
  Fixture fixture;
  postgres::Connection(fixture.options.address).run_script(kNoteCommits);
  REQUIRE(fixture.append(sample_row()).has_value());
  CHECK(commits_with(fixture, "off") == 1);
  CHECK(commits_with(fixture, "on") == 0);

  REQUIRE(fixture.import_it7(21).has_value());
  CHECK(commits_with(fixture, "off") == 1);
  CHECK(commits_with(fixture, "on") == 1);
}
