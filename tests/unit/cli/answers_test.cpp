#include <doctest/doctest.h>

#include "cli/answers.hpp"
#include "cli/measure_command.hpp"

using namespace fitgauge;
using namespace fitgauge::cli;

namespace {

constexpr Terminal kPlain{};

Answer problem(long status, std::string body) {
  return {.status = status, .content_type = "application/problem+json", .body = std::move(body)};
}

std::string verdict_text(const char* measured, const char* verdict) {
  JsonObject document;
  document.add("designation", "25 H7").add_raw("measured_mm", measured).add("verdict", verdict);
  document.add_raw("upper_limit_mm", "25.021").add_raw("lower_limit_mm", "25");
  return format_verdict(*parse_document(document.text()), kPlain);
}

}  // namespace

TEST_CASE("a number keeps its digits") {
  const auto document =
      parse_document(R"({"a":25.0210000000000001,"b":-7,"c":1e3,"d":[0.75,null]})");
  REQUIRE(document.has_value());
  CHECK(document->text_of("a") == "25.0210000000000001");
  CHECK(document->text_of("b") == "-7");
  CHECK(document->text_of("c") == "1e3");
  REQUIRE(document->member("d").items.size() == 2);
  CHECK(document->member("d").items[0].text == "0.75");
  CHECK(document->member("d").items[1].kind == JsonValue::Kind::Null);
  CHECK(document->text_of("missing").empty());
}

TEST_CASE("what is not one JSON document is refused") {
  for (const char* text : {"", "{", "{} {}", "[1,]", "\xFF"})
    CHECK_FALSE(parse_document(text).has_value());
}

TEST_CASE("a text is written so that it is read back") {
  const std::string text = "a\"b\\c\n\x01µ";
  CHECK(parse_document(json_string(text))->text == text);
  CHECK(JsonObject().add("a", "1").add_given("b", "").add_raw("c", "[]").text() ==
        R"({"a":"1","c":[]})");
}

TEST_CASE("a verdict says where the value is, to the nanometre") {
  CHECK(verdict_text("25.013", "good") ==
        "GOOD  25.013 mm  25 H7 (25 to 25.021 mm): 8 um below the upper limit\n");
  CHECK(verdict_text("25.021001", "reject").ends_with(": 0.001 um above the upper limit\n"));
  CHECK(verdict_text("25.0005", "good").ends_with(": 0.5 um above the lower limit\n"));
  CHECK(verdict_text("24.9999", "rework").ends_with(": 0.1 um below the lower limit\n"));
  CHECK(verdict_text("25.021", "good").ends_with(": on the upper limit\n"));
}

TEST_CASE("every verdict has its exit code") {
  CHECK(*verdict_exit_code("good") == ExitCode::Good);
  CHECK(*verdict_exit_code("rework") == ExitCode::Rework);
  CHECK(*verdict_exit_code("reject") == ExitCode::Reject);
  CHECK(*verdict_exit_code("indeterminate") == ExitCode::Indeterminate);
  CHECK(verdict_exit_code("fine").error().exit_code == ExitCode::NoAnswer);
}

TEST_CASE("limits are shown with the names of the standard") {
  const auto limits = parse_document(
      R"({"designation":"5 js1","tolerance_class":"js1","feature":"shaft","upper_deviation_um":0.5,
          "lower_deviation_um":-0.5,"upper_limit_mm":5.0005,"lower_limit_mm":4.9995,"tolerance_um":1,
          "size_range_mm":{"over":3,"up_to":6},"basis":"iso286"})");
  CHECK(format_limits(*limits, kPlain) ==
        "5 js1  shaft\n"
        "upper limit  5.0005 mm  es +0.5 um\n"
        "lower limit  4.9995 mm  ei -0.5 um\n"
        "tolerance    1 um       sizes over 3 up to 6 mm\n");
}

TEST_CASE("a refusal says what, where and what to do") {
  const Failure failure =
      failure_of(problem(422, R"({"title":"Request has invalid fields","detail":"is missing",
                       "code":"request.invalid",
                       "errors":[{"pointer":"/measured_mm","code":"x","detail":"is missing"}]})"),
                 "http://x");
  CHECK(failure.exit_code == ExitCode::Refused);
  CHECK(failure.message == "/measured_mm: is missing");
  CHECK_FALSE(failure.document.empty());
}

TEST_CASE("every kind of refusal has its exit code") {
  const auto code = [](long status) {
    return failure_of(problem(status, R"({"title":"t","code":"c"})"), "http://x").exit_code;
  };
  CHECK(code(400) == ExitCode::Refused);
  CHECK(code(404) == ExitCode::Refused);
  CHECK(code(401) == ExitCode::KeyNeeded);
  CHECK(code(403) == ExitCode::KeyNeeded);
  CHECK(code(500) == ExitCode::NoAnswer);
  CHECK(code(503) == ExitCode::NoAnswer);
  CHECK(failure_of({.status = 404, .content_type = "text/html", .body = "<p>"}, "http://x")
            .message.find("check that fitgauged runs there") != std::string::npos);
}

TEST_CASE("only what may succeed in a moment is repeated") {
  for (const long status : {408L, 429L, 502L, 503L, 504L}) {
    CHECK(is_temporary(problem(status, "{}")));
  }
  for (const long status : {201L, 400L, 401L, 404L, 422L, 500L}) {
    CHECK_FALSE(is_temporary(problem(status, "{}")));
  }
  CHECK(is_temporary(problem(409, R"({"code":"idempotency.in_progress"})")));
  CHECK_FALSE(is_temporary(problem(409, R"({"code":"run.finished"})")));
}

TEST_CASE("a bad row is named by its line in the file") {
  const auto line_of = [](std::uint64_t line) { return line + 1'000; };
  const auto rows = problem_of(
      problem(422, R"({"title":"t","errors":[{"pointer":"/3/measured_mm","line":5,"detail":"is x"},
                                             {"pointer":"/9/part_id","line":11,"detail":"is y"}]})"));
  CHECK(explain_rows(*rows, "night.csv", line_of) ==
        "night.csv:1005: measured_mm: is x\nnight.csv:1011: part_id: is y\n");
  const auto csv = problem_of(problem(
      400, R"({"title":"CSV cannot be read","detail":"line 7 has 3 cells","where":"line 7"})"));
  CHECK(explain_rows(*csv, "night.csv", line_of) == "night.csv:1007: has 3 cells\n");
  const auto json = problem_of(problem(
      400,
      R"({"code":"json.duplicate_key","detail":"line 7: the key \"a\" occurs twice","where":"line 7",
               "errors":[{"pointer":"/6","line":7,"detail":"line 7: the key \"a\" occurs twice"}]})"));
  CHECK(explain_rows(*json, "night.ndjson", line_of) ==
        "night.ndjson:1007: the key \"a\" occurs twice\n");
}
