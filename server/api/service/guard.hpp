#pragma once

#include <optional>

#include "api/service/caller.hpp"
#include "app/service/key_service.hpp"
#include "http/server.hpp"

namespace fitgauge::api {

/// Who needs a key (`--auth`).
enum class AuthMode {
  Open,      ///< nobody on this machine; others as ReadOpen
  ReadOpen,  ///< everybody but for limits, fits, tables, verdicts, documents and the page
  Keys,      ///< everybody, but for the health checks
};

/// Decides on the head of a request whether it may go on: 401 without a key that is needed, 403
/// with one that is not enough or for a write that another site's page sent.
class Guard {
 public:
  Guard(const app::KeyService& keys, AuthMode mode) : keys_(keys), mode_(mode) {}

  /// The hook of http::ServerHooks; sets the request's caller.
  Result<std::optional<http::Response>> operator()(http::Request& request,
                                                   const http::Route& route) const;

 private:
  const app::KeyService& keys_;
  AuthMode mode_;
};

}  // namespace fitgauge::api
