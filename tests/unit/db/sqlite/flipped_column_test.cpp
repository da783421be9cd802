// verify finds a changed value wherever it stands: every column of every table, or a drawn quarter.

#include <random>

#include "db/sql/statement.hpp"
#include "db/sqlite/connection.hpp"
#include "fixture.hpp"
#include "support/deep.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// A database with rows in every table.
struct Everything : Fixture {
  Everything() {
    std::vector<MeasurementRow> rows(1100, sample_row());
    for (MeasurementRow& row : rows) row.part_id = "SN-1";
    rows.back().correction_of = 7;
    rows.back().correction_reason = "wrong part";
    REQUIRE(append(std::span(rows).first(1099)).has_value());
    REQUIRE(append(rows.back()).has_value());
    index_all();
    change([this](Stores& stores) { fill(stores, clock.now().nanoseconds); });
    change([](Stores& stores) {
      stores.log.set_name("fitgauge/station/5f0c9a3e");
      stores.log.add_key("key", 1);
      const LogStore::Node node{.level = 1, .index = 0, .hash = {}};
      stores.log.grow(1100, std::span(&node, 1));
      const std::int64_t other = stores.origins.add("5f0c9a3e77d21b40");
      stores.origins.set_head({.number = other,
                               .digits = {},
                               .first_row = 2000,
                               .size = 1,
                               .checkpoint = "fitgauge/b/5f0c9a3e"});
      stores.notes.append({.measurement = 1, .cause = "worn", .origin = other, .number = 3});
      stores.origins.add_key(other, "key", 1);
      stores.origins.keep_nodes(other, std::span(&node, 1));
      CHECK(stores.origins.add_fork(other, "fitgauge/b/5f0c9a3e", 1));
      CHECK_FALSE(stores.origins.add_fork(other, "fitgauge/b/5f0c9a3e", 2));
      CHECK(stores.origins.add_revision("2026-a") == stores.origins.add_revision("2026-a"));
      stores.revisions.set_received(RevisionKind::Plan, "4711", {.number = 3, .digest = {}});
      const std::int64_t branch = stores.origins.add("9c3e77d21b405f0a");
      stores.origins.set_base(branch, {.origin = other, .size = 1});
      stores.log.begin_branch(1100, {1}, "fitgauge/station/9c3e77d2");
      stores.log.set_mark(LogStore::Mark::Forked, "another");
      stores.origins.set_forwarded({.centre = "https://centre", .size = 7});
    });
    REQUIRE(database->verify(check_hash)->findings.empty());
    database.reset();
  }

  static void fill(Stores& stores, std::int64_t now) {
    const auto nm = [](std::int64_t count) { return Length::nanometres(count); };
    const iso286::NominalSizeRange range{.over = nm(18), .up_to = nm(30)};
    const iso286::TableData content{
        .cells = {{iso286::TableId::ItGrades, range, "IT7", nm(21)}},
        .custom_columns = {{iso286::Feature::Shaft, "x7", {{range, {nm(21), nm(3)}}}}}};
    REQUIRE(stores.tables.import({.content = content, .source = "test", .id = "7-00000000"}, 1)
                .has_value());
    REQUIRE(stores.keys.create("press-3", Role::Operator, new_token(), 5).has_value());
    REQUIRE(stores.keys.create("press-4", Role::Viewer, new_token(), 5).has_value());
    REQUIRE(stores.keys.revoke("press-4", 9).has_value());
    stores.files.put({.path = "A.H", .content = "one", .modified_at_ns = 1, .caller = "press-3"});
    stores.files.put({.path = "a.h", .content = "two", .modified_at_ns = 2, .caller = "press-3"});
    stores.documents.put({.kind = DocumentKind::GaugeInUse,
                          .name = "G-07",
                          .text = "{}",
                          .modified_at_ns = 1,
                          .caller = "press-3"});
    stores.notes.append({.measurement = 1,
                         .cause = "worn",
                         .measure = "changed",
                         .text = "seen twice",
                         .operator_id = "Kim",
                         .caller = "press-3",
                         .received_at_ns = 1});
    stores.changes.append({.id = 1,
                           .at_ns = 1,
                           .caller = "press-3",
                           .kind = "gauge",
                           .name = "G-07",
                           .action = "replaced",
                           .before = "{}",
                           .after = "[]"},
                          sha256("leaf"));
    stores.events.append("table_changed", "{}", 1);
    const std::int64_t run = stores.runs.create(
        {.program = "TNC:\\a.h", .request = "{}", .created_at = {1}, .caller = "press-3"});
    const RunFile file{"TNC:\\LOG.TXT", "log"};
    REQUIRE(stores.runs.start(run).has_value());
    REQUIRE(stores.runs
                .finish(run, {.result = "{}", .trace = "moves", .files = std::span(&file, 1)}, now)
                .has_value());
    const IdempotentRequest request{.caller = "c", .method = "POST", .path = "/", .key = "k"};
    REQUIRE(stores.idempotency
                .once(request,
                      []() -> Result<StoredAnswer> {
                        return StoredAnswer{.status = 201,
                                            .content_type = "application/json",
                                            .location = "/v1/measurements/m1",
                                            .body = "{}"};
                      })
                .has_value());
  }
};

