#include "formats/measuring_log/measuring_log.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::log_reader;

namespace {

constexpr std::string_view kBore =
    "# what BORE.A prints\n"
    "characteristic = bore-A\n"
    "tolerance_class = H7\n"
    "nominal_mm = 25\n"
    "---\n"
    "PART {part_id} {}:{}\n"
    "DIAMETER  {measured_mm} MM\n";

}  // namespace

TEST_CASE("a pattern reads every result of an FN 16 file") {
  const auto pattern = Pattern::parse(kBore);
  REQUIRE_MESSAGE(pattern.has_value(), pattern.error().message);
  const PatternReading reading = pattern->read(
      "SHIFT 1\r\nPART SN-1  12:30\r\nDIAMETER   25.013 MM\r\n\r\nPART SN 2 12:31\nNOTE "
      "x\nDIAMETER 25,020 MM\n"
      "PART SN-3 12:32\n");
  REQUIRE(reading.results.size() == 2);
  CHECK(reading.results[0].fields.at("part_id") == "SN-1");
  CHECK(reading.results[0].fields.at("measured_mm") == "25.013");
  CHECK(reading.results[0].fields.at("characteristic") == "bore-A");
  CHECK(reading.results[0].text == "PART SN-1 12:30\nDIAMETER 25.013 MM\n");
  CHECK(reading.results[1].fields.at("measured_mm") == "25,020");
  CHECK(reading.is_unfinished);
  CHECK(reading.unread.empty());
}

TEST_CASE("a result that lacks a line is told, and the next one is read") {
  const auto pattern = Pattern::parse(kBore).value();
  const PatternReading reading = pattern.read("PART A 1:2\nPART B 1:2\nDIAMETER 25 MM\n");
  REQUIRE(reading.unread.size() == 1);
  CHECK(reading.unread[0].line == 1);
  REQUIRE(reading.results.size() == 1);
  CHECK(reading.results[0].fields.at("part_id") == "B");
}

TEST_CASE("a pattern that cannot be meant is refused with its line") {
  const auto why = [](std::string_view text) { return Pattern::parse(text).error().message; };
  CHECK(why("") == "line 1: lines of a result must follow ---");
  CHECK(why("---\nX {part_id}\n") == "line 1: no line below --- has {measured_mm}");
  CHECK(why("measured_mm = 5\n---\nX\n") == "line 1: no line below --- has {measured_mm}");
  CHECK(why("---\n{measured_mm}{part_id}\n") == "line 2: two fields need a text between them");
  CHECK(why("---\n{measured_mm\n") == "line 2: a { has no }");
  CHECK(why("H7\n---\n{measured_mm}\n") == "line 1: a line above --- must be: field = value");
  CHECK(why("part_id = x\n---\n{measured_mm} {part_id}\n") ==
        "line 3: the field 'part_id' is used twice");
  for (const auto& [given, needed] :
       {std::pair("upper_um = 21\nlower_um = 0", "upper_um needs nominal_mm"),
        std::pair("upper_mm = 25.021\nlower_mm = 25", "upper_mm needs nominal_mm"),
        std::pair("nominal_mm = 25\nupper_um = 21", "upper_um needs lower_um"),
        std::pair("nominal_mm = 25\nlower_um = 0", "lower_um needs upper_um"),
        std::pair("nominal_mm = 25\nupper_mm = 25.021", "upper_mm needs lower_mm"),
        std::pair("nominal_mm = 25\nlower_mm = 25", "lower_mm needs upper_mm"),
        std::pair("tolerance_class = H7", "tolerance_class needs nominal_mm")}) {
    CHECK(why(fmt::format("{}\n---\n{{measured_mm}}\n", given))
              .starts_with(fmt::format("line 1: {}: add a line '", needed)));
  }
  CHECK(
      Pattern::parse("upper_um = 21\nlower_um = 0\n---\n{nominal_mm} {measured_mm}\n").has_value());
  CHECK(why("---\n{diameter}\n").starts_with("line 2: unknown field 'diameter'; use one of: "));
}
