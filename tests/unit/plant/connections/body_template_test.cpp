#include "plant/webhook/body_template.hpp"

#include <doctest/doctest.h>

#include "base/json/json_value.hpp"

using namespace fitgauge;
using namespace fitgauge::connections;

namespace {

constexpr std::string_view kEvent =
    R"({"type":"t","timestamp":"T","data":{"part":"a\"b","mm":25.010,"list":[1,2],"no":null}})";

std::string made(std::string_view json) {
  const auto body = parse_json(json).value();
  const auto read = BodyTemplate::read(body);
  return read ? read->body_of("m1", kEvent) : read.error().message;
}

}  // namespace

TEST_CASE("a field alone is its value, and inside a text its text") {
  CHECK(made(R"({"a":"{{mm}}"})") == R"({"a":25.010})");
  CHECK(made(R"({"a":"{{mm}} mm"})") == R"({"a":"25.010 mm"})");
  CHECK(made(R"({"a":"{{part}}","b":"<{{part}}>"})") == R"({"a":"a\"b","b":"<a\"b>"})");
  CHECK(made(R"(["{{list}}","{{list}}!","{{no}}","{{none}}","{{none}}."])") ==
        R"([[1,2],"[1,2]!",null,null,"."])");
  CHECK(made(R"(["{{id}}{{type}}","{{timestamp}}","{{data.mm}}"])") == R"(["m1t","T",25.010])");
  CHECK(made(R"(["\\\"{{mm}}"])") == R"(["\\\"25.010"])");
}

TEST_CASE("a template may be the text of JSON") {
  CHECK(made(R"("{\"a\": {{mm}}, \"b\": \"{{mm}}\"}")") == R"({"a": 25.010, "b": 25.010})");
}

TEST_CASE("what is no JSON, or names no field, is refused") {
  CHECK(made(R"({"a":"{{part id}}"})").find("must name a field") != std::string::npos);
  CHECK(made(R"({"a":"{{part"})").find("must name a field") != std::string::npos);
  CHECK(made(R"("{")").find("must be JSON") != std::string::npos);
  CHECK(made(R"({"{{mm}}":1})").find("must be JSON") != std::string::npos);
  CHECK(made(R"("")").find("1 to 16384 bytes; got 0") != std::string::npos);
}
