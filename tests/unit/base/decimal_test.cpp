#include "base/length.hpp"

#include <doctest/doctest.h>
#include <random>

using namespace fitgauge;

namespace {
std::int64_t parsed(std::string_view text, DecimalSyntax syntax = {}) {
  const auto value = parse_decimal(text, syntax);
  REQUIRE_MESSAGE(value.has_value(), text);
  return *value;
}

ErrorCode refused(std::string_view text, DecimalSyntax syntax = {}) {
  const auto value = parse_decimal(text, syntax);
  REQUIRE_MESSAGE(value.has_error(), text);
  return value.error().code;
}

}  // namespace

TEST_CASE("decimals are read exactly") {
  CHECK(parsed("25") == 25'000'000);
  CHECK(parsed("25.021") == 25'021'000);
  CHECK(parsed("-0.000001") == -1);
  CHECK(parsed("+1.5") == 1'500'000);
  CHECK(parsed("0025.0000000000000000") == 25'000'000);
  CHECK(parsed("0.00000000000") == 0);
  CHECK(parsed("-0") == 0);
  CHECK(parsed("9223372036854.775807") == std::numeric_limits<std::int64_t>::max());
}

TEST_CASE("digits beyond the scale are refused or rounded, never dropped") {
  CHECK(refused("25.0000001") == ErrorCode::LengthTooFine);
  CHECK(refused("0.0000000000001") == ErrorCode::LengthTooFine);
  const DecimalSyntax round{.round_to_nearest = true};
  CHECK(parsed("25.005884000000002", round) == 25'005'884);
  CHECK(parsed("0.0000005", round) == 1);
  CHECK(parsed("-0.0000005", round) == -1);
  CHECK(parsed("0.00000049999999", round) == 0);
  CHECK(parsed("0.00000000000009", round) == 0);
}

TEST_CASE("exponents are read only where they are allowed") {
  const DecimalSyntax exponent{.exponent = true};
  CHECK(parsed("2.5e1", exponent) == 25'000'000);
  CHECK(parsed("2.5E+1", exponent) == 25'000'000);
  CHECK(parsed("25000e-3", exponent) == 25'000'000);
  CHECK(parsed("0e999999999999999999999", exponent) == 0);
  CHECK(refused("2.5e1") == ErrorCode::NumberMalformed);
  CHECK(refused("1e999", exponent) == ErrorCode::NumberOutOfRange);
  CHECK(refused("1e-999", exponent) == ErrorCode::LengthTooFine);
  CHECK(refused("1e", exponent) == ErrorCode::NumberMalformed);
}

TEST_CASE("the decimal comma is read only where it is allowed") {
  CHECK(parsed("25,5", {.decimal_comma = true}) == 25'500'000);
  CHECK(refused("25,5") == ErrorCode::NumberMalformed);
  CHECK(refused("25,5.5", {.decimal_comma = true}) == ErrorCode::NumberMalformed);
}

TEST_CASE("what is not a decimal is refused as a whole") {
  for (const char* text : {"", " ", "25 ", " 25", "25.", ".5", "--1", "NaN", "inf", "0x10", "1_000",
                           "25.013abc", "1.2.3", "+", "-"}) {
    CHECK(refused(text, {.exponent = true}) == ErrorCode::NumberMalformed);
  }
  CHECK(refused("9223372036854.775808") == ErrorCode::NumberOutOfRange);
  CHECK(refused("99999999999999999999") == ErrorCode::NumberOutOfRange);
}

TEST_CASE("a sign, leading zeros and an exponent of zero change nothing") {
  std::mt19937_64 random(286);
  for (int i = 0; i < 20'000; ++i) {
    const int scale = static_cast<int>(random() % 19);
    std::string text = std::to_string(random() >> (random() % 64));
    if (random() % 3 != 0) text.insert(random() % (text.size() + 1), ".");
    CAPTURE(text);
    CAPTURE(scale);
    const auto plain = parse_decimal(text, {.scale = scale});
    for (const std::string& same : {"+" + text, "000" + text, text + "e0"}) {
      const auto other = parse_decimal(same, {.scale = scale, .exponent = true});
      REQUIRE(plain.has_value() == (other.has_value() && text.front() != '.'));
      if (plain) CHECK(*plain == *other);
    }
  }
}

TEST_CASE("decimals print in their shortest exact form") {
  CHECK(format_decimal(25'021'000, 6) == "25.021");
  CHECK(format_decimal(25'000'000, 6) == "25");
  CHECK(format_decimal(-750, 3) == "-0.75");
  CHECK(format_decimal(1, 6) == "0.000001");
  CHECK(format_decimal(0, 6) == "0");
  CHECK(format_decimal(std::numeric_limits<std::int64_t>::min(), 6) == "-9223372036854.775808");
}

TEST_CASE("printing and reading are inverse") {
  const unsigned seed = 286;
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 100'000; ++i) {
    const auto value = static_cast<std::int64_t>(random()) >> (random() % 60);
    CHECK(parsed(format_decimal(value, 6)) == value);
  }
}

TEST_CASE("a length of 1 mm is a million nanometres") {
  CHECK(Length::millimetres(1) == Length::nanometres(1'000'000));
  CHECK(Length::micrometres(-3).count() == -3'000);
  CHECK(Length::millimetres(25) + Length::micrometres(21) == *parse_length_mm("25.021"));
  CHECK(*parse_length_um("0.75") == Length::nanometres(750));
}

TEST_CASE("one rounding recovers the exact limit from doubles") {
  for (int size = 1; size <= 3150; ++size) {
    for (int deviation = -200; deviation <= 200; deviation += 7) {
      const double computed = size + deviation / 1000.0;
      CHECK(*Length::nearest_mm(computed) ==
            Length::millimetres(size) + Length::micrometres(deviation));
    }
  }
}

TEST_CASE("what is not a finite length is refused") {
  CHECK(Length::nearest_mm(std::nan("")).error().code == ErrorCode::LengthOutOfRange);
  CHECK(Length::nearest_mm(std::numeric_limits<double>::infinity()).has_error());
  CHECK(Length::nearest_mm(1e13).has_error());
  CHECK(parse_length_mm("NaN").error().code == ErrorCode::LengthMalformed);
  CHECK(parse_length_mm("1000000000.000001").error().code == ErrorCode::LengthOutOfRange);
  CHECK(parse_length_mm("25.0000001").error().code == ErrorCode::LengthTooFine);
}

TEST_CASE("lengths print without a superfluous digit") {
  CHECK(format_mm(Length::nanometres(25'021'000)) == "25.021");
  CHECK(format_um(Length::nanometres(-750)) == "-0.75");
  CHECK(format_um(Length::nanometres(10'500)) == "10.5");
}
