// What Beast's parser lets through or leaves to its user, each on the wire: the request is refused,
// the connection closed, and nothing behind it is taken for a request.

#include <doctest/doctest.h>

#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

std::vector<Route> trap_routes() {
  return {echo(Method::Get, "/a"), echo(Method::Post, "/p", {.use = BodyUse::Optional}),
          echo(Method::Get, "/smuggled")};
}

/// Sends `request` followed by a smuggled GET: exactly one answer comes, then the end.
void check_refused(std::string_view request, int status = 400,
                   std::string_view code = "request.malformed") {
  CAPTURE(request.substr(0, 200));
  TestServer server(trap_routes());
  Client client = server.connect();
  client.send(std::string(request) + get("/smuggled"));
  const auto answer = client.read();
  CHECK(answer.status == status);
  CHECK(answer.body.starts_with(code));
  CHECK(answer.field("Connection") == "close");
  client.shut_down_send();
  CHECK(client.read_to_end().empty());
  CHECK(server.ask(get("/a")).status == 200);  // a new connection works
}

}  // namespace

TEST_CASE("a Transfer-Encoding other than one chunked of HTTP/1.1 is refused") {
  for (const char* coding : {"pigeons", "xchunked", "chunked, identity", "gzip, chunked",
                             "identity", "chunked, chunked", "\"chunked\"", "chunked;a=b", ""}) {
    check_refused("POST /p HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: " + std::string(coding) +
                  "\r\n\r\n3\r\nabc\r\n0\r\n\r\n");
  }
  check_refused(
      "POST /p HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\nTransfer-Encoding: "
      "identity\r\n\r\n0\r\n\r\n");
  check_refused("POST /p HTTP/1.0\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n");
}

TEST_CASE("Transfer-Encoding together with Content-Length is refused in either order") {
  for (const char* coding : {"chunked", "pigeons"}) {
    const std::string te = "Transfer-Encoding: " + std::string(coding) + "\r\n";
    check_refused("POST /p HTTP/1.1\r\nHost: h\r\n" + te + "Content-Length: 5\r\n\r\n0\r\n\r\n");
    check_refused("POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: 5\r\n" + te + "\r\n0\r\n\r\n");
  }
}

TEST_CASE("a Content-Length that is not one number is refused") {
  for (const char* length : {"5, 5", "5,6", "+5", "-1", "0x5", "5 5", ""}) {
    check_refused("POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: " + std::string(length) +
                  "\r\n\r\nhello");
  }
  check_refused(
      "POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: 5\r\nContent-Length: 5\r\n\r\nhello");
}

TEST_CASE("a Content-Length of more than 64 bits announces too large a body") {
  const std::string endless = "Content-Length: 18446744073709551616\r\n";
  for (const std::string& field :
       {endless, "content-length:\t" + std::string(100, '9') + " \r\n"}) {
    check_refused("POST /p HTTP/1.1\r\nHost: h\r\n" + field + "\r\nhello", 413,
                  "request.body_too_large");
  }
  check_refused("POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: 5\r\n" + endless + "\r\nhello");
  check_refused("POST /p HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n" + endless + "\r\n");
}

TEST_CASE("a folded field is refused") {
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nX: one\r\n two\r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nX:\r\n\ttwo\r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nX: one\r\n \r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\n Host: h\r\n\r\n");
}

TEST_CASE("a line that ends with LF alone is refused at once") {
  check_refused("GET /a HTTP/1.1\nHost: h\n\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\nX: y\r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\n\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\r\n\r\n");
}

TEST_CASE("a missing, repeated or malformed Host is refused") {
  check_refused("GET /a HTTP/1.1\r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nHost: h\r\n\r\n");
  for (const char* host : {"", "a b", "user@h", "h:port", "h:123456", "h/x", "[::1", "[]", "a,b\\",
                           "h:80:80", "::1", "ho\"st"}) {
    check_refused("GET /a HTTP/1.1\r\nHost: " + std::string(host) + "\r\n\r\n");
  }
}

TEST_CASE("a Host of every valid form is taken") {
  TestServer server(trap_routes());
  for (const char* host :
       {"localhost", "localhost:8286", "10.0.0.1:80", "[::1]", "[::1]:8286", "a-b.example", "h:"}) {
    CAPTURE(host);
    CHECK(server.ask("GET /a HTTP/1.1\r\nHost: " + std::string(host) + "\r\n\r\n").status == 200);
  }
  CHECK(server.ask("GET /a HTTP/1.0\r\n\r\n").status == 200);
}

TEST_CASE("field names and values with forbidden characters are refused") {
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nX : y\r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nNo colon\r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\n: y\r\n\r\n");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nX: a" + std::string(1, '\0') + "b\r\n\r\n");
}

