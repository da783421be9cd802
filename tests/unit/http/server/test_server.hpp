#pragma once

#include "http/server.hpp"
#include "test_client.hpp"

namespace fitgauge::http::test {

/// A server on a free loopback port with the routes of a test.
class TestServer {
 public:
  explicit TestServer(std::vector<Route> routes, ServerOptions options = {},
                      ServerHooks hooks = {});

  std::uint16_t port() const { return server_->ports().front(); }
  Client connect() const { return Client(port()); }
  Server& server() { return *server_; }

  /// One request on a connection of its own.
  Answer ask(std::string_view request, bool head_only = false) const;

 private:
  std::unique_ptr<Server> server_;
};

/// A GET route whose answers may be of any type.
inline Route answering(std::string pattern, Handler handler) {
  return {.pattern = std::move(pattern), .handler = std::move(handler), .response_types = {}};
}

/// A route that answers its body, or `fixed` when it has none.
Route echo(Method method, std::string pattern, BodyRules body = {});

/// `GET target HTTP/1.1` with a Host.
std::string get(std::string_view target, std::string_view more_fields = "");

/// A POST of `body` with Content-Length and the given Content-Type.
std::string post(std::string_view target, std::string_view type, std::string_view body,
                 std::string_view more_fields = "");

}  // namespace fitgauge::http::test
