#include "base/length.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;

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
