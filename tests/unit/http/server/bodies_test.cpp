#include <doctest/doctest.h>

#include "base/gzip.hpp"
#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

constexpr std::size_t kLimit = 100'000;

std::vector<Route> body_routes() {
  const BodyRules json{
      .use = BodyUse::Required, .media_types = {"application/json"}, .limit = kLimit};
  return {echo(Method::Post, "/json", json),
          echo(Method::Put, "/any", {.use = BodyUse::Optional, .limit = kLimit}),
          echo(Method::Post, "/optional",
               {.use = BodyUse::Optional, .media_types = {"application/json"}, .limit = kLimit}),
          echo(Method::Get, "/none", {.limit = kLimit})};
}

std::string chunked(std::string_view target, std::string_view chunks,
                    std::string_view fields = "") {
  return fmt::format(
      "POST {} HTTP/1.1\r\nHost: h\r\nContent-Type: application/json\r\nTransfer-Encoding: "
      "chunked\r\n{}\r\n{}",
      target, fields, chunks);
}

}  // namespace

TEST_CASE("a body arrives whole, however it is cut") {
  TestServer server(body_routes());
  for (const std::size_t size : {1U, 100U, 4096U, 20'000U, 100'000U}) {
    std::string body(size, 'x');
    for (std::size_t i = 0; i < size; ++i) body[i] = static_cast<char>('a' + i % 26);
    Client client = server.connect();
    const std::string request = post("/json", "application/json", body);
    CHECK(client.ask(request).body == body);  // at once
    const std::size_t cut = request.size() - size / 2;
    client.send(request.substr(0, cut));  // in two parts, with a request behind it
    client.send(request.substr(cut) + get("/none"));
    CHECK(client.read().body == body);
    CHECK(client.read().body == "fixed");
  }
}

TEST_CASE("a chunked body arrives whole, with extensions and trailers skipped") {
  TestServer server(body_routes());
  Client client = server.connect();
  CHECK(client.ask(chunked("/json", "5\r\nhello\r\n6;a=b;c=\"d\"\r\n world\r\n0\r\n\r\n")).body ==
        "hello world");
  CHECK(client.ask(chunked("/json", "5\r\nhello\r\n0\r\nX-Sum: 1\r\nHost: other\r\n\r\n")).body ==
        "hello");
  CHECK(client.ask(chunked("/json", "0\r\n\r\n")).body == "fixed");
  std::string expected;
  std::string chunks;
  for (int i = 0; i < 3000; ++i) {
    const std::string piece = std::to_string(i) + ",";
    expected += piece;
    chunks += chunk(piece);
  }
  CHECK(client.ask(chunked("/json", chunks + "0\r\n\r\n")).body == expected);
  const std::string big(kLimit, 'y');
  CHECK(client.ask(chunked("/json", chunk(big) + "0\r\n\r\n") + get("/none")).body == big);
  CHECK(client.read().body == "fixed");
  const std::string slow = chunked("/json", chunk("drip") + "0\r\n\r\n");
  for (const char c : slow) client.send(std::string_view(&c, 1));
  CHECK(client.read().body == "drip");
}

TEST_CASE("a required body without a length is 411") {
  TestServer server(body_routes());
  const Answer answer =
      server.ask("POST /json HTTP/1.1\r\nHost: h\r\nContent-Type: application/json\r\n\r\n");
  CHECK(answer.status == 411);
  CHECK(answer.body.starts_with("request.length_required"));
  CHECK(server.ask("PUT /any HTTP/1.1\r\nHost: h\r\n\r\n").status == 200);
  CHECK(server.ask(post("/json", "application/json", "")).status == 200);  // empty, but there
}

