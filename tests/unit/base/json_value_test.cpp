#include "base/json/json_value.hpp"

#include <doctest/doctest.h>

#include "base/json/json_writer.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {
ErrorCode json_refused(std::string_view text) {
  const auto value = parse_json(text);
  REQUIRE_MESSAGE(value.has_error(), text);
  return value.error().code;
}
}  // namespace

TEST_CASE("numbers keep their digits") {
  const auto value =
      parse_json(R"({"a":25.005884000000002,"b":-0.10,"c":18446744073709551616})").value();
  CHECK(value.find("a")->text == "25.005884000000002");
  CHECK(value.find("b")->text == "-0.10");
  CHECK(value.find("c")->text == "18446744073709551616");
  CHECK(value.find("d") == nullptr);
  CHECK(parse_json("1e999")->text == "1e999");
}

TEST_CASE("unreadable JSON says where") {
  const auto value = parse_json("{\n  \"a\": tru\n}");
  CHECK(value.error().code == ErrorCode::JsonMalformed);
  CHECK(value.error().where.starts_with("line 2, column "));
  for (const char* text :
       {"", "{", "[1,]", "01", "NaN", "{\"a\":1}{}", "'a'", "\"\\ud800\"", "+1"}) {
    CHECK_MESSAGE(json_refused(text) == ErrorCode::JsonMalformed, text);
  }
}

TEST_CASE("a byte-order mark and invalid UTF-8 are refused") {
  CHECK(json_refused("\xEF\xBB\xBF{}") == ErrorCode::TextEncoding);
  CHECK(json_refused("\"\xFF\"") == ErrorCode::TextEncoding);
}

TEST_CASE("duplicate keys are refused, also in nested objects") {
  CHECK(json_refused(R"({"a":1,"a":2})") == ErrorCode::JsonDuplicateKey);
  CHECK(json_refused(R"([{"b":{"a":1,"\u0061":2}}])") == ErrorCode::JsonDuplicateKey);
}

TEST_CASE("what follows a NUL is read too") {
  using namespace std::string_view_literals;
  for (const auto text : {"{}\0"sv, "{}\0x"sv, "\0{}"sv, "{\"a\":1\0}"sv, "\"a\0\""sv}) {
    CHECK(json_refused(text) == ErrorCode::JsonMalformed);
  }
}

TEST_CASE("an object may have very many members") {
  std::string members;
  for (int i = 0; i < 200'000; ++i) members += fmt::format("\"k{}\":{},", i, i);
  const auto object = parse_json('{' + members + "\"end\":0}").value();
  CHECK(object.members.size() == 200'001);
  CHECK(object.find("k199999")->text == "199999");
  CHECK(json_refused('{' + members + "\"k7\":0}") == ErrorCode::JsonDuplicateKey);
}

TEST_CASE("the number of values is limited") {
  std::string zeros(5'200'000, '0');
  for (std::size_t i = 1; i < zeros.size(); i += 2) zeros[i] = ',';
  zeros.pop_back();
  CHECK(json_refused('[' + zeros + ']') == ErrorCode::BodyTooLarge);
}

TEST_CASE("depth is limited before it costs anything") {
  CHECK(json_refused(std::string(500'000, '[')) == ErrorCode::JsonTooDeep);
  CHECK(parse_json(std::string(32, '[') + std::string(32, ']')).has_value());
}

TEST_CASE("pointers are escaped") { CHECK(pointer_to(pointer_to("", 3), "a/b~c") == "/3/a~1b~0c"); }

TEST_CASE("a member that is not there reads as a null") {
  const JsonValue value =
      parse_json(R"({"a":{"b":[1,2]},"yes":true,"no":false,"n":-0.50})").value();
  CHECK(value.member("a").member("b").items.size() == 2);
  CHECK(value.member("x").member("y").is(JsonValue::Kind::Null));
  CHECK(value.text_of("yes") == "true");
  CHECK(value.text_of("no") == "false");
  CHECK(value.text_of("n") == "-0.50");
  CHECK(value.text_of("x").empty());
}

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
    CHECK(stored_member(broken, "screen", "report").error().code == ErrorCode::StorageCorrupt);
  }
}
