#include <doctest/doctest.h>

#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

TEST_CASE("a GET is answered with Date, type and length, and the connection goes on") {
  TestServer server({echo(Method::Get, "/a")});
  Client client = server.connect();
  for (int i = 0; i < 3; ++i) {
    const auto answer = client.ask(get("/a"));
    REQUIRE(answer);
    CHECK(answer->status == 200);
    CHECK(answer->head.starts_with("HTTP/1.1 200 OK\r\n"));
    CHECK(answer->field("Content-Type") == "text/plain");
    CHECK(answer->field("Content-Length") == "5");
    CHECK(answer->field("Date").ends_with(" GMT"));
    CHECK(answer->field("Connection").empty());
    CHECK(answer->body == "fixed");
  }
}
