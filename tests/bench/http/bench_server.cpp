// The HTTP engine with one cached answer, to be measured without the daemon around it:
// http_bench_server PORT [I/O threads]; port 0 takes a free one. It prints the port and runs until
// its standard input ends.

#include <fmt/core.h>

#include <cstdio>

#include "http/server.hpp"

namespace {

using namespace fitgauge;
using namespace fitgauge::http;

RouteTable routes() {
  Response answer(200, "application/json",
                  std::string(R"({"designation":"25 H7","nominal_mm":25,"tolerance_class":"H7",)"
                              R"("feature":"hole","upper_deviation_um":21,"lower_deviation_um":0,)"
                              R"("upper_limit_mm":25.021,"lower_limit_mm":25,"tolerance_um":21,)"
                              R"("size_range_mm":{"over":18,"up_to":30},"basis":"iso286",)"
                              R"("table_revision":"1"})"
                              "\n"));
  answer.etag = "\"1\"";
  auto limits = [prepared = prepare(answer)](const Request& request) -> Result<Response> {
    if (*request.text("designation") != "25H7") return Error{ErrorCode::NotFound, "Only 25H7."};
    return prepared;
  };
  auto echo = [](const Request& request) -> Result<Response> {
    return Response(200, "text/plain", std::to_string(request.body().size()));
  };
  std::vector<Route> table;
  table.push_back({.pattern = "/v1/limits/{designation}", .handler = std::move(limits)});
  table.push_back({.method = Method::Post,
                   .pattern = "/v1/size",
                   .handler = std::move(echo),
                   .body = {.use = BodyUse::Optional, .limit = std::size_t{32} << 20}});
  return RouteTable(std::move(table));
}

}  // namespace

int main(int argc, char** argv) {
  ServerOptions options;
  const int port = argc > 1 ? std::atoi(argv[1]) : 0;
  options.listen = {{.host = "127.0.0.1", .port = static_cast<std::uint16_t>(port)}};
  options.io_threads = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const auto server = Server::start(std::move(options), routes(), {});
  if (!server) {
    fmt::print(stderr, "{}\n", server.error().message);
    return 1;
  }
  fmt::print("{}\n", (*server)->ports().front());
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
  return 0;
}
