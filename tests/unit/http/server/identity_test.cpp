#include <doctest/doctest.h>

#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

/// Answers its own identity in hexadecimal.
Route identified(std::string pattern, std::vector<Parameter> parameters) {
  Route route;
  route.pattern = std::move(pattern);
  route.handler = SyncHandler([](const Request& request) -> Result<Response> {
    std::string identity;
    request.append_identity(identity);
    std::string digits;
    for (const char c : identity) digits += std::to_string(static_cast<unsigned char>(c)) + ' ';
    return Response(200, "text/plain", digits);
  });
  route.parameters = std::move(parameters);
  route.response_types = {"application/json", "text/csv"};
  return route;
}

}  // namespace

TEST_CASE("what an answer depends on is one thing, however it is spelt") {
  TestServer server(
      {identified("/t/{name}", {}), identified("/l", {{.name = "mm", .type = LengthIn{}},
                                                      {.name = "n", .type = Integer{}},
                                                      {.name = "a"},
                                                      {.name = "b"}})});
  const auto identity = [&](std::string_view target, std::string_view fields = "") {
    const Answer answer = server.ask(get(target, fields));
    CHECK(answer.status == 200);
    return answer.body;
  };
  const std::string shaft = identity("/t/shaft");
  for (const char* same : {"/t/shaft?", "/t/shaft?&&", "/t/s%68aft", "/t/shaft?whatever=1"}) {
    CHECK(identity(same) == shaft);
  }
  CHECK(identity("/t/hole") != shaft);
  CHECK(identity("/t/shaft", "Accept: text/csv\r\n") != shaft);

  const std::string both = identity("/l?mm=25&n=7");
  for (const char* same : {"/l?n=7&mm=25", "/l?mm=25.000&n=7", "/l?mm=25%2C0&n=7&"}) {
    CHECK(identity(same) == both);
  }
  CHECK(identity("/l?mm=25") != both);
  CHECK(identity("/l?mm=25&n=8") != both);
  // One text does not run into the next.
  CHECK(identity("/l?a=xy&b=z") != identity("/l?a=x&b=yz"));
  CHECK(identity("/l?a=x") != identity("/l?b=x"));
  CHECK(identity("/l?a=") != identity("/l"));
}
