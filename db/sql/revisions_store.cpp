#include "db/store/revisions_store.hpp"

#include <fmt/format.h>

#include <charconv>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {

using sql::Rows;
using sql::Statement;

namespace {

constexpr std::string_view kBeforeTheFirst = "0";
constexpr std::string_view kPositionColumn = "number || '-' || lower(hex(tag))";

}  // namespace

struct RevisionsStore::Statements {
  explicit Statements(sql::Connection& c)
      : list(c,
             "SELECT r.number, r.kind, r.name FROM revisions r WHERE r.number > ? AND "
             "(r.station IS NULL OR r.station IN (WITH RECURSIVE below (origin) AS (SELECT "
             "CAST(? AS BIGINT) UNION SELECT b.base FROM origin_bases b JOIN below ON b.origin = "
             "below.origin) SELECT origin FROM below)) AND r.number = (SELECT max(n.number) FROM "
             "revisions n WHERE n.kind = r.kind AND n.name = r.name) ORDER BY r.number LIMIT ?"),
        newest(c, fmt::format("SELECT {} FROM revisions ORDER BY number DESC LIMIT 1",
                              kPositionColumn)),
        position(c, fmt::format("SELECT {} FROM revisions WHERE number = ?", kPositionColumn)),
        received(c, fmt::format("SELECT number, digest, {} FROM received WHERE kind = ? AND "
                                "name = ?",
                                kReceived.is_sound(c))),
        set_received(c, kReceived.replace(c)),
        forget(c, "DELETE FROM received WHERE kind = ? AND name = ?") {}

  Statement list;
  Statement newest;
  Statement position;
  Statement received;
  Statement set_received;
  Statement forget;
};

RevisionsStore::RevisionsStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
RevisionsStore::~RevisionsStore() = default;

std::vector<RevisionsStore::Revision> RevisionsStore::list(std::int64_t after, std::int64_t station,
                                                           std::int64_t limit) const {
  std::vector<Revision> revisions;
  for (Rows rows = statements_->list.query(after, station, limit); rows.next();) {
    revisions.push_back({.number = rows.get<std::int64_t>(0),
                         .kind = rows.get<RevisionKind>(1),
                         .name = rows.get<std::string>(2)});
  }
  return revisions;
}

std::string RevisionsStore::newest_position() const {
  Rows rows = statements_->newest.query();
  return rows.next() ? rows.get<std::string>(0) : std::string(kBeforeTheFirst);
}

std::string RevisionsStore::position(std::int64_t number) const {
  Rows rows = statements_->position.query(number);
  return rows.next() ? rows.get<std::string>(0) : std::string(kBeforeTheFirst);
}

std::optional<std::int64_t> RevisionsStore::number_of(std::string_view text) const {
  std::int64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return position(number) == text ? std::optional(number) : std::nullopt;
}

std::optional<RevisionsStore::Received> RevisionsStore::received(RevisionKind kind,
                                                                 std::string_view name) const {
  Rows rows = statements_->received.query(kind, name);
  if (!rows.next()) return std::nullopt;
  require_sound(rows, 2, kReceived);
  return Received{.number = rows.get<std::int64_t>(0), .digest = rows.get<Digest>(1)};
}

void RevisionsStore::set_received(RevisionKind kind, std::string_view name,
                                  const Received& received) {
  statements_->set_received.run(kind, name, received.number, received.digest);
}

void RevisionsStore::forget_received(RevisionKind kind, std::string_view name) {
  statements_->forget.run(kind, name);
}

}  // namespace fitgauge::store
