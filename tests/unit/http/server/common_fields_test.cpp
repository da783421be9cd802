// The fields that every answer has, whatever made it: the request's id, what a browser may do with
// it, and CORS.

#include <doctest/doctest.h>

#include "http/response.hpp"
#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

class OnePiece final : public BodyStream {
 public:
  void next(ChunkSink sink) override { sink.finish("streamed"); }
};

std::vector<Route> routes_of_every_kind() {
  static const auto prepared = prepare([] {
    Response response(200, "text/plain", std::string("kept"));
    response.etag = "\"1\"";
    return response;
  }());
  return {answering("/kept", [](const Request&) { return Response(prepared); }),
          answering("/made", [](const Request&) { return plain("m"); }),
          answering("/late",
                    [](const Request&, Responder responder) { responder.answer(Response(204)); }),
          {.pattern = "/dropped", .handler = [](const Request&, Responder) {}},
          answering("/streamed",
                    [](const Request&) {
                      return Response(200, "text/plain",
                                      StreamedBody{.source = std::make_shared<OnePiece>()});
                    }),
          {.method = Method::Post,
           .pattern = "/made",
           .handler = [](const Request&) { return Response(201); },
           .body = {.use = BodyUse::Required, .media_types = {"text/plain"}}}};
}

/// Requests whose answers come from every place that makes one.
const std::vector<std::string> kRequests = {
    get("/kept"),
    get("/kept", "If-None-Match: \"1\"\r\n"),
    get("/made"),
    get("/late"),
    get("/dropped"),
    get("/streamed"),
    get("/missing"),
    get("/made?%zz"),
    "PUT /made HTTP/1.1\r\nHost: h\r\n\r\n",
    "OPTIONS /made HTTP/1.1\r\nHost: h\r\n\r\n",
    "OPTIONS * HTTP/1.1\r\nHost: h\r\n\r\n",
    post("/made", "a/b", "x"),
    "GET /made HTTP/1.1\r\nHost: h\r\nContent-Length: 1\r\nTransfer-Encoding: chunked\r\n\r\n",
    "BAD\r\n\r\n",
};

}  // namespace

TEST_CASE("every answer has an id of its own and tells browsers not to guess") {
  TestServer server(routes_of_every_kind());
  std::vector<std::string> ids;
  for (const std::string& request : kRequests) {
    CAPTURE(request);
    const Answer answer = server.ask(request);
    const std::string id = answer.field("X-Request-Id");
    CHECK(id.size() == 16);
    CHECK(std::find(ids.begin(), ids.end(), id) == ids.end());
    ids.push_back(id);
    CHECK(answer.field("X-Content-Type-Options") == "nosniff");
    CHECK(answer.field("Cross-Origin-Resource-Policy") == "same-origin");
    CHECK(answer.field("Vary").empty());
    CHECK(answer.field("Access-Control-Allow-Origin").empty());
  }
}

TEST_CASE("an id that the client gives is taken over, any other text is not") {
  ServerHooks hooks;
  std::string logged;
  hooks.finished = [&](const FinishedRequest& finished) { logged = finished.request.id_text(); };
  hooks.format_error = [](const Error&, std::optional<int> status, const Request& request) {
    return Response(*status, "text/plain", std::string(request.id_text()));
  };
  TestServer server(routes_of_every_kind(), {}, hooks);
  Client client = server.connect();
  const std::string longest(64, 'x');
  // 16 characters are as many as in an id of the service: such answers are kept whole.
  for (const std::string& id :
       {std::string("a"), std::string("MES-7_b.2"), std::string(16, 'y'), longest}) {
    for (const char* path : {"/kept", "/made", "/late", "/streamed", "/missing"}) {
      const auto answer = client.ask(get(path, "X-REQUEST-ID: " + id + "\r\n"));
      CHECK(answer.field("X-Request-Id") == id);
      CHECK(logged == id);
      if (answer.status == 404) CHECK(answer.body == id);
    }
  }
  for (const std::string& id : {std::string(), longest + "x", std::string("a b"),
                                std::string("a\"b"), std::string("\xc3\xa4"), std::string("a/b")}) {
    const auto answer = client.ask(get("/made", "X-Request-Id: " + id + "\r\n"));
    CHECK(answer.field("X-Request-Id").size() == 16);
    CHECK(answer.field("X-Request-Id") == logged);
  }
  CHECK(client.ask(get("/made")).field("X-Request-Id").size() == 16);
}

