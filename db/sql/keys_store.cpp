#include "db/store/keys_store.hpp"

#include <openssl/rand.h>

#include "db/sql/sealed_table.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store {
namespace {

using sql::Rows;

std::string select_keys(std::string_view rest) {
  return fmt::format(
      "SELECT id, name, role, token_hash, created_at, revoked_at, expires_at FROM api_keys {}",
      rest);
}

constexpr std::size_t kLongestName = 200;

/// Whether records can have the name as their caller, and lists of keys one line for it.
bool is_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestName && is_utf8(name) &&
         std::ranges::none_of(
             name, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; });
}

}  // namespace

using sql::Blob;

template <>
struct StatementsOf<IdempotencyStore> {
  sql::Connection& c;
  sql::MeasurementTable& measurements{c.measurements()};
  sql::Statement find{
      c, kIdempotentAnswers.select(c, "WHERE key = ? AND caller = ? AND method = ? AND path = ?",
                                   "body_digest, status, content_type, location, body")};
  sql::Statement insert{c, kIdempotentAnswers.insert(c)};
  sql::Statement forwarded{
      c, kIdempotentAnswers.select(c,
                                   "WHERE measurement BETWEEN ? AND ? AND path LIKE "
                                   "'/v1/measurements%' ORDER BY id")};
  sql::Statement is_kept{
      c,
      "SELECT 1 FROM idempotent_answers WHERE key = ? AND caller = ? AND method = ? AND path = ?"};
  sql::Statement remove{
      c,
      "DELETE FROM idempotent_answers WHERE id IN (SELECT id FROM idempotent_answers WHERE "
      "expires_at <= ? LIMIT ?) RETURNING 1"};
};

Result<std::optional<StoredAnswer>> IdempotencyStore::find(const IdempotentRequest& request) const {
  Rows rows = statements().find.query(request.key, request.caller, request.method, request.path);
  if (!rows.next()) return std::optional<StoredAnswer>();
  require_sound(rows, 5, kIdempotentAnswers);
  if (rows.get<Digest>(0) != request.body) {
    return Error{
        ErrorCode::IdempotencyKeyReused,
        "this Idempotency-Key was used with another body: use a new key for each new request"};
  }
  return std::optional(StoredAnswer{.status = rows.get<int>(1),
                                    .content_type = rows.get<std::string>(2),
                                    .location = rows.get<std::string>(3),
                                    .body = std::string(rows.get<Blob>(4).bytes),
                                    .replayed = true});
}

Result<StoredAnswer> IdempotencyStore::once(const IdempotentRequest& request,
                                            const std::function<Result<StoredAnswer>()>& work) {
  if (auto kept = TRY(find(request))) return *std::move(kept);
  Result<StoredAnswer> answer = work();
  if (!answer || answer->status < 200 || answer->status > 299) return answer;
  const std::int64_t expires_at =
      request.is_kept_for_ever
          ? std::numeric_limits<std::int64_t>::max()
          : clock_.now().nanoseconds + std::chrono::nanoseconds(retention_).count();
  const std::int64_t newest = statements().measurements.last_id();
  statements().insert.run(request.key, request.caller, request.method, request.path, request.body,
                          answer->status, answer->content_type, answer->location,
                          Blob{answer->body}, expires_at,
                          newest > 0 ? std::optional(newest) : std::nullopt);
  return answer;
}

