#include "db/store/database.hpp"

#include "db/sqlite/connection.hpp"
#include "db/sqlite/database_file.hpp"
#include "fixture.hpp"
#include "support/comes_true.hpp"
#include "support/deep.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// A database of five measurements and one table revision.
struct VerifyFixture : Fixture {
  VerifyFixture() {
    REQUIRE(append(std::vector<MeasurementRow>(5, sample_row())).has_value());
    REQUIRE(import_it7(21).has_value());
  }

  /// Does with the file what fitgauge itself refuses.
  void tamper(const std::string& sql) {
    sqlite::Connection connection(directory.file(), sqlite::Mode::Write);
    connection.execute(
        "DROP TRIGGER measurements_are_not_updated; DROP TRIGGER measurements_are_not_deleted; "
        "PRAGMA foreign_keys = OFF;" +
        sql +
        "; CREATE TRIGGER measurements_are_not_updated BEFORE UPDATE ON measurements\nBEGIN "
        "SELECT RAISE(ABORT, 'a measurement is never changed: store a correction'); END;"
        "CREATE TRIGGER measurements_are_not_deleted BEFORE DELETE ON measurements\nBEGIN SELECT "
        "RAISE(ABORT, 'a measurement is never deleted'); END;");
  }

  std::vector<std::string> findings(const MeasurementCheck& check = check_hash) {
    const auto report = database->verify(check).value();
    return report.findings;
  }
};

}  // namespace

TEST_CASE("a sound database verifies") {
  VerifyFixture fixture;
  const auto report = fixture.database->verify().value();
  CHECK(report.measurements == 5);
  CHECK(report.findings.empty());
}

