// Answers in gzip: who gets them, their tags, and that they unpack to the same bytes.

#include <doctest/doctest.h>

#include "base/gzip.hpp"
#include "http/field_list.hpp"
#include "http/response.hpp"
#include "support/comes_true.hpp"
#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

std::string text_of(std::size_t size) {
  std::string text;
  for (int i = 0; text.size() < size; ++i) text += fmt::format("{{\"row\":{}}},", i);
  text.resize(size);
  return text;
}

std::string unpacked(const std::string& bytes) {
  std::string text(8'000'000, '\0');
  Gunzip gunzip;
  const Gunzip::Step step = gunzip.put(bytes, text);
  CHECK_FALSE(step.failed);
  CHECK(gunzip.is_complete());
  text.resize(step.produced);
  return text;
}

/// `count` pieces of a text.
class Pieces final : public BodyStream {
 public:
  Pieces(std::string piece, int count) : piece_(std::move(piece)), left_(count) {}
  void next(ChunkSink sink) override { --left_ > 0 ? sink.put(piece_) : sink.finish(piece_); }

 private:
  const std::string piece_;
  int left_;
};

Response tagged(std::string type, std::string body) {
  Response response(200, std::move(type), std::move(body));
  response.etag = "\"t1\"";
  return response;
}

std::vector<Route> sized_routes() {
  const auto with_size = [](const Request& request) {
    return static_cast<std::size_t>(*request.integer("size"));
  };
  const std::vector<Parameter> size{{.name = "size",
                                     .place = ParameterPlace::Path,
                                     .type = Integer{.min = 0, .max = 10'000'000}}};
  const auto prepared = prepare(tagged("application/json", text_of(5000)));
  const auto long_one = prepare(tagged("application/json", text_of(500'000)));
  const auto short_one = prepare(tagged("application/json", text_of(100)));
  const auto page = prepare(tagged("text/plain", text_of(3000)), fitgauge::gzip(text_of(3000)));
  const auto give = [](std::shared_ptr<const PreparedResponse> answer) {
    return SyncHandler([answer](const Request&) { return Response(answer); });
  };
  return {
      {.pattern = "/json/{size}",
       .handler =
           [with_size](const Request& request) {
             return tagged("application/json", text_of(with_size(request))).with("Vary", "Accept");
           },
       .parameters = size,
       .response_types = {}},
      {.pattern = "/bytes/{size}",
       .handler =
           [with_size](const Request& request) {
             return tagged("application/octet-stream", text_of(with_size(request)));
           },
       .parameters = size,
       .response_types = {}},
      answering("/stream",
                [](const Request&) {
                  return Response(
                      200, "application/x-ndjson",
                      StreamedBody{.source = std::make_shared<Pieces>(text_of(50'000), 20)});
                }),
      answering("/events",
                [](const Request&) {
                  return Response(
                      200, "text/event-stream",
                      StreamedBody{.source = std::make_shared<Pieces>(text_of(5000), 2)});
                }),
      answering("/coded",
                [](const Request&) {
                  return Response(200, "application/json", fitgauge::gzip(text_of(5000)))
                      .with("Content-Encoding", "gzip");
                }),
      answering("/kept", give(prepared)),
      answering("/kept-long", give(long_one)),
      answering("/kept-short", give(short_one)),
      answering("/page", give(page))};
}

constexpr std::string_view kGzip = "Accept-Encoding: gzip, deflate, br\r\n";

}  // namespace

TEST_CASE("a coding is chosen by its weight") {
  const auto prefers = [](std::string_view value) {
    return accepted_codings(value).prefers_gzip();
  };
  for (const char* value : {"gzip", "GZIP", "x-gzip", "br, gzip;q=0.1", "*", "*;q=0.5",
                            "gzip, identity", "gzip;q=0.5, identity;q=0.5", "identity;q=0, gzip"}) {
    CAPTURE(value);
    CHECK(prefers(value));
  }
  for (const char* value : {"", "identity", "br, zstd", "gzip;q=0", "gzip;q=0, *", "*;q=0",
                            "gzip;q=0.5, identity", "gzip;q=0.5, *;q=0.6", "gzip;q=x", "gzipped"}) {
    CAPTURE(value);
    CHECK_FALSE(prefers(value));
  }
  CHECK(accepted_codings("identity;q=0").identity == 0);
  CHECK(accepted_codings("*;q=0").identity == 0);
  CHECK(accepted_codings("*;q=0, identity").identity > 0);
  CHECK(accepted_codings("br").identity > 0);
}

TEST_CASE("only types that gzip shortens are packed") {
  for (const char* type :
       {"application/json", "application/problem+json", "application/x-ndjson",
        "text/csv; charset=utf-8; header=present", "text/xml", "application/xml", "image/svg+xml",
        "text/html; charset=utf-8", "text/css", "text/javascript"}) {
    CHECK(is_packable(type));
  }
  for (const char* type :
       {"", "text/event-stream", "application/pdf", "application/octet-stream", "text/plain",
        "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"}) {
    CHECK_FALSE(is_packable(type));
  }
}

TEST_CASE("a body over 1 KiB goes out in gzip under a tag of its own") {
  TestServer server(sized_routes());
  Client client = server.connect();
  for (const int size : {1025, 60'000, 70'000, 3'000'000}) {
    CAPTURE(size);
    const std::string path = fmt::format("/json/{}", size);
    const auto plain = client.ask(get(path));
    const auto packed = client.ask(get(path, kGzip));
    CHECK(plain.field("Content-Encoding").empty());
    CHECK(plain.field("ETag") == "\"t1\"");
    CHECK(plain.field("Vary") == "Accept, Accept-Encoding");
    CHECK(packed.field("Content-Encoding") == "gzip");
    CHECK(packed.field("ETag") == "\"t1-gzip\"");
    CHECK(packed.field("Vary") == "Accept, Accept-Encoding");
    CHECK(packed.body.size() < plain.body.size() / 2);
    CHECK(unpacked(packed.body) == plain.body);
    for (const char* tag : {"\"t1\"", "\"t1-gzip\"", "W/\"t1-gzip\""}) {
      const std::string condition = fmt::format("If-None-Match: {}\r\n", tag);
      CHECK(client.ask(get(path, condition)).status == 304);
      const auto not_modified = client.ask(get(path, condition + std::string(kGzip)));
      CHECK(not_modified.status == 304);
      CHECK(not_modified.field("ETag") == "\"t1-gzip\"");
      CHECK(not_modified.field("Vary") == "Accept, Accept-Encoding");
    }
  }
  const auto head =
      client.ask(fmt::format("HEAD /json/5000 HTTP/1.1\r\nHost: h\r\n{}\r\n", kGzip), true);
  const auto whole = client.ask(get("/json/5000", kGzip));
  CHECK(head.field("Content-Length") == whole.field("Content-Length"));
  CHECK(head.field("Content-Encoding") == "gzip");
}

TEST_CASE("short, coded, foreign and unasked answers stay as they are") {
  TestServer server(sized_routes());
  Client client = server.connect();
  const auto is_plain = [&](std::string_view path, std::string_view fields) {
    const auto answer = client.ask(get(path, fields));
    return answer.status == 200 && answer.field("Content-Encoding").empty();
  };
  CHECK(is_plain("/json/1024", kGzip));
  CHECK(is_plain("/bytes/5000", kGzip));
  CHECK(is_plain("/events", kGzip));
  CHECK(is_plain("/kept-short", kGzip));
  CHECK(is_plain("/json/5000", ""));
  CHECK(is_plain("/json/5000", "Accept-Encoding: br\r\n"));
  CHECK(is_plain("/json/5000", "Accept-Encoding: gzip;q=0\r\n"));
  CHECK(is_plain("/json/5000", "Accept-Encoding: gzip;q=0.5, identity\r\n"));
  const auto coded = client.ask(get("/coded", kGzip));
  CHECK(unpacked(coded.body) == text_of(5000));
  CHECK(coded.field("Vary") == "Accept-Encoding");
  const Answer old = server.ask(fmt::format("GET /json/5000 HTTP/1.0\r\nHost: h\r\n{}\r\n", kGzip));
  CHECK(old.body == text_of(5000));
}

TEST_CASE("who refuses the plain form gets short answers in gzip too, who refuses both gets 406") {
  TestServer server(sized_routes());
  Client client = server.connect();
  for (const char* path : {"/json/100", "/kept-short"}) {
    const auto answer = client.ask(get(path, "Accept-Encoding: identity;q=0, gzip;q=0.2\r\n"));
    CHECK(answer.field("Content-Encoding") == "gzip");
    CHECK(unpacked(answer.body) == text_of(100));
  }
  CHECK(client.ask(get("/json/100", "Accept-Encoding: identity;q=0\r\n")).status == 406);
  CHECK(client.ask(get("/json/100", "Accept-Encoding: *;q=0\r\n")).status == 406);
}

TEST_CASE("a kept answer has both forms") {
  TestServer server(sized_routes());
  Client client = server.connect();
  for (const char* path : {"/kept", "/kept-long", "/page"}) {
    CAPTURE(path);
    const auto plain = client.ask(get(path));
    const auto packed = client.ask(get(path, kGzip));
    CHECK(plain.field("ETag") == "\"t1\"");
    CHECK(plain.field("Vary") == "Accept-Encoding");
    CHECK(packed.field("ETag") == "\"t1-gzip\"");
    CHECK(packed.field("Content-Encoding") == "gzip");
    CHECK(packed.field("Content-Length") == std::to_string(packed.body.size()));
    CHECK(unpacked(packed.body) == plain.body);
    CHECK(client.ask(get(path, kGzip)).body == packed.body);
    const auto not_modified = client.ask(get(path, "If-None-Match: \"t1-gzip\"\r\n"));
    CHECK(not_modified.status == 304);
    CHECK(not_modified.field("ETag") == "\"t1\"");
  }
}

TEST_CASE("a kept answer is the same whatever its request's id") {
  TestServer server(sized_routes());
  Client client = server.connect();
  const std::string as_own(16, 'a');
  for (const char* path : {"/kept", "/kept-long", "/kept-short", "/page"}) {
    CAPTURE(path);
    const auto of_id = [&](const std::string& id) {
      return client.ask(get(path, "X-Request-Id: " + id + "\r\n"));
    };
    const auto whole = of_id(as_own);
    const auto in_parts = of_id("b");
    CHECK(whole.body == in_parts.body);
    std::string head = whole.head;
    head.replace(head.find(as_own), as_own.size(), "b");
    // Between the two answers a second may end.
    head.replace(head.find(whole.field("Date")), whole.field("Date").size(),
                 in_parts.field("Date"));
    CHECK(head == in_parts.head);
  }
}

TEST_CASE("a streamed body is packed piece by piece") {
  TestServer server(sized_routes());
  Client client = server.connect();
  const auto plain = client.ask(get("/stream"));
  const auto packed = client.ask(get("/stream", kGzip));
  CHECK(packed.field("Content-Encoding") == "gzip");
  CHECK(packed.field("Transfer-Encoding") == "chunked");
  CHECK(packed.body.size() < plain.body.size() / 4);
  CHECK(unpacked(packed.body) == plain.body);
  CHECK(client.ask(get("/json/10")).body == text_of(10));
}

TEST_CASE("the body of a packed answer that nobody takes counts as unsent") {
  // The budget is of two bodies.
  TestServer server({answering("/noise",
                               [](const Request&) {
                                 std::string text(20'000'000, '\0');
                                 std::uint32_t state = 1;
                                 for (char& c : text) {
                                   state = state * 1664525 + 1013904223;
                                   c = static_cast<char>(' ' + (state >> 24) % 95);
                                 }
                                 return Response(200, "application/json", std::move(text));
                               })},
                    {.unsent_budget = 50'000'000, .unsent_time = std::chrono::milliseconds(0)});
  std::vector<Client> stuck = server.connect(6);
  for (Client& client : stuck) {
    client.send(get("/noise", kGzip));
    REQUIRE_FALSE(client.read_some().empty());
  }
  CHECK(comes_true([&] { return server.server().counters().connections_open == 2; }));
}
