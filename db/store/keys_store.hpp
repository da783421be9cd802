#pragma once

#include "base/clock.hpp"
#include "base/digest.hpp"
#include "db/store/on_connection.hpp"

namespace fitgauge::store {

/// A request that carries an Idempotency-Key. Caller, method and path are the key's scope.
struct IdempotentRequest {
  std::string caller{};
  std::string method{};
  std::string path{};
  std::string key{};
  Digest body{};                  ///< of the raw body
  bool is_kept_for_ever = false;  ///< else for the retention
};

/// A response that is stored and replayed.
struct StoredAnswer {
  int status = 200;
  std::string content_type{};
  std::string location{};  ///< empty: no Location
  std::string body{};
  bool replayed = false;  ///< set on an answer that came from the store
};

/// The answers of requests with an Idempotency-Key. An answer counts until the writer's maintenance
/// purges it after it has expired.
class IdempotencyStore : public OnConnection<IdempotencyStore> {
 public:
  IdempotencyStore(sql::Connection& connection, const Clock& clock, std::chrono::hours retention)
      : OnConnection(connection), clock_(clock), retention_(retention) {}

  /// Returns the stored response; none if the key is new. Called before the body is parsed, so that
  /// a repeat gets the same response in any case.
  /// @errors IdempotencyKeyReused if the key was used with another body.
  Result<std::optional<StoredAnswer>> find(const IdempotentRequest& request) const;

  /// Returns the stored response, or the response of `work`, which is stored if its status is 2xx.
  /// @errors IdempotencyKeyReused; those of `work`.
  Result<StoredAnswer> once(const IdempotentRequest& request,
                            const std::function<Result<StoredAnswer>()>& work);

  /// A response that was stored with a row, and is forwarded with it.
  struct Forwarded {
    IdempotentRequest request{};
    StoredAnswer answer{};
    std::int64_t expires_at_ns = std::numeric_limits<std::int64_t>::max();

    /// Returns the end of validity; none if it never expires.
    std::optional<Timestamp> expires_at() const {
      const bool for_ever = expires_at_ns == std::numeric_limits<std::int64_t>::max();
      return for_ever ? std::nullopt : std::optional(Timestamp{expires_at_ns});
    }
  };
  /// Visits the responses for measurements (a path from `/v1/measurements` on) that were stored
  /// while the newest measurement had one of these ids.
  using Visitor = std::function<void(const Forwarded&)>;
  void visit_forwarded(std::int64_t first, std::int64_t last, const Visitor& visit) const;
  /// Stores an answer from elsewhere, unless one with that key exists.
  void keep(const Forwarded& forwarded);

  /// Deletes up to `limit` answers that have expired by `now`. @returns how many.
  std::int64_t purge(Timestamp now, std::int64_t limit);

 private:
  const Clock& clock_;
  const std::chrono::hours retention_;
};

/// Rights of a caller. An operator has all rights of a viewer, an administrator all rights; a
/// station may read, and forward its log. The codes are stored: never change one, never use one
/// again.
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

inline constexpr std::size_t kShortestToken = 16;  ///< characters of a key that was made elsewhere

/// `fg_` and 256 random bits in hexadecimal. Shown once, never stored.
std::string new_token();

/// The keys that are not revoked, for a lookup at every request without SQLite. Immutable.
class KeyRing {
 public:
  explicit KeyRing(std::vector<ApiKey> keys) : keys_(std::move(keys)) {}

  /// Returns the key of this token or none, in a time that depends only on the number of keys.
  const ApiKey* find(std::string_view token) const;
  const ApiKey* find(std::int64_t id) const;
  const std::vector<ApiKey>& keys() const { return keys_; }

 private:
  std::vector<ApiKey> keys_;
};

/// The API keys. A revoked key stays in the list, so that its name in old rows can be explained.
class KeysStore : public OnConnection<KeysStore> {
 public:
  /// Stores the hash of `token`, from new_token or with at least 16 characters of an
  /// administrator. A token that was replaced under this name and role is valid again.
  /// @errors FieldConflict when a valid key has the name, or a key the token; FieldInvalid.
  Result<ApiKey> create(std::string_view name, Role role, std::string_view token,
                        std::int64_t now_ns, std::optional<std::int64_t> expires_at_ns = {});

  /// Returns the valid key with this name; if there is none, the key that was revoked last.
  std::optional<ApiKey> newest(std::string_view name) const;
  /// Stores a key of a centre by its hash. @returns false: another key has the name or the hash.
  bool receive(std::string_view name, Role role, const Digest& token_hash, std::int64_t now_ns,
               std::optional<std::int64_t> expires_at_ns);

  /// @errors NotFound when no valid key has the name.
  Result<void> revoke(std::string_view name, std::int64_t now_ns);

  std::vector<ApiKey> list() const;  ///< oldest first, with revoked keys

  /// The keys that are not revoked. Other processes create and revoke keys too: load it again every
  /// few seconds.
  KeyRing ring() const;
};

}  // namespace fitgauge::store
