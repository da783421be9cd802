#include "api/service/guard.hpp"

#include "api/wire/response_cache.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kTokenPrefix = "fg_";

/// Rights that a route needs: `public` (health, even in keys mode), `open`, or a role. `station`
/// also allows administrators, but no operators.
std::string_view access_of(const http::Route& route, const Request& request) {
  const bool asks_more =
      !request.query().empty() && !route.query_access.empty() && !asks_for_revision_alone(request);
  return asks_more ? route.query_access : route.access;
}

bool is_write(http::Method method) {
  return method != http::Method::Get && method != http::Method::Head &&
         method != http::Method::Options;
}

/// `Authorization: Bearer fg_…` and `X-API-Key: fg_…`, which is for clients whose Authorization
/// belongs to another service. Empty if absent or of another scheme.
std::array<std::string_view, 2> tokens_of(const Request& request) {
  constexpr std::string_view kScheme = "bearer ";
  const std::string_view text = trim(request.header("Authorization").value_or(""));
  const bool is_bearer = ascii_iequals(text.substr(0, kScheme.size()), kScheme);
  return {is_bearer ? trim(text.substr(kScheme.size())) : std::string_view(),
          trim(request.header("X-API-Key").value_or(""))};
}

bool has_credentials(const Request& request) {
  return request.header("Authorization") || request.header("X-API-Key");
}

Error invalid_key() { return {ErrorCode::KeyInvalid, "the key is unknown or revoked"}; }

/// A page of another site whose name was made to resolve to this machine addresses it by that name,
/// and every write of a page has an Origin. An address is no such name, nor is one without a dot:
/// it is of this machine or its network. No name of the internet ends with a label of digits.
bool may_be_rebound(const Request& request) {
  if (is_write(request.method()) && !request.header("Origin")) return false;
  std::string_view host = request.header("Host").value_or("localhost");
  if (host.starts_with('[')) return false;
  host = host.substr(0, host.find(':'));
  if (host.ends_with('.')) host.remove_suffix(1);
  const std::size_t dot = host.rfind('.');
  if (dot == std::string_view::npos) return false;
  const std::string_view last = host.substr(dot + 1);
  return last.empty() || last.find_first_not_of("0123456789") != std::string_view::npos;
}

}  // namespace

/// nginx sends HTTP/1.0 with `Connection: close` by default: its clients would all seem local.
void Guard::warn_of_proxy(const Request& request) const {
  if (!request.is_http_1_0() || !proxy_seen_) return;
  const auto connection = request.header("Connection");
  if (!connection || !ascii_iequals(trim(*connection), "close")) return;
  if (may_be_rebound(request)) return;  // writes by that name need a key
  if (warned_->exchange(true)) return;
  proxy_seen_(
      "a request seems to come from a proxy (HTTP/1.0, Connection: close) and does not name its "
      "client: everybody who reaches that proxy may write. Start with --auth read-open, or set "
      "X-Forwarded-For in the proxy");
}

Result<std::optional<Response>> Guard::operator()(Request& request,
                                                  const http::Route& route) const {
  const auto origin = is_write(request.method()) ? request.header("Origin") : std::nullopt;
  const bool is_foreign = origin && !ascii_iequals(*origin, request.own_origin());
  if (is_foreign && request.allowed_origin().empty()) {
    return Error{ErrorCode::OriginRefused,
                 "a page of " + std::string(first_characters(*origin, 200)) +
                     " may not write here: if it is your origin, start with --allow-origin"};
  }

  const std::string_view access = access_of(route, request);
  if (access == "public") return std::optional<Response>();
  if (request.is_health_only())
    return Error{ErrorCode::Forbidden, "this port answers only /livez and /readyz"};
  const auto needed = [&] {
    return app::role_from_word(access).value_or(access == "open" ? app::Role::Viewer
                                                                 : app::Role::Admin);
  };
  if (closed_ && is_write(request.method()) && needed() != app::Role::Viewer) {
    if (auto why = closed_()) return *std::move(why);
  }
  std::optional<app::KnownCaller> caller;
  for (const std::string_view token : tokens_of(request)) {
    if (caller || token.empty()) continue;
    caller = keys_.find(token);
    // Other text belongs to a proxy or another service and is ignored.
    if (!caller && token.starts_with(kTokenPrefix)) return invalid_key();
  }
  if (caller && caller->is_expired)
    return Error{ErrorCode::KeyExpired, "the key " + caller->name + " has expired"};
  if (caller) request.set_caller(Caller{caller->name, caller->key});
  const bool is_open = mode_ != AuthMode::Keys && access == "open" && !is_foreign;
  if (mode_ == AuthMode::Open && !is_foreign && request.is_local() &&
      (is_open || !may_be_rebound(request))) {
    warn_of_proxy(request);
    return std::optional<Response>();
  }
  if (is_open) return std::optional<Response>();
  if (!caller) {
    if (has_credentials(request)) return invalid_key();
    return Error{ErrorCode::Unauthenticated,
                 "send a key: `Authorization: Bearer fg_…`; an administrator creates keys with "
                 "`fitgauged key create`"};
  }
  if (!app::may(caller->role, needed())) {
    return Error::of(ErrorCode::Forbidden, "the key {} has the role {}; this needs the role {}",
                     caller->name, app::word(caller->role), app::word(needed()));
  }
  return std::optional<Response>();
}

bool Guard::may_continue(const Request& request) const {
  const auto* const caller = request.caller<Caller>();
  return caller == nullptr || keys_.is_valid(caller->key);
}

}  // namespace fitgauge::api