/// Columns whose change harms nothing or leaves nothing to compare with, and why.
const std::map<std::string, std::string> kFree = {
    {"schema_migrations.applied_at", "told to nobody"},
    {"schema_migrations.name", "told to nobody: the text of a migration has a checksum"},
    {"storage_probe.id", "written, never read"},
    {"storage_probe.probed_at", "written, never read"},
    {"api_keys.id", "in no answer"},
    {"idempotent_answers.id", "in no answer"},
    {"events.id", "rises: the file's check finds one that does not"},
    {"runs.id", "rises: the file's check finds one that does not"},
    {"notes.id", "rises: the file's check finds one that does not"},
    {"log_keys.number", "in no answer"},
    {"log_branches.number", "in no answer"},
    {"log_nodes.level", "made from the leaves: the application compares them"},
    {"log_nodes.node", "as above"},
    {"log_nodes.hash", "as above"},
    {"origins.number", "rows of it name another then: the application finds them"},
    {"origin_keys.number", "in no answer"},
    {"origin_forks.number", "in no answer"},
    {"origin_revisions.number", "rows of it name another then, which is not there"},
    {"origin_nodes.origin", "made from the leaves: the application compares them"},
    {"origin_nodes.level", "as above"},
    {"origin_nodes.node", "as above"},
    {"origin_nodes.hash", "as above"},
    {"revisions.number", "stations fetch by it, and what they fetch is read elsewhere"},
    {"revisions.tag", "as above"},
    {"revisions.kind", "as above"},
    {"revisions.name", "as above"},
    {"revisions.station", "as above"},
    {"measurement_nodes.stale", "makes the aggregates anew"},
    {"measurement_nodes.paired", "makes columns and pairs anew, or has rows read instead"},
    {"measurement_pairs.level", "of more rows than these: verify_test changes them"},
    {"measurement_pairs.field", "as above"},
    {"measurement_pairs.by_field", "as above"},
    {"measurement_pairs.node", "as above"},
    {"measurement_pairs.bytes", "as above"},
};

using Column = std::pair<std::string, std::string>;

std::vector<Column> columns_of(sqlite::Connection& connection) {
  sql::Statement all(connection,
                     "SELECT t.name, c.name FROM sqlite_schema t, pragma_table_info(t.name) c "
                     "WHERE t.type = 'table' AND t.name NOT LIKE 'sqlite_%'");
  std::vector<Column> columns;
  for (sql::Rows rows = all.query(); rows.next();) {
    columns.emplace_back(rows.get<std::string>(0), rows.get<std::string>(1));
  }
  return columns;
}

