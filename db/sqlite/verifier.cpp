#include "db/sqlite/database_file.hpp"

#include "db/store/stores.hpp"

namespace fitgauge::store {
namespace {

/// Instructions of SQLite's machine between two looks at the stop flag.
constexpr int kInstructions = 10'000;

constexpr std::size_t kPage = 10'000;
constexpr std::size_t kScrubPage = 1'000;

/// `table measurements: CREATE TABLE …` for each object, sorted.
std::vector<std::string> schema_of(sqlite::Connection& connection) {
  sql::Statement objects(connection,
                         "SELECT type || ' ' || name || ': ' || coalesce(sql, '') "
                         "FROM sqlite_schema WHERE name NOT LIKE 'sqlite_stat%' ORDER BY 1");
  return read_all<std::string>(objects.query());
}

}  // namespace

Result<void> check_file(const std::filesystem::path& file, std::stop_token stop) {
  std::string finding;
  try {
    sqlite::Connection connection(file, sqlite::Mode::Read);
    const auto is_stopped = [](void* token) {
      return static_cast<const std::stop_token*>(token)->stop_requested() ? 1 : 0;
    };
    if (stop.stop_possible()) {
      sqlite3_progress_handler(connection.handle(), kInstructions, is_stopped, &stop);
    }
    finding = connection.query_text("PRAGMA quick_check(1)");
  } catch (const StorageFailure& failure) {
    if (stop.stop_requested()) return {};
    if (failure.error().code != ErrorCode::StorageCorrupt) return failure.error();
    finding = failure.error().message;
  }
  if (finding == "ok" || stop.stop_requested()) return {};
  std::ranges::replace(finding, '\n', ' ');  // SQLite's heading is a separate line
  return Error{ErrorCode::StorageCorrupt,
               fmt::format("{} is damaged: {}. Restore a backup", file.string(), finding)};
}

VerifyReport Verifier::run() {
  try {
    check_file();
    check_schema();
    check_tables();
    check_rows();
    check_measurements(kPage, [] { return true; });
    check_index();
  } catch (const StorageFailure& failure) {
    if (failure.error().code != ErrorCode::StorageCorrupt) throw;
    note(failure.error().message);
  }
  return std::move(report_);
}

std::optional<std::string> Verifier::first_altered_row(const std::function<bool()>& go_on) {
  const auto goes_on = [&] { return report_.findings.empty() && go_on(); };
  check_tables();
  for (const SealedTable& table : sealed_tables()) {
    if (goes_on()) check_rows(table);
  }
  if (goes_on()) check_measurements(kScrubPage, goes_on);
  if (report_.findings.empty()) return std::nullopt;
  return report_.findings.front();
}

void Verifier::check_file() {
  sql::Statement integrity(session_.connection, "PRAGMA integrity_check(1000000)");
  for (sql::Rows rows = integrity.query(); rows.next();) {
    if (auto finding = rows.get<std::string>(0); finding != "ok") note(std::move(finding));
  }
  sql::Statement references(session_.connection,
                            "SELECT \"table\", rowid, parent FROM pragma_foreign_key_check");
  for (sql::Rows rows = references.query(); rows.next();) {
    note(fmt::format("row {} of {} refers to a missing row of {}", rows.get<std::int64_t>(1),
                     rows.get<std::string>(0), rows.get<std::string>(2)));
  }
}

/// Compares the schema of the file with the migrations of this build.
void Verifier::check_schema() {
  if (const auto history = sqlite::check_history(session_.connection, sqlite::migrations());
      !history) {
    note(history.error().message);
  }
  static const std::vector<std::string> expected = [] {
    sqlite::Connection fresh(":memory:", sqlite::Mode::Create);
    sqlite::migrate(fresh, sqlite::migrations(), 0);
    return schema_of(fresh);
  }();
  const std::vector<std::string> found = schema_of(session_.connection);
  const auto note_difference = [this](const auto& a, const auto& b, std::string_view what) {
    std::vector<std::string> difference;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(difference));
    for (const std::string& object : difference) {
      note(fmt::format("the schema {} {}", what, object.substr(0, object.find(':'))));
    }
  };
  note_difference(expected, found, "lacks or has changed");
  note_difference(found, expected, "has, but this build lacks,");
}

void Verifier::check_tables() {
  const TablesStore& tables = session_.stores().tables;
  for (const OriginsStore::Revision& other : session_.stores().origins.revisions()) {
    revisions_.insert(-other.number);  // of a station: its content is there
  }
  for (const TableRevision& revision : tables.list()) {
    if (!revisions_.insert(revision.number).second) continue;
    if (tables.compute_digest(revision.number) != revision.digest) {
      note(fmt::format("table revision {} differs from its digest", revision.id));
    }
  }
}

void Verifier::check_rows() {
  for (const SealedTable& table : sealed_tables()) check_rows(table);
  check_files();
}

void Verifier::check_rows(const SealedTable& table) {
  sql::Statement altered(session_.connection, table.altered());
  for (sql::Rows rows = altered.query(); rows.next();) {
    note(fmt::format("row {} of {} was altered: it does not match its seal",
                     rows.get<std::string>(0), table.name));
  }
}

void Verifier::check_files() {
  sql::Statement files(session_.connection,
                       "SELECT path_key FROM files LEFT JOIN (SELECT path_key, max(revision) AS "
                       "revision FROM file_revisions GROUP BY path_key) newest USING (path_key) "
                       "WHERE files.revision IS NOT newest.revision");
  for (sql::Rows rows = files.query(); rows.next();) {
    note(fmt::format("the newest revision of the file {} is missing", rows.get<std::string>(0)));
  }
}

void Verifier::check_measurements(std::size_t page, const std::function<bool()>& go_on) {
  static_cast<void>(session_.stores().log.state());  // throws where the log's head is lost
  const MeasurementsStore& measurements = session_.stores().measurements;
  const MeasurementFilter all{.source = std::nullopt, .history = true};
  const auto check = [this](const MeasurementRow& row) { check_measurement(row); };
  std::optional<std::int64_t> after = 0;
  do {
    after = measurements.list(all, *after, page, check);
  } while (after && go_on());
}

void Verifier::check_index() {
  // The writer continues to index: nodes and values must be read at the same moment.
  session_.begin_reading();
  session_.stores().measurements.verify_index(
      [this](std::string finding) { note(std::move(finding)); });
  session_.commit();
}

void Verifier::check_measurement(const MeasurementRow& row) {
  const std::int64_t expected_id = last_id_ + 1;
  if (row.id != expected_id) {
    note(fmt::format("measurements {} to {} are missing", expected_id, row.id - 1));
  }
  const auto is_unknown = [&] {
    return row.table_revision && !revisions_.contains(*row.table_revision);
  };
  if (is_unknown()) check_tables();  // they may have changed since
  if (is_unknown()) {
    note(fmt::format("measurement {} names the missing table revision {}", row.id,
                     *row.table_revision));
  }
  if (check_) {
    if (const std::optional<std::string> wrong = check_(row)) {
      note(fmt::format("measurement {} {}", row.id, *wrong));
    }
  }
  last_id_ = row.id;
  ++report_.measurements;
}

void Verifier::note(std::string finding) { report_.findings.push_back(std::move(finding)); }

}  // namespace fitgauge::store
