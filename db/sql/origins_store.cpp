#include "db/store/log_store.hpp"

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {

using sql::Rows;
using sql::Statement;
namespace {

constexpr std::string_view kOriginColumns = "number, digits, first_row, size, checkpoint";

constexpr const char* kBeforeTheFirst = "0";
constexpr std::string_view kPositionColumn = "number || '-' || lower(hex(tag))";

}  // namespace

template <>
struct StatementsOf<OriginsStore> {
  sql::Connection& c;
  Statement list{c, kOrigins.select(c, "ORDER BY number", kOriginColumns)};
  Statement by_digits{c, kOrigins.select(c, "WHERE digits = ?", kOriginColumns)};
  Statement by_number{c, kOrigins.select(c, "WHERE number = ?", kOriginColumns)};
  Statement insert{c, kOrigins.insert(c) + " RETURNING number"};
  Statement set_head{c,
                     "UPDATE origins SET first_row = ?, size = ?, checkpoint = ? WHERE number = ?"};
  Seal seal{c, kOrigins};
  Statement keys{c, kOriginKeys.select(c, "WHERE origin = ? ORDER BY number", "vkey")};
  Statement add_key{c, kOriginKeys.insert(c)};
  Statement base{c, kOriginBases.select(c, "WHERE origin = ?", "base, size")};
  Statement is_base{c, "SELECT count(*) FROM origin_bases WHERE base = ?"};
  Statement set_base{c, kOriginBases.insert(c)};
  Statement put_node{
      c,
      "INSERT INTO origin_nodes VALUES (?, ?, ?, ?) ON CONFLICT (origin, level, node) "
      "DO UPDATE SET hash = excluded.hash"};
  Statement nodes{c,
                  "SELECT hash FROM origin_nodes WHERE origin = ? AND level = ? AND node >= ? AND "
                  "node < ? ORDER BY node"};
  Statement add_fork{c, kOriginForks.insert(c) + " ON CONFLICT DO NOTHING RETURNING 1"};
  Statement revisions{c, "SELECT number, id FROM origin_revisions ORDER BY number"};
  Statement revision{c, "SELECT number FROM origin_revisions WHERE id = ?"};
  Statement add_revision{c, kOriginRevisions.insert(c) + " RETURNING number"};
  Statement forwarded{c, kForwarding.select(c, "", "centre, size")};
  Statement set_forwarded{c, kForwarding.replace(c)};
};

std::vector<OriginsStore::Origin> OriginsStore::list() const {
  return read_all<Origin>(statements().list.query(), kOrigins);
}

std::optional<OriginsStore::Origin> OriginsStore::find(std::string_view digits) const {
  return read_first<Origin>(statements().by_digits.query(digits), kOrigins);
}

std::optional<OriginsStore::Origin> OriginsStore::find(std::int64_t number) const {
  return read_first<Origin>(statements().by_number.query(number), kOrigins);
}

std::int64_t OriginsStore::add(std::string_view digits) {
  return statements().insert.returning<std::int64_t>(digits, std::optional<std::int64_t>(), 0,
                                                     std::string_view());
}

void OriginsStore::set_head(const Origin& origin) {
  statements().set_head.run(origin.first_row, origin.size, origin.checkpoint, origin.number);
  statements().seal.renew(origin.number);
}

std::vector<std::string> OriginsStore::keys(std::int64_t origin) const {
  return read_all<std::string>(statements().keys.query(origin), kOriginKeys);
}

void OriginsStore::add_key(std::int64_t origin, std::string_view vkey, std::int64_t now_ns) {
  statements().add_key.run(origin, vkey, now_ns);
}

std::optional<OriginsStore::Base> OriginsStore::base(std::int64_t origin) const {
  return read_first<Base>(statements().base.query(origin), kOriginBases);
}

bool OriginsStore::is_base(std::int64_t origin) const {
  return statements().is_base.returning<std::int64_t>(origin) > 0;
}

void OriginsStore::set_base(std::int64_t origin, const Base& base) {
  statements().set_base.run(origin, base.origin, base.size);
}

void OriginsStore::keep_nodes(std::int64_t origin, std::span<const LogStore::Node> nodes) {
  for (const LogStore::Node& node : nodes) {
    statements().put_node.run(origin, node.level, node.index, node.hash);
  }
}

std::int64_t OriginsStore::nodes(std::int64_t origin, int level, std::int64_t first,
                                 std::int64_t count, const LogStore::Visitor& visit) const {
  std::int64_t visited = 0;
  Rows rows = statements().nodes.query(origin, level, first, first + count);
  for (; rows.next(); ++visited) visit(rows.get<Digest>(0));
  return visited;
}

bool OriginsStore::add_fork(std::int64_t origin, std::string_view checkpoint, std::int64_t now_ns) {
  return statements().add_fork.run_counting(origin, checkpoint, now_ns) > 0;
}

std::vector<OriginsStore::Revision> OriginsStore::revisions() const {
  return read_all<Revision>(statements().revisions.query());
}

std::int64_t OriginsStore::add_revision(std::string_view id) {
  if (const auto known = read_first<std::int64_t>(statements().revision.query(id))) return *known;
  return statements().add_revision.returning<std::int64_t>(id);
}

std::optional<OriginsStore::Forwarded> OriginsStore::forwarded() const {
  return read_first<Forwarded>(statements().forwarded.query(), kForwarding);
}

void OriginsStore::set_forwarded(const Forwarded& forwarded) {
  statements().set_forwarded.run(1, forwarded.centre, forwarded.size);
}

template <>
struct StatementsOf<RevisionsStore> {
  sql::Connection& c;
  Statement list{
      c,
      "SELECT r.number, r.kind, r.name FROM revisions r WHERE r.number > ? AND "
      "(r.station IS NULL OR r.station IN (WITH RECURSIVE below (origin) AS (SELECT "
      "CAST(? AS BIGINT) UNION SELECT b.base FROM origin_bases b JOIN below ON b.origin = "
      "below.origin) SELECT origin FROM below)) AND r.number = (SELECT max(n.number) FROM "
      "revisions n WHERE n.kind = r.kind AND n.name = r.name) ORDER BY r.number LIMIT ?"};
  Statement newest{
      c, fmt::format("SELECT {} FROM revisions ORDER BY number DESC LIMIT 1", kPositionColumn)};
  Statement position{c, fmt::format("SELECT {} FROM revisions WHERE number = ?", kPositionColumn)};
  Statement received{c, kReceived.select(c, "WHERE kind = ? AND name = ?", "number, digest")};
  Statement set_received{c, kReceived.replace(c)};
  Statement forget{c, "DELETE FROM received WHERE kind = ? AND name = ?"};
};

std::vector<RevisionsStore::Revision> RevisionsStore::list(std::int64_t after, std::int64_t station,
                                                           std::int64_t limit) const {
  return read_all<Revision>(statements().list.query(after, station, limit));
}

std::string RevisionsStore::newest_position() const {
  return read_first<std::string>(statements().newest.query()).value_or(kBeforeTheFirst);
}

std::string RevisionsStore::position(std::int64_t number) const {
  return read_first<std::string>(statements().position.query(number)).value_or(kBeforeTheFirst);
}

std::optional<std::int64_t> RevisionsStore::number_of(std::string_view text) const {
  std::int64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return position(number) == text ? std::optional(number) : std::nullopt;
}

std::optional<RevisionsStore::Received> RevisionsStore::received(RevisionKind kind,
                                                                 std::string_view name) const {
  return read_first<Received>(statements().received.query(kind, name), kReceived);
}

void RevisionsStore::set_received(RevisionKind kind, std::string_view name,
                                  const Received& received) {
  statements().set_received.run(kind, name, received.number, received.digest);
}

void RevisionsStore::forget_received(RevisionKind kind, std::string_view name) {
  statements().forget.run(kind, name);
}

}  // namespace fitgauge::store
