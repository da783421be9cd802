#include "db/store/keys_store.hpp"

#include <fmt/format.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <stdexcept>

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

std::vector<ApiKey> read_keys(Rows rows) {
  std::vector<ApiKey> keys;
  while (rows.next()) {
    keys.push_back({.id = rows.get<std::int64_t>(0),
                    .name = rows.get<std::string>(1),
                    .role = rows.get<Role>(2),
                    .token_hash = rows.get<Digest>(3),
                    .created_at_ns = rows.get<std::int64_t>(4),
                    .revoked_at_ns = rows.get<std::optional<std::int64_t>>(5),
                    .expires_at_ns = rows.get<std::optional<std::int64_t>>(6)});
  }
  return keys;
}

}  // namespace

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
  const auto found =
      std::find_if(keys_.begin(), keys_.end(), [id](const ApiKey& key) { return key.id == id; });
  return found == keys_.end() ? nullptr : &*found;
}

struct KeysStore::Statements {
  explicit Statements(sql::Connection& c)
      : all(c, select_keys("ORDER BY id")),
        valid(c, select_keys("WHERE revoked_at IS NULL ORDER BY id")),
        newest(c, select_keys("WHERE name = ? ORDER BY revoked_at IS NOT NULL, id DESC LIMIT 1")),
        clash(c,
              "SELECT name = ?1 AND revoked_at IS NULL FROM api_keys "
              "WHERE (name = ?1 AND revoked_at IS NULL) OR token_hash = ?2 ORDER BY 1 DESC"),
        insert(c, kApiKeys.insert(c) + " RETURNING id"),
        revoke(c,
               "UPDATE api_keys SET revoked_at = ?2 WHERE name = ?1 AND revoked_at IS NULL "
               "RETURNING id"),
        seal(c, kApiKeys) {}

  sql::Statement all;
  sql::Statement valid;
  sql::Statement newest;
  sql::Statement clash;
  sql::Statement insert;
  sql::Statement revoke;
  Seal seal;
};

KeysStore::KeysStore(sql::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
KeysStore::~KeysStore() = default;

Result<ApiKey> KeysStore::create(std::string_view name, Role role, std::string_view token,
                                 std::int64_t now_ns, std::optional<std::int64_t> expires_at_ns) {
  if (name.empty()) return Error{ErrorCode::FieldInvalid, "a key needs a name", "name"};
  if (token.size() < kShortestToken) {
    return Error{ErrorCode::FieldInvalid,
                 fmt::format("a key needs at least {} characters", kShortestToken), "token"};
  }
  ApiKey key{.id = 0,
             .name = std::string(name),
             .role = role,
             .token_hash = sha256(token),
             .created_at_ns = now_ns,
             .revoked_at_ns = std::nullopt,
             .expires_at_ns = expires_at_ns};
  if (key.is_expired(now_ns)) {
    return Error{ErrorCode::FieldInvalid, "a key must expire later than now", "expires"};
  }
  if (Rows clash = statements_->clash.query(name, key.token_hash); clash.next()) {
    if (clash.get<bool>(0)) {
      return Error{
          ErrorCode::FieldConflict,
          fmt::format("there is a key '{}'; revoke it first, or choose another name", name),
          "name"};
    }
    return Error{ErrorCode::FieldConflict, "this token was used before; make a new one", "token"};
  }
  key.id = statements_->insert.returning<std::int64_t>(name, role, key.token_hash, now_ns,
                                                       key.revoked_at_ns, key.expires_at_ns);
  return key;
}

std::optional<ApiKey> KeysStore::newest(std::string_view name) const {
  auto found = read_keys(statements_->newest.query(name));
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

bool KeysStore::receive(std::string_view name, Role role, const Digest& token_hash,
                        std::int64_t now_ns, std::optional<std::int64_t> expires_at_ns) {
  if (statements_->clash.query(name, token_hash).next()) return false;
  statements_->insert.returning<std::int64_t>(name, role, token_hash, now_ns,
                                              std::optional<std::int64_t>(), expires_at_ns);
  return true;
}

Result<void> KeysStore::revoke(std::string_view name, std::int64_t now_ns) {
  std::optional<std::int64_t> id;
  for (Rows rows = statements_->revoke.query(name, now_ns); rows.next();) {
    id = rows.get<std::int64_t>(0);
  }
  if (!id) return Error{ErrorCode::NotFound, fmt::format("there is no valid key '{}'", name)};
  statements_->seal.renew(*id);
  return {};
}

std::vector<ApiKey> KeysStore::list() const { return read_keys(statements_->all.query()); }

KeyRing KeysStore::ring() const { return KeyRing(read_keys(statements_->valid.query())); }

}  // namespace fitgauge::store