TEST_CASE("an allowed origin gets the fields of CORS, another one none") {
  ServerOptions options;
  options.allowed_origins = {"https://mes.example", "http://10.0.0.7:8080"};
  TestServer server(routes_of_every_kind(), options);
  for (const std::string& origin : options.allowed_origins) {
    for (const char* path : {"/kept", "/made", "/late", "/streamed", "/missing"}) {
      const Answer answer = server.ask(get(path, "Origin: " + origin + "\r\n"));
      CHECK(answer.field("Access-Control-Allow-Origin") == origin);
      CHECK(answer.field("Access-Control-Expose-Headers") ==
            "Location, Link, ETag, Retry-After, X-Request-Id, Idempotency-Replayed");
      CHECK(answer.field("Cross-Origin-Resource-Policy") == "cross-origin");
      CHECK(answer.field("Access-Control-Allow-Credentials").empty());
      CHECK(answer.field("Vary") == "Origin");
    }
  }
  const Answer not_modified =
      server.ask(get("/kept", "Origin: https://mes.example\r\nIf-None-Match: \"1\"\r\n"));
  CHECK(not_modified.status == 304);
  CHECK(not_modified.field("Access-Control-Allow-Origin") == "https://mes.example");
  for (const char* field :
       {"", "Origin: https://other.example\r\n", "Origin: https://mes.example.evil\r\n",
        "Origin: HTTPS://MES.EXAMPLE\r\n", "Origin: null\r\n", "Origin: https://mes.example/\r\n",
        "Origin: https://mes.example\r\nOrigin: https://other.example\r\n"}) {
    CAPTURE(field);
    const Answer answer = server.ask(get("/kept", field));
    CHECK(answer.field("Access-Control-Allow-Origin").empty());
    CHECK(answer.field("Cross-Origin-Resource-Policy") == "same-origin");
    CHECK(answer.field("Vary") == "Origin");
  }
}

TEST_CASE("a preflight of an allowed origin is answered without the guard") {
  ServerHooks hooks;
  hooks.guard = [](Request&, const Route&) -> Result<std::optional<Response>> {
    return Error{ErrorCode::Unauthenticated, "no key"};
  };
  TestServer server(routes_of_every_kind(), {.allowed_origins = {"https://mes.example"}}, hooks);
  const auto preflight = [&](std::string_view fields) {
    return server.ask("OPTIONS /made HTTP/1.1\r\nHost: h\r\n" + std::string(fields) + "\r\n");
  };
  const Answer allowed = preflight(
      "Origin: https://mes.example\r\nAccess-Control-Request-Method: POST\r\n"
      "Access-Control-Request-Headers: authorization,content-type\r\n");
  CHECK(allowed.status == 204);
  CHECK(allowed.field("Access-Control-Allow-Origin") == "https://mes.example");
  CHECK(allowed.field("Access-Control-Allow-Methods") == "GET, HEAD, POST, OPTIONS");
  CHECK(allowed.field("Access-Control-Allow-Headers") ==
        "Authorization, Content-Type, Idempotency-Key, If-Match, If-None-Match, Last-Event-ID, "
        "Prefer, X-API-Key, X-Request-Id");
  CHECK(allowed.field("Access-Control-Max-Age") == "600");
  CHECK(allowed.field("Vary") == "Origin");
  const Answer foreign =
      preflight("Origin: https://other.example\r\nAccess-Control-Request-Method: POST\r\n");
  CHECK(foreign.status == 204);
  CHECK(foreign.field("Access-Control-Allow-Methods").empty());
  CHECK(foreign.field("Access-Control-Allow-Origin").empty());
  const Answer no_method = preflight("Origin: https://mes.example\r\n");
  CHECK(no_method.status == 204);
  CHECK(no_method.field("Access-Control-Allow-Methods").empty());
}
