#include "db/store/log_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store {

using sql::Rows;

struct LogStore::Statements {
  explicit Statements(sql::Connection& c)
      : state(c,
              fmt::format("SELECT origin, name, size, {} FROM log WHERE id = 1", kLog.is_sound(c))),
        set_name(c, "UPDATE log SET name = ?"),
        branches(c, fmt::format("SELECT {}, {} FROM log_branches ORDER BY number",
                                kLogBranches.columns, kLogBranches.is_sound(c))),
        is_copy(c, "SELECT 1 FROM log_marks WHERE mark = 'copy'"),
        forked(c, "SELECT reason FROM log_marks WHERE mark = 'forked'"),
        mark(c, kLogMarks.insert(c)),
        not_forked(c, "DELETE FROM log_marks WHERE mark = 'forked'"),
        newest(
            c,
            "SELECT (SELECT coalesce(max(id), 0) FROM measurements), (SELECT "
            "coalesce(max(id), 0) FROM runs), (SELECT coalesce(max(id), 0) FROM events), (SELECT "
            "coalesce(max(id), 0) FROM notes)"),
        add_branch(c, kLogBranches.insert(c)),
        set_origin(c, "UPDATE log SET origin = ?, name = ?"),
        unmark(c, "DELETE FROM log_marks"),
        set_size(c, "UPDATE log SET size = ?1 WHERE size < ?1"),
        seal(c, kLog),
        keys(c, "SELECT vkey FROM log_keys ORDER BY number DESC"),
        add_key(c, kLogKeys.insert(c)),
        put_node(
            c,
            "INSERT INTO log_nodes (level, node, hash) VALUES (?, ?, ?) ON CONFLICT (level, node) "
            "DO UPDATE SET hash = excluded.hash"),
        nodes(c,
              "SELECT hash FROM log_nodes WHERE level = ? AND node >= ? AND node < ? "
              "ORDER BY node") {}

  sql::Statement state;
  sql::Statement set_name;
  sql::Statement branches;
  sql::Statement is_copy;
  sql::Statement forked;
  sql::Statement mark;
  sql::Statement not_forked;
  sql::Statement newest;
  sql::Statement add_branch;
  sql::Statement set_origin;
  sql::Statement unmark;
  sql::Statement set_size;
  Seal seal;
  sql::Statement keys;
  sql::Statement add_key;
  sql::Statement put_node;
  sql::Statement nodes;
};

LogStore::LogStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
LogStore::~LogStore() = default;

namespace {

using Origin = std::array<std::uint8_t, 16>;

Origin origin_in(const Rows& rows, int column) {
  Origin origin{};
  const std::string_view bytes = rows.get<sql::Blob>(column).bytes;
  std::copy_n(bytes.begin(), std::min(bytes.size(), origin.size()), origin.begin());
  return origin;
}

std::array<std::int64_t, 4> numbers_in(const Rows& rows, int column) {
  std::array<std::int64_t, 4> numbers{};
  for (std::int64_t& number : numbers) number = rows.get<std::int64_t>(column++);
  return numbers;
}

sql::Blob blob_of(const Origin& origin) {
  return {{reinterpret_cast<const char*>(origin.data()), origin.size()}};
}

}  // namespace

LogStore::State LogStore::state() const {
  Rows rows = statements_->state.query();
  if (!rows.next()) {
    throw StorageFailure({ErrorCode::StorageCorrupt, "the database has lost the head of its log"});
  }
  require_sound(rows, 3, kLog);
  State state;
  state.origin = origin_in(rows, 0);
  state.name = rows.get<std::optional<std::string>>(1);
  state.size = rows.get<std::int64_t>(2);
  return state;
}

void LogStore::set_name(std::string_view name) {
  statements_->set_name.run(name);
  statements_->seal.renew(1);
}

std::vector<LogStore::Branch> LogStore::branches() const {
  std::vector<Branch> branches;
  for (Rows rows = statements_->branches.query(); rows.next();) {
    require_sound(rows, 7, kLogBranches);
    branches.push_back({.origin = origin_in(rows, 0),
                        .name = rows.get<std::string>(1),
                        .size = rows.get<std::int64_t>(2),
                        .newest = numbers_in(rows, 3)});
  }
  return branches;
}

bool LogStore::is_copy() const { return statements_->is_copy.query().next(); }

std::optional<std::string> LogStore::forked() const {
  Rows rows = statements_->forked.query();
  return rows.next() ? std::optional(rows.get<std::string>(0)) : std::nullopt;
}

void LogStore::set_forked(const std::optional<std::string>& reason) {
  statements_->not_forked.run();
  if (reason) statements_->mark.run("forked", *reason);
}

void LogStore::begin_branch(std::int64_t size, const Origin& origin, std::string_view name) {
  const State ended = state();
  const auto last = [this] {
    Rows rows = statements_->newest.query();
    rows.next();
    return numbers_in(rows, 0);
  }();
  statements_->add_branch.run(blob_of(ended.origin), ended.name.value_or(""), size, last[0],
                              last[1], last[2], last[3]);
  statements_->set_origin.run(blob_of(origin), name);
  statements_->seal.renew(1);
  statements_->unmark.run();
}

std::vector<std::string> LogStore::keys() const {
  std::vector<std::string> keys;
  for (Rows rows = statements_->keys.query(); rows.next();) {
    keys.push_back(rows.get<std::string>(0));
  }
  return keys;
}

void LogStore::add_key(std::string_view vkey, std::int64_t now_ns) {
  statements_->add_key.run(vkey, now_ns);
}

void LogStore::grow(std::int64_t size, std::span<const Node> nodes) {
  for (const Node& node : nodes) statements_->put_node.run(node.level, node.index, node.hash);
  statements_->set_size.run(size);
  statements_->seal.renew(1);
}

std::int64_t LogStore::nodes(int level, std::int64_t first, std::int64_t count,
                             const Visitor& visit) const {
  std::int64_t visited = 0;
  for (Rows rows = statements_->nodes.query(level, first, first + count); rows.next(); ++visited) {
    visit(rows.get<Digest>(0));
  }
  return visited;
}

}  // namespace fitgauge::store