TEST_CASE("a media type that the route does not take is 415") {
  TestServer server(body_routes());
  const auto status = [&](std::string_view type) {
    return server.ask(post("/json", type, "{}")).status;
  };
  CHECK(status("application/json") == 200);
  CHECK(status("APPLICATION/JSON; Charset=\"UTF-8\"") == 200);
  CHECK(status("application/json;charset=utf-8;x=y") == 200);
  CHECK(status("application/json; charset=latin1") == 415);
  CHECK(status("text/plain") == 415);
  CHECK(status("application") == 415);
  CHECK(status("application/json; charset") == 415);
  CHECK(status("") == 415);
  const Answer missing =
      server.ask("POST /json HTTP/1.1\r\nHost: h\r\nContent-Length: 2\r\n\r\n{}");
  CHECK(missing.status == 415);
  CHECK(missing.body.starts_with("media_type.unsupported"));
  CHECK(server.ask("POST /optional HTTP/1.1\r\nHost: h\r\n\r\n").status == 200);
  CHECK(server.ask(post("/optional", "text/plain", "x")).status == 415);
  CHECK(server.ask("PUT /any HTTP/1.1\r\nHost: h\r\nContent-Length: 1\r\n\r\nx").status == 200);
}

TEST_CASE("the next request works after a refusal whose body was there already") {
  TestServer server(body_routes());
  Client client = server.connect();
  CHECK(client.ask(post("/json", "text/plain", "some text") + get("/none")).status == 415);
  CHECK(client.read().status == 200);
  CHECK(client.ask(post("/nowhere", "text/plain", "some text")).status == 404);
  CHECK(client.ask(get("/none")).status == 200);
}

TEST_CASE("a body over the limit is 413 at the header when its length says so") {
  TestServer server(body_routes());
  Client client = server.connect();
  client.send(
      "POST /json HTTP/1.1\r\nHost: h\r\nContent-Type: application/json\r\nContent-Length: "
      "100001\r\n\r\n");
  const auto answer = client.read();
  CHECK(answer.status == 413);
  CHECK(answer.body.starts_with("request.body_too_large"));
  CHECK(answer.field("Connection") == "close");
}

