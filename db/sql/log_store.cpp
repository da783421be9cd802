#include "db/store/log_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"
#include "db/store/storage_failure.hpp"

namespace fitgauge::store {

using sql::Rows;

struct LogStore::Statements {
  explicit Statements(sql::Connection& c)
      : state(c,
              fmt::format("SELECT origin, name, size, {} FROM log WHERE id = 1", kLog.is_sound(c))),
        set_name(c, "UPDATE log SET name = ?"),
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

LogStore::State LogStore::state() const {
  Rows rows = statements_->state.query();
  if (!rows.next()) {
    throw StorageFailure({ErrorCode::StorageCorrupt, "the database has lost the head of its log"});
  }
  require_sound(rows, 3, kLog);
  State state;
  const std::string_view origin = rows.get<sql::Blob>(0).bytes;
  std::copy_n(origin.begin(), std::min(origin.size(), state.origin.size()), state.origin.begin());
  state.name = rows.get<std::optional<std::string>>(1);
  state.size = rows.get<std::int64_t>(2);
  return state;
}

void LogStore::set_name(std::string_view name) {
  statements_->set_name.run(name);
  statements_->seal.renew(1);
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