/// Changes the newest row's value as a bit that flips would.
std::string flip(const Column& column) {
  return fmt::format(
      "PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; "
      "PRAGMA synchronous = OFF; BEGIN; "
      "DROP TRIGGER measurements_are_not_updated; DROP TRIGGER notes_are_not_updated; "
      "DROP TRIGGER changes_are_not_updated; DROP TRIGGER note_origins_are_not_updated; "
      "UPDATE {0} SET {1} = CASE typeof({1}) "
      "WHEN 'integer' THEN {1} + 1 WHEN 'null' THEN 1 "
      "WHEN 'text' THEN char(unicode({1}) + 1) || substr({1}, 2) "
      "ELSE CAST((CASE hex(substr({1}, 1, 1)) WHEN '41' THEN 'B' ELSE 'A' END) || "
      "substr({1}, 2) AS BLOB) END "
      "WHERE {1} IS (SELECT max({1}) FROM {0}); "
      "CREATE TRIGGER measurements_are_not_updated BEFORE UPDATE ON measurements\nBEGIN "
      "SELECT RAISE(ABORT, 'a measurement is never changed: store a correction'); END; "
      "CREATE TRIGGER notes_are_not_updated BEFORE UPDATE ON notes\nBEGIN "
      "SELECT RAISE(ABORT, 'a note is never changed: add another'); END; "
      "CREATE TRIGGER note_origins_are_not_updated BEFORE UPDATE ON note_origins\nBEGIN "
      "SELECT RAISE(ABORT, 'a note is never changed: add another'); END; "
      "CREATE TRIGGER changes_are_not_updated BEFORE UPDATE ON changes\nBEGIN "
      "SELECT RAISE(ABORT, 'a change is never altered'); END; COMMIT",
      column.first, column.second);
}

}  // namespace

TEST_CASE("a changed value is found in every column of every table" *
          doctest::skip(kUnderThreadSanitizer)) {
  Everything sample;
  const auto columns = [&] {
    sqlite::Connection connection(sample.directory.file(), sqlite::Mode::Read);
    return columns_of(connection);
  }();
  REQUIRE(columns.size() > 100);
  std::mt19937 random(std::random_device{}());
  const int part = rounds(4, 1);
  const std::string sound = content_of(sample.directory.file());
  for (const Column& column : columns) {
    const std::string name = column.first + "." + column.second;
    if (kFree.contains(name) || random() % static_cast<unsigned>(part) != 0) continue;
    write_file(sample.directory.file(), sound);
    CAPTURE(name);
    REQUIRE_NOTHROW(
        sqlite::Connection(sample.directory.file(), sqlite::Mode::Write).execute(flip(column)));
    const auto opened = sqlite::open_database(sample.options, sample.clock);
    const bool found = !opened || !(*opened)->verify(check_hash)->findings.empty();
    CHECK_MESSAGE(found, name);
  }
}

TEST_CASE("a changed row is not told to a reader") {
  Everything sample;
  const Column changed[] = {{"idempotent_answers", "body"},
                            {"runs", "result"},
                            {"run_traces", "trace"},
                            {"run_files", "content"},
                            {"file_revisions", "content"},
                            {"documents", "text"},
                            {"notes", "cause"},
                            {"changes", "after_text"}};
  {
    sqlite::Connection connection(sample.directory.file(), sqlite::Mode::Write);
    for (const Column& column : changed) connection.execute(flip(column));
  }
  sample.open();
  const auto refused = [&](const auto& look) {
    const auto result = sample.read([&](const Stores& stores) -> Result<bool> {
      look(stores);
      return true;
    });
    return !result && result.error().code == ErrorCode::StorageCorrupt;
  };
  CHECK(refused([](const Stores& stores) {
    static_cast<void>(
        stores.idempotency.find({.caller = "c", .method = "POST", .path = "/", .key = "k"}));
  }));
  CHECK(refused([](const Stores& stores) { stores.runs.find(1); }));
  CHECK(refused([](const Stores& stores) { stores.runs.trace(1); }));
  CHECK(refused([](const Stores& stores) { stores.runs.file(1, "LOG.TXT"); }));
  CHECK(refused([](const Stores& stores) { stores.files.find("A.H"); }));
  CHECK(refused(
      [](const Stores& stores) { stores.documents.find(DocumentKind::GaugeInUse, "G-07"); }));
  CHECK(refused([](const Stores& stores) { static_cast<void>(stores.notes.list(1)); }));
  CHECK(refused([](const Stores& stores) { static_cast<void>(stores.changes.list({}, 0, 1)); }));
  CHECK_FALSE(refused([](const Stores& stores) { stores.keys.list(); }));
  CHECK(sample.database->health().state == HealthState::Damaged);
}
