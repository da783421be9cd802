#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/digest.hpp"
#include "base/result.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

// The codes are stored: never change one, never use one again.
enum class Role : std::uint8_t { Viewer = 1, Operator = 2, Admin = 3, Station = 4 };
constexpr Role last_of(Role) { return Role::Station; }

struct ApiKey {
  std::int64_t id = 0;
  std::string name{};  ///< unique among the keys that are not revoked
  Role role = Role::Viewer;
  Digest token_hash{};  ///< SHA-256: the token is 256 random bits, so no salt is needed
  std::int64_t created_at_ns = 0;
  std::optional<std::int64_t> revoked_at_ns{};
  std::optional<std::int64_t> expires_at_ns{};  ///< valid before, not at that time

  bool is_expired(std::int64_t now_ns) const { return expires_at_ns && *expires_at_ns <= now_ns; }
};

inline constexpr std::size_t kShortestToken = 16;  ///< characters of one that was not made here

/// `fg_` and 256 random bits in hexadecimal. Shown once, never stored.
std::string new_token();

/// The keys that are not revoked, for a lookup at every request without SQLite. Immutable.
class KeyRing {
 public:
  explicit KeyRing(std::vector<ApiKey> keys) : keys_(std::move(keys)) {}

  /// The key of this token or none, in a time that depends on the number of keys alone.
  const ApiKey* find(std::string_view token) const;
  const ApiKey* find(std::int64_t id) const;
  const std::vector<ApiKey>& keys() const { return keys_; }

 private:
  std::vector<ApiKey> keys_;
};

/// The API keys. A revoked key stays in the list, so that its name in old rows can be explained.
class KeysStore {
 public:
  explicit KeysStore(sql::Connection& connection);
  ~KeysStore();

  /// Stores the hash of `token` (new_token, or an administrator's own of at least 16 characters).
  /// @errors FieldConflict when a valid key has the name or the token; FieldInvalid.
  Result<ApiKey> create(std::string_view name, Role role, std::string_view token,
                        std::int64_t now_ns, std::optional<std::int64_t> expires_at_ns = {});

  /// The valid key of that name; else the one that was revoked last.
  std::optional<ApiKey> newest(std::string_view name) const;
  /// Stores a key of a centre by its hash. @returns false: another key has the name or the hash.
  bool receive(std::string_view name, Role role, const Digest& token_hash, std::int64_t now_ns,
               std::optional<std::int64_t> expires_at_ns);

  /// @errors NotFound when no valid key has the name.
  Result<void> revoke(std::string_view name, std::int64_t now_ns);

  std::vector<ApiKey> list() const;  ///< oldest first, revoked ones too

  /// The keys that are not revoked. Other processes create and revoke keys too: load it again every
  /// few seconds.
  KeyRing ring() const;

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
