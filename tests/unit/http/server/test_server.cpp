#include "test_server.hpp"

namespace fitgauge::http::test {

TestServer::TestServer(std::vector<Route> routes, ServerOptions options, ServerHooks hooks) {
  if (options.listen.empty()) options.listen = {{.host = "127.0.0.1", .port = 0}};
  auto started = Server::start(std::move(options), RouteTable(std::move(routes)), std::move(hooks));
  if (!started) throw std::runtime_error(started.error().message);
  server_ = std::move(*started);
}

Route echo(Method method, std::string pattern, BodyRules body) {
  return {.method = method,
          .pattern = std::move(pattern),
          .handler = [](const Request& request) -> Result<Response> {
            const std::string_view body_text = request.body();
            return Response(200, "text/plain",
                            body_text.empty() ? std::string("fixed") : std::string(body_text));
          },
          .body = std::move(body),
          .response_types = {"text/plain"}};
}

std::string get(std::string_view target, std::string_view more_fields) {
  return fmt::format("GET {} HTTP/1.1\r\nHost: test\r\n{}\r\n", target, more_fields);
}

std::string chunk(std::string_view bytes) {
  return fmt::format("{:X}\r\n{}\r\n", bytes.size(), bytes);
}

std::string post(std::string_view target, std::string_view type, std::string_view body,
                 std::string_view more_fields) {
  return fmt::format(
      "POST {} HTTP/1.1\r\nHost: test\r\nContent-Type: {}\r\nContent-Length: {}\r\n{}\r\n{}",
      target, type, body.size(), more_fields, body);
}

}  // namespace fitgauge::http::test
