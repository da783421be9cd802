#pragma once

#include "http/response.hpp"
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
  std::vector<Client> connect(std::size_t count) const {
    std::vector<Client> clients;
    while (clients.size() < count) clients.push_back(connect());
    return clients;
  }
  Server& server() { return *server_; }

  /// One request on a connection of its own.
  Answer ask(std::string_view request) const { return connect().ask(request); }

 private:
  std::unique_ptr<Server> server_;
};

/// A GET route whose answers may be of any type.
inline Route answering(std::string pattern, Handler handler) {
  return {.pattern = std::move(pattern), .handler = std::move(handler), .response_types = {}};
}

/// 200 with a text.
inline Response plain(std::string body) { return {200, "text/plain", std::move(body)}; }

/// A route that answers its body, or `fixed` when it has none.
Route echo(Method method, std::string pattern, BodyRules body = {});

/// `GET target HTTP/1.1` with a Host.
std::string get(std::string_view target, std::string_view more_fields = "");

/// The head of a POST to /p whose body comes in chunks, a chunk of it, and its end.
inline const std::string kChunkedPost =
    "POST /p HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n";
std::string chunk(std::string_view bytes);
inline const std::string kLastChunk = "0\r\n\r\n";

/// A POST of `body` with Content-Length and the given Content-Type.
std::string post(std::string_view target, std::string_view type, std::string_view body,
                 std::string_view more_fields = "");

}  // namespace fitgauge::http::test