void IdempotencyStore::visit_forwarded(std::int64_t first, std::int64_t last,
                                       const Visitor& visit) const {
  Rows rows = statements().forwarded.query(first, last);
  while (rows.next()) {
    require_sound(rows, 11, kIdempotentAnswers);
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
      statements().is_kept.query(request.key, request.caller, request.method, request.path).next();
  if (is_kept) return;
  const StoredAnswer& answer = forwarded.answer;
  statements().insert.run(request.key, request.caller, request.method, request.path, request.body,
                          answer.status, answer.content_type, answer.location, Blob{answer.body},
                          forwarded.expires_at_ns, std::optional<std::int64_t>());
}

std::int64_t IdempotencyStore::purge(Timestamp now, std::int64_t limit) {
  return statements().remove.run_counting(now.nanoseconds, limit);
}

std::string new_token() {
  std::array<std::uint8_t, 32> bits{};
  if (RAND_bytes(bits.data(), static_cast<int>(bits.size())) != 1) {
    throw std::runtime_error("OpenSSL has no random numbers");
  }
  return "fg_" + to_hex(bits);
}

const ApiKey* KeyRing::find(std::string_view token) const {
  const Digest hash = sha256(token);
  const ApiKey* found = nullptr;
  for (const ApiKey& key : keys_) {
    if (equal_in_constant_time(key.token_hash, hash)) found = &key;
  }
  return found;
}

const ApiKey* KeyRing::find(std::int64_t id) const {
  const auto found = std::ranges::find(keys_, id, &ApiKey::id);
  return found == keys_.end() ? nullptr : &*found;
}

template <>
struct StatementsOf<KeysStore> {
  sql::Connection& c;
  sql::Statement all{c, select_keys("ORDER BY id")};
  sql::Statement valid{c, select_keys("WHERE revoked_at IS NULL ORDER BY id")};
  sql::Statement newest{
      c, select_keys("WHERE name = ? ORDER BY revoked_at IS NOT NULL, id DESC LIMIT 1")};
  sql::Statement clash{
      c,
      "SELECT name = ?1 AND revoked_at IS NULL FROM api_keys "
      "WHERE (name = ?1 AND revoked_at IS NULL) OR token_hash = ?2 ORDER BY 1 DESC"};
  sql::Statement insert{c, kApiKeys.insert(c) + " RETURNING id"};
  sql::Statement revoke{
      c,
      "UPDATE api_keys SET revoked_at = ?2 WHERE name = ?1 AND revoked_at IS NULL "
      "RETURNING id"};
  sql::Statement forget_replaced{
      // revoked when its successor was made; the log of changes knows successors that are gone too
      c,
      "DELETE FROM api_keys WHERE token_hash = ?1 AND name = ?2 AND role = ?3 AND revoked_at IN "
      "(SELECT created_at FROM api_keys WHERE name = ?2 UNION ALL SELECT at FROM changes "
      "WHERE kind = 'key' AND name = ?2 AND action = 'created')"};
  Seal seal{c, kApiKeys};
};

Result<ApiKey> KeysStore::create(std::string_view name, Role role, std::string_view token,
                                 std::int64_t now_ns, std::optional<std::int64_t> expires_at_ns) {
  if (!is_name(name)) {
    return Error{
        ErrorCode::FieldInvalid,
        fmt::format("name of the key must have 1 to {} bytes of UTF-8 without control characters",
                    kLongestName),
        "name"};
  }
  if (token.size() < kShortestToken) {
    return Error{ErrorCode::FieldInvalid,
                 fmt::format("key must have at least {} characters", kShortestToken), "token"};
  }
  ApiKey key{.id = 0,
             .name = std::string(name),
             .role = role,
             .token_hash = sha256(token),
             .created_at_ns = now_ns,
             .revoked_at_ns = std::nullopt,
             .expires_at_ns = expires_at_ns};
  if (key.is_expired(now_ns)) {
    return Error{ErrorCode::FieldInvalid, "expires must be a time in the future", "expires"};
  }
  statements().forget_replaced.run(key.token_hash, name, role);
  if (Rows clash = statements().clash.query(name, key.token_hash); clash.next()) {
    if (clash.get<bool>(0)) {
      return Error{
          ErrorCode::FieldConflict,
          fmt::format("a key with the name '{}' exists: revoke it first, or choose another name",
                      name),
          "name"};
    }
    return Error{ErrorCode::FieldConflict, "this key was used before: create a new one", "token"};
  }
  key.id = statements().insert.returning<std::int64_t>(name, role, key.token_hash, now_ns,
                                                       key.revoked_at_ns, key.expires_at_ns);
  return key;
}

std::optional<ApiKey> KeysStore::newest(std::string_view name) const {
  return read_first<ApiKey>(statements().newest.query(name));
}

bool KeysStore::receive(std::string_view name, Role role, const Digest& token_hash,
                        std::int64_t now_ns, std::optional<std::int64_t> expires_at_ns) {
  if (statements().clash.query(name, token_hash).next()) return false;
  statements().insert.returning<std::int64_t>(name, role, token_hash, now_ns,
                                              std::optional<std::int64_t>(), expires_at_ns);
  return true;
}

Result<void> KeysStore::revoke(std::string_view name, std::int64_t now_ns) {
  const auto ids = read_all<std::int64_t>(statements().revoke.query(name, now_ns));
  if (ids.empty())
    return Error{ErrorCode::NotFound, fmt::format("valid key not found: '{}'", name)};
  statements().seal.renew(ids.back());
  return {};
}

std::vector<ApiKey> KeysStore::list() const { return read_all<ApiKey>(statements().all.query()); }

KeyRing KeysStore::ring() const { return KeyRing(read_all<ApiKey>(statements().valid.query())); }

}  // namespace fitgauge::store
