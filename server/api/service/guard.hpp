#pragma once

#include "api/wire/request_facts.hpp"
#include "http/server.hpp"
#include "service/documents/key_service.hpp"

namespace fitgauge::api {

/// Requests that need a key (`--auth`).
enum class AuthMode {
  Open,      ///< nobody on this machine; others as ReadOpen
  ReadOpen,  ///< everybody but for limits, fits of the tables, tables, verdicts, documents, the
             ///< page
  Keys,      ///< everybody, but for the health checks
};

/// Checks the head of a request: 401 without a required key, 403 with an insufficient one or for a
/// write that another site's page sent. Pages of an allowed origin write with a key, in each mode.
class Guard {
 public:
  /// @param proxy_seen called once for a proxy that hides its clients and so opens the service to
  /// all of them.
  /// @param closed reason why nothing can be stored now, if any: refuses every write of data.
  Guard(const app::KeyService& keys, AuthMode mode,
        std::function<void(std::string_view)> proxy_seen = {},
        std::function<std::optional<Error>()> closed = {})
      : keys_(keys), mode_(mode), proxy_seen_(std::move(proxy_seen)), closed_(std::move(closed)) {}

  /// The hook of http::ServerHooks; sets the request's caller.
  Result<std::optional<Response>> operator()(Request& request, const http::Route& route) const;
  /// Whether the key that began a streamed body is still valid.
  bool may_continue(const Request& request) const;

 private:
  void warn_of_proxy(const Request& request) const;

  const app::KeyService& keys_;
  AuthMode mode_;
  std::function<void(std::string_view)> proxy_seen_;
  std::function<std::optional<Error>()> closed_;
  std::shared_ptr<std::atomic<bool>> warned_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace fitgauge::api
