#include "base/json/json_writer.hpp"

#include <doctest/doctest.h>

#include "base/json/json_value.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

TEST_CASE("the writer separates, escapes and prints exact lengths") {
  std::string out;
  JsonWriter json(out);
  json.begin_object()
      .member("name", "a\"b\\c\n\x01")
      .member_mm("size_mm", Length::nanometres(25'021'000))
      .member_um("deviation_um", Length::nanometres(-750))
      .key("list")
      .begin_array()
      .value(1)
      .null()
      .value(true)
      .value(0.5)
      .begin_object()
      .end_object()
      .end_array()
      .end_object();
  CHECK(out ==
        "{\"name\":\"a\\\"b\\\\c\\n\\u0001\",\"size_mm\":25.021,\"deviation_um\":-0.75,"
        "\"list\":[1,null,true,0.5,{}]}");
  CHECK(parse_json(out).has_value());
}

TEST_CASE("a member of what is stored is found without the rest") {
  constexpr std::string_view kReport =
      R"({"id":"r1","screen":["a [","b\"]"],"parameters":{"Q1":{"x":2}}})";
  CHECK(*stored_member(kReport, "screen", "report") == R"(["a [","b\"]"])");
  CHECK(*stored_member(kReport, "parameters", "report") == R"({"Q1":{"x":2}})");
  CHECK(stored_member(kReport, "files", "report")->empty());
  for (const std::string_view broken :
       {"", "[]", R"({"screen":)", R"({"screen":["a)", R"({"screen":7})"}) {
    CAPTURE(broken);
    const auto member = stored_member(broken, "screen", "report");
    REQUIRE(member.has_error());
    CHECK(member.error().code == ErrorCode::StorageCorrupt);
  }
}
