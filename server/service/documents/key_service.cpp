#include "service/documents/key_service.hpp"

#include "base/json/json_writer.hpp"
#include "db/store/database.hpp"
#include "service/log/leaves.hpp"

namespace fitgauge::app {
namespace {

constexpr std::chrono::seconds kReloadInterval{1};

Result<store::ApiKey> create_key(Stores& stores, const std::string& name, Role role,
                                 const std::string& token, std::int64_t now_ns,
                                 std::optional<std::int64_t> expires_at_ns = {}) {
  auto key = stores.keys.create(name, role, token, now_ns, expires_at_ns);
  if (key) log_key(stores, name, now_ns, true);
  return key;
}

}  // namespace

bool may(Role role, Role needed) {
  switch (needed) {
    case Role::Viewer: return true;
    case Role::Operator: return role == Role::Operator || role == Role::Admin;
    case Role::Station: return role == Role::Station || role == Role::Admin;
    case Role::Admin: break;
  }
  return role == Role::Admin;
}

void log_key(Stores& stores, const std::string& name, std::int64_t now_ns, bool is_made) {
  const auto key = stores.keys.newest(name);
  if (!key) return;
  store::Change change{.at_ns = now_ns, .kind = "key", .name = name};
  (is_made ? change.after : change.before) = api::json_object([&](api::JsonWriter& json) {
    json.member("role", word(key->role));
    if (key->expires_at_ns) json.member("expires_at", format_rfc3339({*key->expires_at_ns}));
  });
  log_change(stores, std::move(change));
}

Result<void> revoke_key(Stores& stores, const std::string& name, std::int64_t now_ns) {
  TRY(stores.keys.revoke(name, now_ns));
  log_key(stores, name, now_ns, false);
  return {};
}

KeyService::~KeyService() = default;

Result<std::unique_ptr<KeyService>> KeyService::open(Database& database, const Clock& clock,
                                                     Tell tell) {
  std::unique_ptr<KeyService> service(new KeyService(database, clock, std::move(tell)));
  TRY(service->reload());
  service->loader_ = Thread("the loader of keys", [raw = service.get()](const auto& stop) {
    // Storage that fails for a while leaves the keys that were loaded last in force.
    while (wait_unless_stopped(stop, kReloadInterval)) static_cast<void>(raw->reload());
  });
  return service;
}

Result<void> KeyService::reload() {
  const std::lock_guard lock(loading_);
  auto ring =
      TRY(database_.readers().wait([](const Stores& stores) { return stores.keys.ring(); }));
  const auto before = ring_.get();
  const auto now = std::make_shared<const store::KeyRing>(std::move(ring));
  ring_.set(now);
  if (before && tell_) tell_changes(*before, *now);
  return {};
}

void KeyService::tell_changes(const store::KeyRing& before, const store::KeyRing& now) const {
  const auto tell = [&](std::string_view event, const store::ApiKey& key) {
    const auto expiry = key.expires_at_ns
                            ? ", expires " + format_rfc3339(Timestamp{*key.expires_at_ns})
                            : std::string();
    tell_(event, fmt::format("{} ({}{})", key.name, word(key.role), expiry));
  };
  for (const store::ApiKey& key : now.keys()) {
    if (before.find(key.id) == nullptr) tell("key_created", key);
  }
  for (const store::ApiKey& key : before.keys()) {
    if (now.find(key.id) == nullptr) tell("key_revoked", key);
  }
}

std::optional<KnownCaller> KeyService::find(std::string_view token) const {
  const auto ring = ring_.get();
  const store::ApiKey* key = ring->find(token);
  if (key == nullptr) return std::nullopt;
  return KnownCaller{.name = key->name,
                     .role = key->role,
                     .key = key->id,
                     .is_expired = key->is_expired(clock_.now().nanoseconds)};
}

bool KeyService::is_valid(std::int64_t key) const {
  const auto ring = ring_.get();
  const store::ApiKey* const found = ring->find(key);
  return found != nullptr && !found->is_expired(clock_.now().nanoseconds);
}

std::string KeyService::new_token() { return store::new_token(); }

Result<std::string> KeyService::create(const std::string& name, Role role, std::string token,
                                       std::optional<Timestamp> expires) {
  if (token.empty()) token = store::new_token();
  const std::int64_t now = clock_.now().nanoseconds;
  TRY(database_.writer().wait([&](Stores& stores) {
    return create_key(stores, name, role, token, now,
                      expires ? std::optional(expires->nanoseconds) : std::nullopt);
  }));
  TRY(reload());
  return token;
}

Result<std::string> KeyService::replace(const std::string& name, const std::string& token) {
  const std::int64_t now = clock_.now().nanoseconds;
  const auto exchange = [&](Stores& stores) -> Result<store::ApiKey> {
    TRY(revoke_key(stores, name, now));
    return create_key(stores, name, store::Role::Admin, token, now);
  };
  TRY(database_.writer().wait(exchange));
  TRY(reload());
  return token;
}

Result<void> KeyService::revoke(const std::string& name) {
  TRY(database_.writer().wait(
      [&](Stores& stores) { return revoke_key(stores, name, clock_.now().nanoseconds); }));
  return reload();
}

Result<std::vector<store::ApiKey>> KeyService::list() const {
  return database_.readers().wait([](const Stores& stores) { return stores.keys.list(); });
}

}  // namespace fitgauge::app
