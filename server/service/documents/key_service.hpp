#pragma once

#include "base/thread.hpp"
#include "db/store/keys_store.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

using store::kShortestToken;
using store::Role;

/// Whether `role` may do what `needed` may.
bool may(Role role, Role needed);

inline constexpr std::array<std::string_view, 4> kRoles{"viewer", "operator", "admin", "station"};
constexpr std::string_view word(Role role) { return kRoles.at(static_cast<std::size_t>(role) - 1); }
constexpr std::optional<Role> role_from_word(std::string_view text) {
  return enum_of<Role>(text, kRoles, 1);
}

/// Revokes a key and logs the change. Used inside a write job. @errors NotFound.
Result<void> revoke_key(Stores& stores, const std::string& name, std::int64_t now_ns);
/// Logs that the newest key of that name was made, or revoked: its role and expiry, no secret.
void log_key(Stores& stores, const std::string& name, std::int64_t now_ns, bool is_made);

/// A caller that a token was given to.
struct KnownCaller {
  std::string name;
  Role role = Role::Viewer;
  std::int64_t key = 0;  ///< for is_valid()
  bool is_expired = false;
};

/// API keys. Finding one needs no storage; the keys are loaded again every second, because the
/// command line also changes them. Thread-safe.
class KeyService {
 public:
  /// @param tell receives `key_created` and `key_revoked` with the key's name and role.
  /// @errors StorageUnavailable.
  static Result<std::unique_ptr<KeyService>> open(Database& database, const Clock& clock,
                                                  Tell tell);
  ~KeyService();

  std::optional<KnownCaller> find(std::string_view token) const;
  /// Whether the key of a KnownCaller is neither revoked nor expired.
  bool is_valid(std::int64_t key) const;

  // These block: for commands, not for I/O threads.

  /// A secret that create() accepts.
  static std::string new_token();
  /// @param token the secret of the key; a new one is made when empty.
  /// @returns the token, which is not stored. @errors FieldConflict, FieldInvalid.
  Result<std::string> create(const std::string& name, Role role, std::string token = {},
                             std::optional<Timestamp> expires = {});
  /// Revokes the key `name` and makes an administrator's key with that name and this token, both or
  /// neither.
  /// @errors NotFound, FieldConflict, FieldInvalid.
  Result<std::string> replace(const std::string& name, const std::string& token);
  /// @errors NotFound.
  Result<void> revoke(const std::string& name);
  Result<std::vector<store::ApiKey>> list() const;  ///< oldest first, with revoked keys

 private:
  KeyService(Database& database, const Clock& clock, Tell tell)
      : database_(database), clock_(clock), tell_(std::move(tell)) {}
  Result<void> reload();
  void tell_changes(const store::KeyRing& before, const store::KeyRing& now) const;

  Database& database_;
  const Clock& clock_;
  const Tell tell_;
  std::mutex loading_;
  Snapshot<store::KeyRing> ring_;
  Thread loader_;
};

}  // namespace fitgauge::app
