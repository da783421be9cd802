#include "db/store/changes_store.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {

using sql::Rows;

struct ChangesStore::Statements {
  explicit Statements(sql::Connection& c)
      : size(c, "SELECT coalesce(max(id), 0) FROM changes"),
        append(c, kChanges.insert(c)),
        list(c,
             fmt::format("SELECT {}, {} FROM changes WHERE id > ?1 AND (?2 IS NULL OR kind = ?2) "
                         "AND (?3 IS NULL OR name = ?3) AND at >= ?4 AND at < ?5 ORDER BY id "
                         "LIMIT ?6",
                         kChanges.columns, kChanges.is_sound(c))),
        leaves(c, "SELECT leaf FROM changes WHERE id > ?1 AND id <= ?2 ORDER BY id") {}

  sql::Statement size;
  sql::Statement append;
  sql::Statement list;
  sql::Statement leaves;
};

ChangesStore::ChangesStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
ChangesStore::~ChangesStore() = default;

std::int64_t ChangesStore::size() const {
  Rows rows = statements_->size.query();
  return rows.next() ? rows.get<std::int64_t>(0) : 0;
}

void ChangesStore::append(const Change& change, const Digest& leaf) {
  statements_->append.run(change.id, change.at_ns, change.caller, change.kind, change.name,
                          change.action, change.before, change.after, leaf);
}

ChangesStore::Page ChangesStore::list(const ChangeFilter& filter, std::int64_t after,
                                      std::int64_t limit) const {
  using Limits = std::numeric_limits<std::int64_t>;
  constexpr std::size_t kMostBytes = std::size_t{4} << 20;
  Page page;
  std::size_t bytes = 0;
  for (Rows rows = statements_->list.query(after, filter.kind, filter.name,
                                           filter.from_ns.value_or(Limits::min()),
                                           filter.to_ns.value_or(Limits::max()), limit + 1);
       rows.next();) {
    page.has_more = page.changes.size() == static_cast<std::size_t>(limit) || bytes > kMostBytes;
    if (page.has_more) break;
    require_sound(rows, 9, kChanges);
    const Change& change =
        page.changes.emplace_back(Change{.id = rows.get<std::int64_t>(0),
                                         .at_ns = rows.get<std::int64_t>(1),
                                         .caller = rows.get<std::optional<std::string>>(2),
                                         .kind = rows.get<std::string>(3),
                                         .name = rows.get<std::string>(4),
                                         .action = rows.get<std::string>(5),
                                         .before = rows.get<std::optional<std::string>>(6),
                                         .after = rows.get<std::optional<std::string>>(7)});
    bytes += change.before.value_or("").size() + change.after.value_or("").size();
  }
  return page;
}

void ChangesStore::leaves(std::int64_t after, std::int64_t count,
                          const std::function<void(const Digest&)>& visit) const {
  for (Rows rows = statements_->leaves.query(after, after + count); rows.next();) {
    visit(rows.get<Digest>(0));
  }
}

}  // namespace fitgauge::store
