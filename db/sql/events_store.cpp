#include "db/store/events_store.hpp"

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {

using sql::Rows;

struct EventsStore::Statements {
  explicit Statements(sql::Connection& c)
      : insert(c, kEvents.insert(c) + " RETURNING id"),
        after(c,
              "SELECT id, type, payload, created_at FROM events WHERE id > ? ORDER BY id LIMIT ?"),
        kept(c,
             "SELECT coalesce((SELECT min(id) FROM events), 0), "
             "coalesce((SELECT max(id) FROM events), 0)"),
        // Ids have no gaps, as events are deleted from the oldest on.
        trim(c,
             "DELETE FROM events WHERE id IN (SELECT id FROM events "
             "WHERE id <= (SELECT max(id) FROM events) - ?1 ORDER BY id LIMIT ?2) RETURNING 1") {}

  sql::Statement insert;
  sql::Statement after;
  sql::Statement kept;
  sql::Statement trim;
};

EventsStore::EventsStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
EventsStore::~EventsStore() = default;

std::int64_t EventsStore::append(std::string_view type, std::string_view payload,
                                 std::int64_t now_ns) {
  return statements_->insert.returning<std::int64_t>(type, payload, now_ns);
}

std::vector<Event> EventsStore::after(std::int64_t id, std::size_t limit) const {
  std::vector<Event> events;
  for (Rows rows = statements_->after.query(id, limit); rows.next();) {
    events.push_back({.id = rows.get<std::int64_t>(0),
                      .type = rows.get<std::string>(1),
                      .payload = rows.get<std::string>(2),
                      .created_at_ns = rows.get<std::int64_t>(3)});
  }
  return events;
}

EventsStore::Kept EventsStore::kept() const {
  Rows rows = statements_->kept.query();
  rows.next();
  return {.oldest = rows.get<std::int64_t>(0), .newest = rows.get<std::int64_t>(1)};
}

std::int64_t EventsStore::trim(std::int64_t keep, std::int64_t limit) {
  return statements_->trim.run_counting(keep, limit);
}

}  // namespace fitgauge::store
