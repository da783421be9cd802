#include <doctest/doctest.h>

#include "base/clock.hpp"
#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

Result<Response> describe(const Request& request) {
  std::string text;
  if (const auto value = request.text("part_id")) text += fmt::format("part_id={} ", *value);
  if (const auto value = request.integer("limit")) text += fmt::format("limit={} ", *value);
  if (const auto value = request.integer("factor")) text += fmt::format("factor={} ", *value);
  if (const auto value = request.length("measured_mm"))
    text += fmt::format("nm={} ", value->count());
  if (const auto value = request.length("u_um")) text += fmt::format("u={} ", value->count());
  if (const auto value = request.text("rule")) text += fmt::format("rule={} ", *value);
  if (const auto value = request.time("from")) text += "from=" + format_rfc3339(*value) + " ";
  if (const auto value = request.integer("X-Depth")) text += fmt::format("depth={} ", *value);
  return Response(200, "text/plain", text);
}

std::vector<Route> parameter_routes() {
  return {
      {.pattern = "/q",
       .handler = SyncHandler(describe),
       .parameters = {{.name = "part_id", .type = Text{.max_length = 8}},
                      {.name = "limit", .type = Integer{1, 1000}},
                      {.name = "factor", .type = Decimal{.scale = 3, .min = 0, .max = 10'000}},
                      {.name = "measured_mm", .type = LengthIn{.round_to_nearest = true}},
                      {.name = "u_um", .type = LengthIn{.unit = LengthUnit::Micrometre}},
                      {.name = "rule", .type = Words{{"simple", "guard_band"}}},
                      {.name = "from", .type = Time{}},
                      {.name = "X-Depth", .place = ParameterPlace::Header, .type = Integer{0, 9}}},
       .response_types = {"text/plain"}},
      {.pattern = "/required",
       .handler = [](const Request&) -> Result<Response> { return Response(204); },
       .parameters = {{.name = "class", .required = true}}},
      {.pattern = "/id/{id}",
       .handler = [](const Request& request) -> Result<Response> {
         return Response(200, "text/plain", std::to_string(*request.integer("id")));
       },
       .parameters = {{.name = "id", .place = ParameterPlace::Path, .type = Integer{1, 99}}},
       .response_types = {"text/plain"}},
      {.pattern = "/wrong", .handler = [](const Request& request) -> Result<Response> {
         return Response(200, "text/plain", std::string(*request.text("undeclared")));
       }}};
}

}  // namespace

TEST_CASE("typed query parameters reach the handler as values") {
  TestServer server(parameter_routes());
  const auto body = [&](std::string_view query) {
    const Answer answer = server.ask(get("/q?" + std::string(query)));
    CHECK(answer.status == 200);
    return answer.body;
  };
  CHECK(body("") == "");
  CHECK(body("limit=10&part_id=SN%2D1") == "part_id=SN-1 limit=10 ");
  CHECK(body("part_id=") == "part_id= ");
  CHECK(body("part_id=a+b%2B") == "part_id=a b+ ");
  CHECK(body("part%5Fid=x&&") == "part_id=x ");
  CHECK(body("part_id=a=b") == "part_id=a=b ");
  CHECK(body("factor=2,5") == "factor=2500 ");
  CHECK(body("measured_mm=25.0000004") == "nm=25000000 ");
  CHECK(body("u_um=0,8") == "u=800 ");
  CHECK(body("from=2026-11-20T08:00:00%2B01:00") == "from=2026-11-20T07:00:00Z ");
  CHECK(body("from=2026-11-20T08:00:00+01:00") == "from=2026-11-20T07:00:00Z ");
  CHECK(server.ask(get("/q", "x-depth: 3\r\n")).body == "depth=3 ");
}

TEST_CASE("a query that does not fit the table is refused with its code") {
  TestServer server(parameter_routes());
  const auto refusal = [&](std::string_view target, int status) {
    const Answer answer = server.ask(get(target));
    CHECK(answer.status == status);
    return answer.body.substr(0, answer.body.find(':'));
  };
  CHECK(refusal("/q?colour=red", 400) == "query.unknown");
  CHECK(refusal("/q?limit=1&limit=1", 400) == "query.repeated");
  CHECK(refusal("/q?limit=1&li%6Dit=2", 400) == "query.repeated");
  CHECK(refusal("/q?limit=0", 400) == "query.invalid");
  CHECK(refusal("/q?limit=12x", 400) == "query.invalid");
  CHECK(refusal("/q?limit=", 400) == "query.invalid");
  CHECK(refusal("/q?limit=99999999999999999999", 400) == "query.invalid");
  CHECK(refusal("/q?part_id=123456789", 400) == "query.invalid");
  CHECK(refusal("/q?factor=2.0001", 400) == "query.invalid");
  CHECK(refusal("/q?rule=Simple", 400) == "query.invalid");
  CHECK(refusal("/q?from=yesterday", 400) == "query.invalid");
  CHECK(refusal("/q?u_um=0.00001", 422) == "length.too_fine");
  CHECK(refusal("/q?u_um=x", 400) == "length.malformed");
  CHECK(refusal("/q?measured_mm=1000000000000", 422) == "length.out_of_range");
  CHECK(refusal("/q?part_id=%zz", 400) == "query.malformed");
  CHECK(refusal("/q?part_id=%ff", 400) == "query.malformed");
  CHECK(refusal("/q?part_id=%00", 400) == "query.malformed");
  CHECK(refusal("/required", 400) == "query.missing");
  CHECK(refusal("/id/100", 400) == "path.malformed");
  CHECK(server.ask(get("/id/42")).body == "42");
  CHECK(server.ask(get("/q", "X-Depth: 10\r\n")).status == 400);
  CHECK(server.ask(get("/q?limit=0")).body.find("limit must be a whole number from 1 to 1000") !=
        std::string::npos);
}

TEST_CASE("reading a parameter that the route does not declare is a defect: 500") {
  TestServer server(parameter_routes());
  CHECK(server.ask(get("/wrong")).status == 500);
  CHECK(server.ask(get("/id/1")).status == 200);
}