TEST_CASE("a request line of another form or version is refused") {
  check_refused("GET /a\r\n\r\n", 400, "request.");
  check_refused("GET  /a HTTP/1.1\r\nHost: h\r\n\r\n", 400, "request.");
  check_refused("GET /a HTTP/2.0\r\nHost: h\r\n\r\n", 400, "request.version_unsupported");
  check_refused("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 400, "request.version_unsupported");
  check_refused("\x16\x03\x01\x02", 400, "request.");
}

TEST_CASE("a target longer than 8 KiB is 414, one of 8 KiB is read") {
  check_refused("GET /" + std::string(8192, 'a') + " HTTP/1.1\r\nHost: h\r\n\r\n", 414,
                "request.target_too_long");
  check_refused("GET /" + std::string(100'000, 'a'), 414, "request.target_too_long");
  TestServer server(trap_routes());
  CHECK(server.ask(get("/a?" + std::string(8192 - 3, 'a'))).status == 200);
}

TEST_CASE("a header section over 32 KiB or 100 fields is 431") {
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nX: " + std::string(32'768, 'x') + "\r\n\r\n", 431,
                "request.header_too_large");
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\nX: " + std::string(100'000, 'x'), 431,
                "request.header_too_large");
  std::string many;
  for (int i = 0; i < 99; ++i) many += "X: y\r\n";
  check_refused("GET /a HTTP/1.1\r\nHost: h\r\n" + many + "X: y\r\n\r\n", 431,
                "request.header_too_large");
  TestServer server(trap_routes());
  CHECK(server.ask("GET /a HTTP/1.1\r\nHost: h\r\n" + many + "\r\n").status == 200);
  CHECK(server.ask(get("/a", "X: " + std::string(32 * 1024 - 64, 'x') + "\r\n")).status == 200);
}

TEST_CASE("a long head sent byte by byte and together with others is read as one") {
  TestServer server(trap_routes());
  Client client = server.connect();
  const std::string request = get("/a", "X: " + std::string(9000, 'x') + "\r\nY: z\r\n");
  client.send(get("/a") + request.substr(0, 3000));
  CHECK(client.read().status == 200);
  for (const char c : request.substr(3000)) client.send(std::string_view(&c, 1));
  CHECK(client.read().status == 200);
}

TEST_CASE("a chunk line or trailer over 16 KiB is refused") {
  check_refused(kChunkedPost + "5;" + std::string(20'000, 'x'));
  check_refused(kChunkedPost + "5;x=" + std::string(20'000, 'x') + "\r\nhello\r\n0\r\n\r\n");
  check_refused(kChunkedPost + "5\r\nhello\r\n0\r\nX: " + std::string(70'000, 'x') + "\r\n\r\n");
  check_refused(kChunkedPost + "5\r\nhello\r\n0\r\nX: " + std::string(20'000, 'x') + "\r\n\r\n");
  check_refused(kChunkedPost + "5\r\nhello\r\n0\r\nX: a\r\n b\r\n\r\n");
}

TEST_CASE("a chunked body that is malformed is refused") {
  check_refused(kChunkedPost + "x\r\nhello\r\n0\r\n\r\n");
  check_refused(kChunkedPost + "5\r\nhello!\r\n0\r\n\r\n");
  check_refused(kChunkedPost + "-5\r\nhello\r\n0\r\n\r\n");
  check_refused(kChunkedPost + "fffffffffffffffff\r\nhello", 413, "request.body_too_large");
  check_refused(kChunkedPost + "5\r\nhello\r\n0\r\nTransfer-Encoding: chunked\r\n\r\n");
  check_refused(kChunkedPost + "5\nhello\n0\r\n\r\n");
  check_refused(kChunkedPost + "5\nhello");
  check_refused(kChunkedPost + "5\r\nhello\r\n0\n\n");
}

TEST_CASE("empty lines before a request are skipped") {
  TestServer server(trap_routes());
  CHECK(server.ask("\r\n\r\n" + get("/a")).status == 200);
  Client client = server.connect();
  client.send("\r");
  client.send("\n" + get("/a"));
  CHECK(client.read().status == 200);
}

TEST_CASE("a request in absolute-form is served, its authority replaces the Host field") {
  std::string origin;
  std::vector<Route> table = trap_routes();
  table.push_back(answering("/origin", [&](const Request& request) -> Result<Response> {
    return Response(200, "text/plain", request.own_origin());
  }));
  TestServer server(std::move(table));
  CHECK(server.ask("GET http://Gauge:8286/origin?x HTTP/1.1\r\nHost: other\r\n\r\n").body ==
        "http://gauge:8286");
  CHECK(server.ask("GET http://gauge HTTP/1.1\r\nHost: other\r\n\r\n").status == 404);
  CHECK(server.ask("GET ftp://gauge/a HTTP/1.1\r\nHost: other\r\n\r\n").status == 400);
  CHECK(server.ask("GET a HTTP/1.1\r\nHost: other\r\n\r\n").status == 400);
  CHECK(server.ask("GET * HTTP/1.1\r\nHost: other\r\n\r\n").status == 400);
  CHECK(server.ask("GET /a#b HTTP/1.1\r\nHost: other\r\n\r\n").status == 400);
}

TEST_CASE("HTTP/1.0 closes unless it asks to keep the connection") {
  TestServer server(trap_routes());
  {
    Client client = server.connect();
    CHECK(client.ask("GET /a HTTP/1.0\r\n\r\n").field("Connection") == "close");
    CHECK(client.is_closed_by_server());
  }
  Client client = server.connect();
  for (int i = 0; i < 2; ++i) {
    const auto answer = client.ask("GET /a HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
    CHECK(answer.field("Connection") == "keep-alive");
  }
}

TEST_CASE("Connection: close is honoured and answered") {
  TestServer server(trap_routes());
  Client client = server.connect();
  client.send(get("/a", "Connection: close\r\n") + get("/a"));
  CHECK(client.read().field("Connection") == "close");
  CHECK(client.is_closed_by_server());
}
