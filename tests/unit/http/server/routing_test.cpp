#include "test_server.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {
/// A route that answers its pattern and its text arguments.
Route show(Method method, const std::string& pattern, std::vector<Parameter> parameters = {}) {
  return {.method = method,
          .pattern = pattern,
          .handler = [pattern](const Request& request) -> Result<Response> {
            std::string text = pattern;
            for (const Parameter& parameter : request.route()->parameters) {
              if (!std::holds_alternative<Text>(parameter.type)) continue;
              const auto value = request.text(parameter.name);
              text += " " + parameter.name + "=" + (value ? std::string(*value) : "(none)");
            }
            return Response(200, "text/plain", text);
          },
          .parameters = std::move(parameters),
          .response_types = {"text/plain", "text/csv"}};
}

std::vector<Route> routes() {
  return {show(Method::Get, "/"),
          show(Method::Get, "/v1/limits/{designation}"),
          show(Method::Get, "/v1/fits/{hole}/{shaft}"),
          show(Method::Get, "/v1/tables/hole"),
          show(Method::Put, "/v1/tables/{feature}/classes/{name}"),
          show(Method::Delete, "/v1/tables/{feature}/classes/{name}"),
          show(Method::Get, "/v1/files"),
          show(Method::Get, "/v1/files/{path*}"),
          show(Method::Put, "/v1/files/{path*}")};
}

}  // namespace

TEST_CASE("a path finds its route and its decoded segments") {
  TestServer server(routes());
  const auto body = [&](std::string_view path) { return server.ask(get(path)).body; };
  CHECK(body("/") == "/");
  CHECK(body("/v1/limits/25H7") == "/v1/limits/{designation} designation=25H7");
  CHECK(body("/v1/limits/25%20H7") == "/v1/limits/{designation} designation=25 H7");
  CHECK(body("/v1/limits/%C3%9825H7") == "/v1/limits/{designation} designation=Ø25H7");
  CHECK(body("/v1/limits/\xC3\x98"
             "25H7") == "/v1/limits/{designation} designation=Ø25H7");
  CHECK(body("/v1/limits/25+H7") == "/v1/limits/{designation} designation=25+H7");
  CHECK(body("/v1/limits/a%2Fb") == "/v1/limits/{designation} designation=a/b");
  CHECK(body("/v1/limi%74s/25H7") == "/v1/limits/{designation} designation=25H7");
  CHECK(body("/v1/limits/25H7?whatever=%zz&a&a") == "/v1/limits/{designation} designation=25H7");
  CHECK(body("/v1/fits/25H7/g6") == "/v1/fits/{hole}/{shaft} hole=25H7 shaft=g6");
  CHECK(body("/v1/files/nc_prog/8255/8255.h") == "/v1/files/{path*} path=nc_prog/8255/8255.h");
  CHECK(body("/v1/files/a%20b/c%25d") == "/v1/files/{path*} path=a b/c%d");
  CHECK(body("/v1/files/a%2Fb/c%2fd") == "/v1/files/{path*} path=a/b/c/d");
  CHECK(body("/v1/files/1/2/3/4/5/6/7/8/9/10/11/12/13/14/15/16/17/18") ==
        "/v1/files/{path*} path=1/2/3/4/5/6/7/8/9/10/11/12/13/14/15/16/17/18");
}

TEST_CASE("a path that names nothing is 404") {
  TestServer server(routes());
  for (const char* path :
       {"/v1", "/v1/", "/v1/limits", "/v1/limits/", "/v1/limits/25H7/", "//", "/v1/limits/25H7/x",
        "/V1/files", "/v1/fits/25H7", "/v1/files/", "/v1/tables/hole/classes",
        "/1/2/3/4/5/6/7/8/9/10/11/12/13/14/15/16/17"}) {
    CAPTURE(path);
    const Answer answer = server.ask(get(path));
    CHECK(answer.status == 404);
    CHECK(answer.body.starts_with("resource.not_found"));
  }
}

TEST_CASE("a path that cannot be decoded is 400") {
  TestServer server(routes());
  for (const char* path : {"/v1/limits/%", "/v1/limits/%4", "/v1/limits/%zz", "/v1/limits/%ff",
                           "/v1/limits/%00", "/v1/limits/\xff", "/v1/limits/%ED%A0%80"}) {
    CAPTURE(path);
    const Answer answer = server.ask(get(path));
    CHECK(answer.status == 400);
    CHECK(answer.body.starts_with("path.malformed"));
  }
}

TEST_CASE("a literal segment goes before a parameter, and the search backs up") {
  TestServer server(routes());
  CHECK(server.ask(get("/v1/tables/hole")).body == "/v1/tables/hole");
  CHECK(server.ask("PUT /v1/tables/hole/classes/H7 HTTP/1.1\r\nHost: h\r\n\r\n").body ==
        "/v1/tables/{feature}/classes/{name} feature=hole name=H7");
}

