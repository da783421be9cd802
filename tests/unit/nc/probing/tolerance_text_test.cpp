#include <doctest/doctest.h>

#include "nc/probing/object/object_cycle.hpp"

namespace fitgauge::probing {
namespace {

std::optional<Limits> limits_of(std::string_view text, bool inch = false) {
  CAPTURE(text);
  const auto limits = parse_tolerance(text, inch);
  REQUIRE(limits.has_value());
  return *limits;
}

Limits micrometres(std::int64_t upper, std::int64_t lower) {
  return {Length::micrometres(upper), Length::micrometres(lower)};
}

}  // namespace

TEST_CASE("QS400: one or both limits along the normal") {
  CHECK(limits_of("0.4-0.1") == micrometres(400, -100));
  CHECK(limits_of("0.4") == micrometres(400, 0));
  CHECK(limits_of("-0.1") == micrometres(0, -100));
  CHECK(limits_of("0-0.1") == micrometres(0, -100));
  CHECK(limits_of("0.4-0") == micrometres(400, 0));
  CHECK(limits_of("0,4-0,1") == micrometres(400, -100));
  CHECK(limits_of("0,025-0.01") == micrometres(25, -10));
  CHECK(limits_of("12-7") == micrometres(12'000, -7'000));
}

TEST_CASE("QS400: no tolerance") {
  for (const char* text : {"", " ", "    ", "0", "0.0", "0,000", "-0", "0-0", "0.1+0.1", "0,2+0"}) {
    CHECK_FALSE(limits_of(text).has_value());
  }
}

TEST_CASE("QS400: anything else names the position of what does not belong") {
  struct Case {
    std::string text;
    int position;
  };
  for (const Case& c : {Case{"+0.4", 1},
                        Case{"x", 1},
                        Case{" 0.4", 1},
                        Case{".4", 1},
                        Case{"--0.1", 2},
                        Case{"-", 2},
                        Case{"0.", 3},
                        Case{"0.4x", 4},
                        Case{"0.4 -0.1", 4},
                        Case{"0.4\xE2\x80\x93"
                             "0.1",
                             4},
                        Case{"0.4-", 5},
                        Case{"0.4--0.1", 5},
                        Case{"0.4+-0.1", 5},
                        Case{"0.4-0.1 ", 8},
                        Case{"0.4-0.1-0.2", 8},
                        Case{"-0.1+0.4", 5},
                        Case{"0.1+0.1x", 8},
                        Case{"1e-3", 2},
                        Case{"0.4.1", 4},
                        Case{"0.4-,1", 5},
                        Case{std::string("0\0", 2), 2}}) {
    CAPTURE(c.text);
    const auto limits = parse_tolerance(c.text, false);
    REQUIRE(limits.has_error());
    CHECK(limits.error().number == 1011);
    const std::string place = "QS400, position " + std::to_string(c.position) + ":";
    CHECK(limits.error().text.find(place) != std::string::npos);
  }
}

TEST_CASE("QS400: 255 characters at most, numbers up to 99999.9999") {
  std::string text = "0.4-0.1";
  text.append(255 - text.size(), '0');
  CHECK(limits_of(text) == micrometres(400, -100));
  const auto longer = parse_tolerance(text + "0", false);
  REQUIRE(longer.has_error());
  CHECK(longer.error().text.find("position 256") != std::string::npos);
  CHECK(limits_of(std::string(255, ' ')) == std::nullopt);
  CHECK(parse_tolerance(std::string(256, ' '), false).has_error());

  CHECK(limits_of("99999.9999")->upper == Length::nanometres(99'999'999'900));
  for (const char* large : {"0.1-100000", "0.1-99999999999999999999"}) {
    const auto beyond = parse_tolerance(large, false);
    REQUIRE(beyond.has_error());
    CHECK(beyond.error().number == 1004);
    CHECK(beyond.error().text.find("position 5") != std::string::npos);
  }
}

TEST_CASE("QS400: nearest nanometre, inches of an inch program") {
  CHECK(limits_of("0.0000004-0.0000005") == Limits{{}, Length::nanometres(-1)});
  CHECK(limits_of("1-0.0001", true) ==
        Limits{Length::micrometres(25'400), Length::nanometres(-2540)});
}

TEST_CASE("QS1100: a dimension with its tolerance") {
  const CycleParameter kPoint = parameter::position(1100, "1st point, main axis");
  const auto um = [](std::int64_t count) { return Length::micrometres(count); };
  struct Case {
    std::string text;
    Length target;
    std::optional<Limits> limits;
  };
  for (const Case& c :
       {Case{"50", um(50'000), {}}, Case{"-50,5", um(-50'500), {}},
        Case{"50+0.2-0.1", um(50'050), Limits{um(50'200), um(49'900)}},
        Case{"50-0.1+0.2", um(50'050), Limits{um(50'200), um(49'900)}},
        Case{"50+0.2", um(50'100), Limits{um(50'200), um(50'000)}},
        Case{"-50-0.1", um(-50'050), Limits{um(-50'000), um(-50'100)}},
        Case{"50+0.3+0.1", um(50'200), Limits{um(50'300), um(50'100)}},
        Case{"50+-0.1", um(50'000), Limits{um(50'100), um(49'900)}},
        Case{"10H7", Length::nanometres(10'007'500), Limits{um(10'015), um(10'000)}},
        Case{"10h6", Length::nanometres(9'995'500), Limits{um(10'000), um(9'991)}},
        Case{"10m", um(10'000), Limits{um(10'200), um(9'800)}}}) {
    CAPTURE(c.text);
    const auto read = parse_nominal(kPoint, c.text, false);
    REQUIRE(read.has_value());
    CHECK(read->target == c.target);
    CHECK(read->limits == c.limits);
  }
  CHECK(parse_nominal(kPoint, "1+0.01", true)->limits == Limits{um(25'654), um(25'400)});
  for (const char* text : {"", "x", "+", "50+", "50+0.1+", "50+0.1-0.2-0.3", "50+-", "50+-0.1-0.2",
                           "50X", "50H99", "0H7", "-10H7", "100000"}) {
    CAPTURE(text);
    CHECK(parse_nominal(kPoint, text, false).error().number == 1011);
  }
  for (const char* text : {"?", "?50", "50+0.2@50.01"}) {
    CHECK(parse_nominal(kPoint, text, false).error().number == 1097);
  }
}

TEST_CASE("QS1116: a size is not below 0") {
  const CycleParameter kSize = parameter::size(1116, "Diameter");
  CHECK(parse_nominal(kSize, "25-0.1", false)->target == Length::micrometres(24'950));
  CHECK(parse_nominal(kSize, "0", false)->target == Length{});
  for (const char* text : {"-25", "-25+0.1-0.1", "0.1-0.5"}) {
    CAPTURE(text);
    const auto read = parse_nominal(kSize, text, false);
    REQUIRE(read.has_error());
    CHECK(read.error().number == 1004);
    CHECK(read.error().text == fmt::format("Range exceeded: QS1116 = \"{}\" is not in 0 to "
                                           "99999.9999",
                                           text));
  }
}

}  // namespace fitgauge::probing
