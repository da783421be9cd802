#include "db/store/log_store.hpp"

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store {

using sql::Rows;

namespace {

/// A restore writes each row anew, also the first row of all, which nothing changes. The timeline
/// comes last: a fail-over changes it alone.
constexpr const char* kPlace =
    "SELECT (SELECT system_identifier FROM pg_control_system()) || ' ' || (SELECT oid FROM "
    "pg_database WHERE datname = current_database()) || ' ' || "
    "(SELECT xmin::text FROM schema_migrations ORDER BY number LIMIT 1) || ' ' || "
    "left(pg_walfile_name(pg_current_wal_insert_lsn()), 8)";

}  // namespace

template <>
struct StatementsOf<LogStore> {
  sql::Connection& c;
  sql::Statement state{c, kLog.select(c, "WHERE id = 1")};
  sql::Statement set_name{c, "UPDATE log SET name = ?"};
  sql::Statement branches{c, kLogBranches.select(c, "ORDER BY number")};
  sql::Statement reason{c, "SELECT reason FROM log_marks WHERE mark = ?"};
  sql::Statement mark{c, kLogMarks.insert(c)};
  sql::Statement unmark{c, "DELETE FROM log_marks WHERE mark = ?"};
  sql::Statement place{c, c.dialect().is_shared ? kPlace : "SELECT ''"};
  sql::Statement newest{
      c,
      "SELECT (SELECT coalesce(max(id), 0) FROM measurements), (SELECT "
      "coalesce(max(id), 0) FROM runs), (SELECT coalesce(max(id), 0) FROM events), (SELECT "
      "coalesce(max(id), 0) FROM notes)"};
  sql::Statement last_change{c, "SELECT coalesce(max(id), 0) FROM changes"};
  sql::Statement add_branch{c, kLogBranches.insert(c)};
  sql::Statement set_origin{c, "UPDATE log SET origin = ?, name = ?"};
  sql::Statement set_size{c, "UPDATE log SET size = ?1 WHERE size < ?1"};
  Seal seal{c, kLog};
  sql::Statement keys{c, "SELECT vkey FROM log_keys ORDER BY number DESC"};
  sql::Statement add_key{c, kLogKeys.insert(c)};
  sql::Statement put_node{
      c,
      "INSERT INTO log_nodes (level, node, hash) VALUES (?, ?, ?) ON CONFLICT (level, node) "
      "DO UPDATE SET hash = excluded.hash"};
  sql::Statement nodes{c,
                       "SELECT hash FROM log_nodes WHERE level = ? AND node >= ? AND node < ? "
                       "ORDER BY node"};

  std::optional<std::string> reason_of(std::string_view name) {
    return read_first<std::string>(reason.query(name));
  }
};

namespace {

using Origin = std::array<std::uint8_t, 16>;

/// The names of marks. The comment of log_marks is fixed with its migration, and lists fewer.
std::string_view word(LogStore::Mark mark) {
  return word_of(mark, {"copy", "forked", "centre", "place", "retention"});
}

std::array<std::int64_t, 4> numbers_in(const Rows& rows, int column) {
  std::array<std::int64_t, 4> numbers{};
  for (std::int64_t& number : numbers) number = rows.get<std::int64_t>(column++);
  return numbers;
}

// Name of the mark that counts the changes of an ended history; the comment of log_marks does not
// list it.
std::string mark_of_changes(std::string_view history) { return fmt::format("changes {}", history); }

}  // namespace

LogStore::State LogStore::state() const {
  Rows rows = statements().state.query();
  if (!rows.next()) {
    throw StorageFailure(
        {ErrorCode::StorageCorrupt, "the head of the log is missing in the database"});
  }
  return row_of<State>(rows, kLog);
}

void LogStore::set_name(std::string_view name) {
  statements().set_name.run(name);
  statements().seal.renew(1);
}

std::vector<LogStore::Branch> LogStore::branches() const {
  std::vector<Branch> branches;
  for (Rows rows = statements().branches.query(); rows.next();) {
    require_sound(rows, 7, kLogBranches);
    branches.push_back({.origin = rows.get<Origin>(0),
                        .name = rows.get<std::string>(1),
                        .size = rows.get<std::int64_t>(2),
                        .newest = numbers_in(rows, 3)});
  }
  return branches;
}

std::int64_t LogStore::last_change(std::string_view history) const {
  return std::stoll(statements().reason_of(mark_of_changes(history)).value_or("0"));
}

std::optional<std::string> LogStore::mark(Mark mark) const {
  return statements().reason_of(word(mark));
}

void LogStore::set_mark(Mark mark, const std::optional<std::string>& reason) {
  statements().unmark.run(word(mark));
  if (reason) statements().mark.run(word(mark), *reason);
}

std::string LogStore::place() const { return statements().place.returning<std::string>(); }

void LogStore::begin_branch(std::int64_t size, const Origin& origin, std::string_view name) {
  const State ended = state();
  const auto last = [this] {
    Rows rows = statements().newest.query();
    rows.next();
    return numbers_in(rows, 0);
  }();
  statements().add_branch.run(ended.origin, ended.name.value_or(""), size, last[0], last[1],
                              last[2], last[3]);
  statements().mark.run(mark_of_changes(ended.name.value_or("")),
                        std::to_string(statements().last_change.returning<std::int64_t>()));
  statements().set_origin.run(origin, name);
  statements().seal.renew(1);
  for (const Mark mark : {Mark::Copy, Mark::Forked}) set_mark(mark, std::nullopt);
}

std::vector<std::string> LogStore::keys() const {
  return read_all<std::string>(statements().keys.query());
}

void LogStore::add_key(std::string_view vkey, std::int64_t now_ns) {
  statements().add_key.run(vkey, now_ns);
}

void LogStore::grow(std::int64_t size, std::span<const Node> nodes) {
  for (const Node& node : nodes) statements().put_node.run(node.level, node.index, node.hash);
  statements().set_size.run(size);
  statements().seal.renew(1);
}

std::int64_t LogStore::nodes(int level, std::int64_t first, std::int64_t count,
                             const Visitor& visit) const {
  std::int64_t visited = 0;
  for (Rows rows = statements().nodes.query(level, first, first + count); rows.next(); ++visited) {
    visit(rows.get<Digest>(0));
  }
  return visited;
}

constexpr std::string_view kChangeColumns =
    "id, at, caller, kind, name, action, before_text, after_text";

template <>
struct StatementsOf<ChangesStore> {
  sql::Connection& c;
  sql::Statement size{c, "SELECT coalesce(max(id), 0) FROM changes"};
  sql::Statement append{c, kChanges.insert(c)};
  sql::Statement list{c, kChanges.select(c,
                                         "WHERE id > ?1 AND (?2 IS NULL OR kind = ?2) AND (?3 IS "
                                         "NULL OR name = ?3) AND at >= ?4 AND at < ?5 ORDER BY id "
                                         "LIMIT ?6",
                                         kChangeColumns)};
  sql::Statement of_kind{c, kChanges.select(c, "WHERE kind = ?1 ORDER BY id", kChangeColumns)};
  sql::Statement leaves{c, "SELECT leaf FROM changes WHERE id > ?1 AND id <= ?2 ORDER BY id"};
};

std::int64_t ChangesStore::size() const { return statements().size.returning<std::int64_t>(); }

void ChangesStore::append(const Change& change, const Digest& leaf) {
  statements().append.run(change.id, change.at_ns, change.caller, change.kind, change.name,
                          change.action, change.before, change.after, leaf);
}

ChangesStore::Page ChangesStore::list(const ChangeFilter& filter, std::int64_t after,
                                      std::int64_t limit) const {
  using Limits = std::numeric_limits<std::int64_t>;
  constexpr std::size_t kMostBytes = std::size_t{4} << 20;
  Page page;
  std::size_t bytes = 0;
  for (Rows rows = statements().list.query(after, filter.kind, filter.name,
                                           filter.from_ns.value_or(Limits::min()),
                                           filter.to_ns.value_or(Limits::max()), limit + 1);
       rows.next();) {
    page.has_more = page.changes.size() == static_cast<std::size_t>(limit) || bytes > kMostBytes;
    if (page.has_more) break;
    const Change& change = page.changes.emplace_back(row_of<Change>(rows, kChanges));
    bytes += change.before.value_or("").size() + change.after.value_or("").size();
  }
  return page;
}

std::vector<Change> ChangesStore::of_kind(std::string_view kind) const {
  return read_all<Change>(statements().of_kind.query(kind), kChanges);
}

void ChangesStore::leaves(std::int64_t after, std::int64_t count,
                          const std::function<void(const Digest&)>& visit) const {
  for (Rows rows = statements().leaves.query(after, after + count); rows.next();) {
    visit(rows.get<Digest>(0));
  }
}

}  // namespace fitgauge::store