TEST_CASE("another method is 405 with Allow, and OPTIONS tells the methods") {
  TestServer server(routes());
  const Answer refused = server.ask("DELETE /v1/files/a HTTP/1.1\r\nHost: h\r\n\r\n");
  CHECK(refused.status == 405);
  CHECK(refused.field("Allow") == "GET, HEAD, PUT, OPTIONS");
  CHECK(refused.body.starts_with("method.not_allowed"));
  CHECK(refused.body.find("GET, HEAD, PUT, OPTIONS") != std::string::npos);
  const Answer unknown = server.ask("BREW /v1/tables/hole HTTP/1.1\r\nHost: h\r\n\r\n");
  CHECK(unknown.status == 405);
  CHECK(unknown.field("Allow") == "GET, HEAD, OPTIONS");
  CHECK(server.ask("get / HTTP/1.1\r\nHost: h\r\n\r\n").status == 405);
  CHECK(server.ask("BREW /nothing HTTP/1.1\r\nHost: h\r\n\r\n").status == 404);

  const Answer options = server.ask("OPTIONS /v1/tables/x/classes/y HTTP/1.1\r\nHost: h\r\n\r\n");
  CHECK(options.status == 204);
  CHECK(options.field("Allow") == "PUT, DELETE, OPTIONS");
  CHECK(options.field("Content-Length").empty());
  CHECK(server.ask("OPTIONS * HTTP/1.1\r\nHost: h\r\n\r\n").status == 204);
  CHECK(server.ask("OPTIONS /nothing HTTP/1.1\r\nHost: h\r\n\r\n").status == 404);
}

TEST_CASE("HEAD is GET without the body") {
  TestServer server(routes());
  Client client = server.connect();
  const Answer whole = client.ask(get("/v1/limits/25H7"));
  const auto head = client.ask("HEAD /v1/limits/25H7 HTTP/1.1\r\nHost: h\r\n\r\n", true);
  CHECK(head.status == 200);
  CHECK(head.field("Content-Length") == std::to_string(whole.body.size()));
  CHECK(client.ask(get("/")).status == 200);  // nothing was left between the answers
}

TEST_CASE("Accept chooses among the route's types") {
  TestServer server(
      {{.pattern = "/t",
        .handler = [](const Request& request) -> Result<Response> {
          return Response(200, std::string(request.response_type()), "x");
        },
        .response_types = {"application/json", "text/csv"}},
       answering("/any", [](const Request&) -> Result<Response> { return Response(204); })});
  const auto type = [&](std::string_view accept) {
    return server.ask(get("/t", "Accept: " + std::string(accept) + "\r\n")).field("Content-Type");
  };
  CHECK(server.ask(get("/t")).field("Content-Type") == "application/json");
  CHECK(type("") == "application/json");
  CHECK(type("*/*") == "application/json");
  CHECK(type("text/csv") == "text/csv");
  CHECK(type("TEXT/CSV") == "text/csv");
  CHECK(type("text/*") == "text/csv");
  CHECK(type("text/html, application/xhtml+xml, */*;q=0.8") == "application/json");
  CHECK(type("application/json;q=0.5, text/csv") == "text/csv");
  CHECK(type("application/json;q=0, */*") == "text/csv");
  CHECK(type("text/csv;q=0.5;x=\"a,b\", application/json;q=0.4") == "text/csv");
  const Answer refused = server.ask(get("/t", "Accept: image/png\r\n"));
  CHECK(refused.status == 406);
  CHECK(refused.body.starts_with("media_type.not_acceptable"));
  CHECK(server.ask(get("/t", "Accept: text/html\r\nAccept: text/csv\r\n")).status == 200);
  CHECK(server.ask(get("/t", "Accept: text/csv;q=0\r\n")).status == 406);
  CHECK(server.ask(get("/any", "Accept: image/png\r\n")).status == 204);
}

TEST_CASE("a route table that contradicts itself is refused when it is made") {
  const auto make = [](std::vector<Route> list) { return RouteTable(std::move(list)); };
  CHECK_THROWS_AS(make({show(Method::Get, "a")}), std::logic_error);
  CHECK_THROWS_AS(make({show(Method::Get, "/a"), show(Method::Get, "/a")}), std::logic_error);
  CHECK_THROWS_AS(make({show(Method::Get, "/{a}"), show(Method::Get, "/{b}")}), std::logic_error);
  CHECK_THROWS_AS(make({show(Method::Get, "/{a*}/b")}), std::logic_error);
  CHECK_THROWS_AS(make({show(Method::Get, "/x{a}")}), std::logic_error);
  CHECK_THROWS_AS(make({show(Method::Get, "/a", {{.name = "b", .place = ParameterPlace::Path}})}),
                  std::logic_error);
}

TEST_CASE("a GET is answered with Date, type and length, and the connection goes on") {
  TestServer server({echo(Method::Get, "/a")});
  Client client = server.connect();
  for (int i = 0; i < 3; ++i) {
    const auto answer = client.ask(get("/a"));
    CHECK(answer.status == 200);
    CHECK(answer.head.starts_with("HTTP/1.1 200 OK\r\n"));
    CHECK(answer.field("Content-Type") == "text/plain");
    CHECK(answer.field("Content-Length") == "5");
    CHECK(answer.field("Date").ends_with(" GMT"));
    CHECK(answer.field("Connection").empty());
    CHECK(answer.body == "fixed");
  }
}
