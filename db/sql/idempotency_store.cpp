#include "db/store/idempotency_store.hpp"

#include <fmt/format.h>

#include <limits>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {

using sql::Blob;
using sql::Rows;

struct IdempotencyStore::Statements {
  Statements(sql::Connection& c, const Clock& time, std::chrono::hours kept_for)
      : measurements(c.measurements()),
        clock(time),
        retention(kept_for),
        find(c, fmt::format("SELECT body_digest, status, content_type, location, body, {} "
                            "FROM idempotent_answers WHERE key = ? AND caller = ? AND method = ? "
                            "AND path = ?",
                            kIdempotentAnswers.is_sound(c))),
        insert(c, kIdempotentAnswers.insert(c)),
        forwarded(c, fmt::format("SELECT key, caller, method, path, body_digest, status, "
                                 "content_type, location, body, expires_at, {} FROM "
                                 "idempotent_answers WHERE measurement BETWEEN ? AND ? AND "
                                 "path LIKE '/v1/measurements%' ORDER BY id",
                                 kIdempotentAnswers.is_sound(c))),
        is_kept(c,
                "SELECT 1 FROM idempotent_answers WHERE key = ? AND caller = ? AND method = ? AND "
                "path = ?"),
        remove(c,
               "DELETE FROM idempotent_answers WHERE id IN "
               "(SELECT id FROM idempotent_answers WHERE expires_at <= ? LIMIT ?) RETURNING 1") {}

  sql::MeasurementTable& measurements;
  const Clock& clock;
  std::chrono::hours retention;
  sql::Statement find;
  sql::Statement insert;
  sql::Statement forwarded;
  sql::Statement is_kept;
  sql::Statement remove;
};

IdempotencyStore::IdempotencyStore(sql::Connection& connection, const Clock& clock,
                                   std::chrono::hours retention)
    : statements_(std::make_unique<Statements>(connection, clock, retention)) {}
IdempotencyStore::~IdempotencyStore() = default;

Result<std::optional<StoredAnswer>> IdempotencyStore::find(const IdempotentRequest& request) const {
  Rows rows = statements_->find.query(request.key, request.caller, request.method, request.path);
  if (!rows.next()) return std::optional<StoredAnswer>();
  require_sound(rows, 5, kIdempotentAnswers);
  if (rows.get<Digest>(0) != request.body) {
    return Error{
        ErrorCode::IdempotencyKeyReused,
        "this Idempotency-Key was used with another body; use a new key for a new request"};
  }
  return std::optional(StoredAnswer{.status = rows.get<int>(1),
                                    .content_type = rows.get<std::string>(2),
                                    .location = rows.get<std::string>(3),
                                    .body = std::string(rows.get<Blob>(4).bytes),
                                    .replayed = true});
}

Result<StoredAnswer> IdempotencyStore::once(const IdempotentRequest& request,
                                            const std::function<Result<StoredAnswer>()>& work) {
  Result<std::optional<StoredAnswer>> kept = find(request);
  if (!kept) return kept.error();
  if (*kept) return **std::move(kept);
  Result<StoredAnswer> answer = work();
  if (!answer || answer->status < 200 || answer->status > 299) return answer;
  const std::int64_t expires_at =
      request.is_kept_for_ever ? std::numeric_limits<std::int64_t>::max()
                               : statements_->clock.now().nanoseconds +
                                     std::chrono::nanoseconds(statements_->retention).count();
  const std::int64_t newest = statements_->measurements.last_id();
  statements_->insert.run(request.key, request.caller, request.method, request.path, request.body,
                          answer->status, answer->content_type, answer->location,
                          Blob{answer->body}, expires_at,
                          newest > 0 ? std::optional(newest) : std::nullopt);
  return answer;
}

void IdempotencyStore::visit_forwarded(std::int64_t first, std::int64_t last,
                                       const Visitor& visit) const {
  Rows rows = statements_->forwarded.query(first, last);
  while (rows.next()) {
    require_sound(rows, 10, kIdempotentAnswers);
    visit({.request = {.caller = rows.get<std::string>(1),
                       .method = rows.get<std::string>(2),
                       .path = rows.get<std::string>(3),
                       .key = rows.get<std::string>(0),
                       .body = rows.get<Digest>(4)},
           .answer = {.status = rows.get<int>(5),
                      .content_type = rows.get<std::string>(6),
                      .location = rows.get<std::string>(7),
                      .body = std::string(rows.get<Blob>(8).bytes)},
           .expires_at_ns = rows.get<std::int64_t>(9)});
  }
}

void IdempotencyStore::keep(const Forwarded& forwarded) {
  const IdempotentRequest& request = forwarded.request;
  const bool is_kept =
      statements_->is_kept.query(request.key, request.caller, request.method, request.path).next();
  if (is_kept) return;
  const StoredAnswer& answer = forwarded.answer;
  statements_->insert.run(request.key, request.caller, request.method, request.path, request.body,
                          answer.status, answer.content_type, answer.location, Blob{answer.body},
                          forwarded.expires_at_ns, std::optional<std::int64_t>());
}

std::int64_t IdempotencyStore::purge(Timestamp now, std::int64_t limit) {
  return statements_->remove.run_counting(now.nanoseconds, limit);
}

}  // namespace fitgauge::store
