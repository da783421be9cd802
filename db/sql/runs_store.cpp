#include "db/store/runs_store.hpp"

#include "db/sql/connection.hpp"
#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {
namespace {

using sql::Blob;
using sql::Rows;

constexpr std::string_view kRun =
    "id, status, program, request, result, created_at, finished_at, caller";

/// `TNC:\nc_prog\LOG.TXT` is called `LOG.TXT`.
std::string_view name_of(std::string_view path) {
  return path.substr(path.find_last_of("\\/:") + 1);
}

/// With a single daemon: it has ended if another process asks.
std::string_view of_the_dead(const sql::Connection& c) {
  return c.dialect().is_shared ? " AND daemon NOT IN (SELECT daemon FROM living_daemons)" : "";
}

}  // namespace

template <>
struct StatementsOf<RunsStore> {
  sql::Connection& c;
  sql::Statement insert{c, kRuns.insert(c) + " RETURNING id"};
  sql::Statement start{c, "UPDATE runs SET status = 2 WHERE id = ? AND status <> 8"};
  sql::Statement finish{c,
                        "UPDATE runs SET status = ?2, result = ?3, finished_at = ?4 WHERE id = ?1"};
  sql::Statement ask_to_cancel{c, "UPDATE runs SET status = 8 WHERE id = ?"};
  sql::Statement to_be_cancelled{c, "SELECT id FROM runs WHERE finished_at IS NULL AND status = 8"};
  Seal seal{c, kRuns};
  sql::Statement insert_trace{c, kRunTraces.insert(c)};
  sql::Statement insert_file{c, kRunFiles.insert(c)};
  sql::Statement status{c, "SELECT status FROM runs WHERE id = ?"};
  sql::Statement find{c, kRuns.select(c, "WHERE id = ?", kRun)};
  sql::Statement trace{c, kRunTraces.select(c, "WHERE run = ?", "trace")};
  sql::Statement file{
      c, kRunFiles.select(c, "WHERE run = ? AND name_key = ? ORDER BY path", "path, content")};
  sql::Statement page{c, kRuns.select(c,
                                      "WHERE (?1 IS NULL OR CASE status WHEN 8 THEN 2 ELSE status "
                                      "END = ?1) AND (?2 IS NULL OR program_key = ?2) AND id < ?3 "
                                      "ORDER BY id DESC LIMIT ?4",
                                      kRun)};
  sql::Statement abandoned{
      c,
      kRuns.select(
          c, fmt::format("WHERE finished_at IS NULL{} ORDER BY id LIMIT ?", of_the_dead(c)), kRun)};
  sql::Statement take_over{
      c, fmt::format("UPDATE runs SET status = CASE status WHEN 8 THEN 8 ELSE 1 END{} "
                     "WHERE id = ? AND finished_at IS NULL{} RETURNING 1",
                     c.dialect().is_shared ? ", daemon = DEFAULT" : "", of_the_dead(c))};
  sql::Statement purge{c,
                       "DELETE FROM runs WHERE id IN "
                       "(SELECT id FROM runs WHERE finished_at < ? LIMIT ?) RETURNING 1"};

  Result<void> require_unfinished(std::int64_t id) {
    const auto found = read_first<RunStatus>(status.query(id));
    if (!found) return Error{ErrorCode::RunUnknown, fmt::format("run not found: {}", id)};
    if (is_finished(*found)) {
      return Error{ErrorCode::RunFinished, fmt::format("run {} has finished", id)};
    }
    return {};
  }
};

std::int64_t RunsStore::create(const Run& run) {
  const std::string program_key = ascii_upper(run.program);
  return statements().insert.returning<std::int64_t>(run.status, run.program, program_key,
                                                     run.request, run.result, run.created_at,
                                                     run.finished_at, run.caller);
}

Result<void> RunsStore::start(std::int64_t id) {
  TRY(statements().require_unfinished(id));
  statements().start.run(id);
  statements().seal.renew(id);
  return {};
}

Result<void> RunsStore::finish(std::int64_t id, const RunOutcome& outcome, std::int64_t now_ns) {
  TRY(statements().require_unfinished(id));
  statements().finish.run(id, outcome.status, outcome.result, now_ns);
  statements().seal.renew(id);
  statements().insert_trace.run(id, Blob{outcome.trace});
  for (const RunFile& file : outcome.files) {
    const std::string key = ascii_upper(name_of(file.path));
    statements().insert_file.run(id, key, file.path, Blob{file.content});
  }
  return {};
}

Result<void> RunsStore::ask_to_cancel(std::int64_t id) {
  TRY(statements().require_unfinished(id));
  statements().ask_to_cancel.run(id);
  statements().seal.renew(id);
  return {};
}

std::vector<std::int64_t> RunsStore::to_be_cancelled() const {
  return read_all<std::int64_t>(statements().to_be_cancelled.query());
}

std::optional<RunStatus> RunsStore::status(std::int64_t id) const {
  return read_first<RunStatus>(statements().status.query(id));
}

std::optional<Run> RunsStore::find(std::int64_t id) const {
  return read_first<Run>(statements().find.query(id), kRuns);
}

std::optional<std::string> RunsStore::trace(std::int64_t id) const {
  Rows rows = statements().trace.query(id);
  if (!rows.next()) return std::nullopt;
  require_sound(rows, 1, kRunTraces);
  return std::string(rows.get<Blob>(0).bytes);
}

std::optional<RunFile> RunsStore::file(std::int64_t id, std::string_view name,
                                       std::string_view path) const {
  const std::string key = ascii_upper(name);
  for (Rows rows = statements().file.query(id, key); rows.next();) {
    auto found = rows.get<std::string>(0);
    if (!path.empty() && !ascii_iequals(found, path)) continue;
    require_sound(rows, 2, kRunFiles);
    return RunFile{std::move(found), std::string(rows.get<Blob>(1).bytes)};
  }
  return std::nullopt;
}

RunsStore::Page RunsStore::list(const RunFilter& filter, std::optional<std::int64_t> after,
                                std::size_t limit) const {
  const std::optional<std::string> program_key =
      filter.program ? std::optional(ascii_upper(*filter.program)) : std::nullopt;
  const std::int64_t before = after.value_or(std::numeric_limits<std::int64_t>::max());
  Page page;
  // One row more than the page shows if there is a next one.
  for (Rows rows = statements().page.query(filter.status, program_key, before, limit + 1);
       rows.next();) {
    if (page.runs.size() == limit) {
      page.next = page.runs.back().id;
      break;
    }
    page.runs.push_back(row_of<Run>(rows, kRuns));
  }
  return page;
}

std::vector<Run> RunsStore::abandoned(std::size_t limit) const {
  return read_all<Run>(statements().abandoned.query(limit), kRuns);
}

bool RunsStore::take_over(std::int64_t id) {
  if (statements().take_over.run_counting(id) == 0) return false;
  statements().seal.renew(id);
  return true;
}

std::int64_t RunsStore::purge(std::int64_t before_ns, std::int64_t limit) {
  return statements().purge.run_counting(before_ns, limit);
}

}  // namespace fitgauge::store