TEST_CASE("a sound database verifies while its measurements are being indexed") {
  Fixture fixture;
  REQUIRE(fixture.append(std::vector<MeasurementRow>(30'000, sample_row())).has_value());
  for (int round = 0; round < 4; ++round) {
    const auto report = fixture.database->verify();
    CHECK_MESSAGE(report->findings.empty(), report->findings.front());
  }
}

TEST_CASE("rows that do not go on where the others end are refused") {
  VerifyFixture fixture;
  std::vector<MeasurementRow> rows(2, sample_row());
  rows[0].id = 7;
  rows[1].id = 8;
  const auto appended = fixture.write([&](Stores& stores) -> Result<bool> {
    if (const auto done = stores.measurements.append(rows); !done) return done.error();
    return true;
  });
  CHECK(appended.error().code == ErrorCode::Internal);
  CHECK(fixture.last_id() == 5);
}

TEST_CASE("what is altered is named, of measurements the first") {
  struct Tampered {
    std::string sql;
    std::string named;
    std::size_t findings;
  };
  const Tampered all[] = {
      {"UPDATE measurements SET measured_nm = 25014000 WHERE id >= 3", "measurement 3 ", 3},
      {"UPDATE measurements SET comment = '' WHERE id = 1", "measurement 1 ", 1},  // was not given
      {"UPDATE measurements SET hash = zeroblob(32) WHERE id = 2", "measurement 2 ", 1},
      {"DELETE FROM measurements WHERE id IN (2, 3)", "2 to 3 are missing", 1},
      {"UPDATE table_cells SET value_nm = 22", "table revision 1-", 1},
      {"DROP INDEX measurement_corrections", "index measurement_corrections", 1},
      {"CREATE TRIGGER extra AFTER INSERT ON events BEGIN SELECT 1; END", "trigger extra", 1},
      // Of each of five: the revision that is missing, and the hash.
      {"UPDATE measurements SET table_revision = 9, basis = 1, tolerance_class = 'H7'",
       "measurement 1 ", 10},
      // The reference, the digest and the seal.
      {"UPDATE table_revisions SET table_set = 77", "table_sets", 3}};
  for (const auto& [sql, named, count] : all) {
    CAPTURE(sql);
    VerifyFixture fixture;
    fixture.tamper(sql);
    const auto findings = fixture.findings();
    CHECK(findings.size() == count);
    const std::string first = findings.empty() ? "nothing is found" : findings[0];
    CHECK_MESSAGE(first.find(named) != std::string::npos, first);
  }
}

TEST_CASE("what the caller finds wrong with a measurement is in the report") {
  VerifyFixture fixture;
  const auto findings = fixture.findings([](const MeasurementRow& row) {
    return row.id == 4 ? std::optional<std::string>("has a verdict that does not follow")
                       : std::nullopt;
  });
  REQUIRE(findings.size() == 1);
  CHECK(findings[0] == "measurement 4 has a verdict that does not follow");
}

TEST_CASE("a damaged page ends the verification with a finding") {
  VerifyFixture fixture;
  fixture.database.reset();
  fixture.options.check_at_open_limit = 0;
  std::string content = content_of(fixture.directory.file());
  content.replace(28'672, 300, 300, '\xFF');
  write_file(fixture.directory.file(), content);
  fixture.open();
  CHECK_FALSE(fixture.findings().empty());
}

TEST_CASE("what is derived from the measurements is derived again") {
  const std::pair<std::string, std::string> all[] = {
      {"a look-up that passes rows over",
       "DELETE FROM measurement_postings WHERE field = 1 AND block = 1"},
      {"a look-up with another row",
       "UPDATE measurement_postings SET rows = x'0100' WHERE field = 1 AND block = 1"},
      {"a value that no measurement has",
       "INSERT INTO measurement_postings VALUES (1, 'SN-2', 1, x'0100')"},
      {"another sum",
       "UPDATE measurement_aggregates SET statistics = zeroblob(64) WHERE level = 0 "
       "AND node = 1 AND field = 1"},
      {"another value among those for figures",
       "UPDATE measurement_values SET bytes = zeroblob(1030) WHERE block = 1"},
      {"values of a block that is not there", "INSERT INTO measurement_values VALUES (7, x'00')"},
      {"other times", "UPDATE measurement_nodes SET max_measured_at = 1 WHERE node = 1"}};
  MeasurementRow row = sample_row();
  row.part_id = "SN-1";
  for (const auto& [name, sql] : all) {
    CAPTURE(name);
    VerifyFixture fixture;
    REQUIRE(fixture.append(std::vector<MeasurementRow>(3'000, row)).has_value());
    fixture.index_all();
    CHECK(fixture.findings().empty());
    fixture.tamper(sql);
    const auto findings = fixture.findings();
    CHECK_FALSE(findings.empty());
    for (const std::string& finding : findings) {
      CHECK_MESSAGE(finding.find("has -") == std::string::npos, finding);
    }
  }
}

TEST_CASE("columns and pairs of fields are derived again" * doctest::skip(kUnderThreadSanitizer)) {
  VerifyFixture fixture;
  MeasurementRow row = sample_row();
  row.machine = "M7";
  REQUIRE(fixture.append(std::vector<MeasurementRow>(33'000, row)).has_value());
  fixture.index_all();
  CHECK(fixture.findings().empty());
  const auto count = [&] { return fixture.findings().size(); };
  fixture.tamper("UPDATE measurement_pairs SET bytes = x'00' WHERE field = 4 AND by_field = 3");
  CHECK(count() == 1);
  fixture.tamper("UPDATE measurement_pairs SET node = 7 WHERE field = 4 AND by_field = 2");
  CHECK(count() == 2);  // and the node that is not there
  fixture.tamper("UPDATE measurement_pairs SET bytes = x'00' WHERE field = 4 AND by_field = 0");
  CHECK(count() == 2);
  fixture.tamper("INSERT INTO measurement_columns VALUES (40, x'00')");
  CHECK(count() == 2);
  fixture.tamper("DELETE FROM measurement_columns WHERE block = 3");
  CHECK(count() == 3);
}

TEST_CASE("tables that change while rows are being read are known") {
  VerifyFixture fixture;
  sqlite::Session session(fixture.options, fixture.clock, sqlite::Mode::Read);
  const MeasurementCheck no_check;
  Verifier verifier(session, no_check);
  bool has_changed = false;
  const auto finding = verifier.first_altered_row([&] {
    if (std::exchange(has_changed, true)) return true;
    MeasurementRow row = sample_row();
    row.basis = Basis::Iso286;
    row.tolerance_class = "H7";
    row.table_revision = fixture.import_it7(22, 1).value().number;
    REQUIRE(fixture.append(row).has_value());
    return true;
  });
  CHECK(has_changed);
  CHECK_MESSAGE(!finding, finding.value_or(""));
}

TEST_CASE("damage is found before somebody asks for the row") {
  for (const auto& [sql, named] : std::initializer_list<std::pair<std::string, std::string>>{
           {"UPDATE measurements SET comment = 'x' WHERE id = 2500", "measurement 2500 "},
           {"UPDATE table_cells SET value_nm = 22", "table revision 1-"},
           {"UPDATE table_revisions SET source = 'x'", "table_revisions"}}) {
    CAPTURE(sql);
    VerifyFixture fixture;
    REQUIRE(fixture.append(std::vector<MeasurementRow>(3000, sample_row())).has_value());
    fixture.tamper(sql);
    fixture.reopen([](OpenOptions& options) {
      options.check_measurement = check_hash;
      options.scrub_interval = std::chrono::milliseconds(1);
    });
    Health health;
    comes_true([&] {
      health = fixture.database->health();
      return health.state != HealthState::Ok;
    });
    CHECK(health.reason.find(named) != std::string::npos);
  }
}