TEST_CASE("a refused body that is still being sent does not cost the client its answer") {
  TestServer server(body_routes());
  Client client = server.connect();
  client.send(post("/json", "application/json", std::string(900'000, 'x')));
  const auto answer = client.read();
  CHECK(answer.status == 413);
}

TEST_CASE("a chunked body over the limit is 413") {
  TestServer server(body_routes());
  CHECK(server.ask(chunked("/json", chunk(std::string(kLimit + 1, 'x')))).status == 413);
  CHECK(server.ask(chunked("/none", "", "")).status == 405);
}

TEST_CASE("a chunk that announces more than the limit is 413 before its bytes come") {
  TestServer server(body_routes());
  const auto status_of = [&](std::string_view chunks) {
    Client client = server.connect();
    client.send(chunked("/json", chunks));
    return client.read().status;
  };
  // The limit is 100,000: 186a0.
  for (const char* size : {"186a1", "000186A1", "7fffffff", "80000000", "ffffffff", "100000000",
                           "7fffffffffffffff", "8000000000000000", "ffffffffffffffff",
                           "10000000000000000", "ffffffffffffffffffffffff", "186a1;name=value"}) {
    CAPTURE(size);
    CHECK(status_of(std::string(size) + "\r\n") == 413);
    CHECK(status_of("5\r\nhello\r\n" + std::string(size) + "\r\n") == 413);
  }
  CHECK(status_of("5\r\nhello\r\n1869c\r\n") == 413);  // together one too many
  CHECK(status_of("g\r\n") == 400);
  CHECK(status_of(fmt::format("186a0\r\n{}\r\n0\r\n\r\n", std::string(kLimit, 'x'))) == 200);
  Client client = server.connect();
  client.send("GET /none HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n186a1\r\n");
  CHECK(client.read().status == 413);
}

TEST_CASE("a body that the route has no use for is read and thrown away") {
  TestServer server(body_routes());
  Client client = server.connect();
  client.send("GET /none HTTP/1.1\r\nHost: h\r\nContent-Length: 50000\r\n\r\n");
  client.send(std::string(50'000, 'x') + get("/none"));
  CHECK(client.read().body == "fixed");
  CHECK(client.read().body == "fixed");
  CHECK(client.ask("GET /none HTTP/1.1\r\nHost: h\r\nContent-Length: 100001\r\n\r\n").status ==
        413);
}

TEST_CASE("gzip bodies are read, the limit counts what comes out") {
  TestServer server(body_routes());
  const auto ask = [&](std::string_view body) {
    return server.ask(post("/json", "application/json", body, "Content-Encoding: gzip\r\n"));
  };
  std::string text;
  for (int i = 0; i < 9000; ++i) text += std::to_string(i * 7919) + ",";
  text.resize(60'000);
  CHECK(ask(gzip(text)).body == text);
  CHECK(ask(gzip("a")).body == "a");
  CHECK(ask(gzip("")).body == "fixed");
  CHECK(ask(gzip("one ") + gzip("two")).body == "one two");  // members
  CHECK(ask(gzip(std::string(kLimit, 'z'))).body == std::string(kLimit, 'z'));
  CHECK(ask(gzip(std::string(kLimit + 1, 'z'))).status == 413);
  std::string zeros;
  zeros.resize(20'000'000);
  CHECK(ask(gzip(zeros)).status == 413);  // a bomb of 87 kB
  const std::string whole = gzip(text);
  CHECK(ask(whole.substr(0, whole.size() - 1)).status == 400);
  CHECK(ask("not gzip").status == 400);
  CHECK(ask(whole + "x").status == 400);
  const std::string packed = gzip(text);
  CHECK(server
            .ask(chunked("/json",
                         chunk(packed.substr(0, 100)) + chunk(packed.substr(100)) + "0\r\n\r\n",
                         "Content-Encoding: x-gzip\r\n"))
            .body == text);
}

TEST_CASE("another content coding is 415 and names the one that is read") {
  TestServer server(body_routes());
  for (const char* coding : {"br", "deflate", "gzip, gzip", "gzip, identity"}) {
    const Answer answer = server.ask(
        post("/json", "application/json", "{}", fmt::format("Content-Encoding: {}\r\n", coding)));
    CHECK(answer.status == 415);
    CHECK(answer.body.starts_with("request.encoding_unsupported"));
    CHECK(answer.field("Accept-Encoding") == "gzip");
  }
  // An empty list names no coding.
  for (const char* coding : {"identity", "", ",", "identity ,"}) {
    CAPTURE(coding);
    CHECK(server
              .ask(post("/json", "application/json", "{}",
                        fmt::format("Content-Encoding: {}\r\n", coding)))
              .body == "{}");
  }
}

TEST_CASE("100 (Continue) comes after the checks and before the body") {
  TestServer server(body_routes());
  const auto head = [](std::string_view type, std::string_view expect) {
    return fmt::format(
        "POST /json HTTP/1.1\r\nHost: h\r\nContent-Type: {}\r\nContent-Length: 5\r\nExpect: "
        "{}\r\n\r\n",
        type, expect);
  };
  {
    Client client = server.connect();
    CHECK(client.ask(head("application/json", "100-Continue")).status == 100);
    CHECK(client.ask("hello").body == "hello");
    // A body that is there already needs no permission.
    CHECK(client.ask(head("application/json", "100-continue") + "hello").status == 200);
  }
  {
    Client client = server.connect();
    CHECK(client.ask(head("text/plain", "100-continue")).status == 415);
    CHECK(client.is_closed_by_server());
  }
  CHECK(server.ask(head("application/json", "") + "hello").status == 200);
  CHECK(server.ask(head("application/json", "100-continue, 200-ok")).status == 417);
  const Answer other = server.ask(head("application/json", "200-ok"));
  CHECK(other.status == 417);
  CHECK(other.body.starts_with("request.expectation_failed"));
}

TEST_CASE("bytes behind the body may be read") {
  TestServer server({{.method = Method::Post,
                      .pattern = "/sum",
                      .handler = [](const Request& request) -> Result<Response> {
                        const char* const end = request.body().data() + request.body().size();
                        unsigned sum = 0;
                        for (std::size_t i = 0; i < Request::kBodyPadding; ++i) {
                          sum += static_cast<unsigned char>(end[i]);
                        }
                        return Response(sum < 1'000'000 ? 200 : 500);
                      },
                      .body = {.use = BodyUse::Optional}}});
  Client client = server.connect();
  for (const std::size_t size : {0U, 10U, 3900U, 5000U, 50'000U}) {
    CHECK(client.ask(post("/sum", "text/plain", std::string(size, 'x'))).status == 200);
  }
}
