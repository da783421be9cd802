#include "metrology/statistics/summary.hpp"
#include "support.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;

TEST_CASE("a decimal is read as it is written, in any form JSON has") {
  const std::pair<const char*, Exact> cases[] = {
      {"25.021", Exact(25021, 1000)},
      {"-0.75", Exact(-3, 4)},
      {"0", 0},
      {"-0.000", 0},
      {"1e3", 1000},
      {"1E+2", 100},
      {"12.50e-1", Exact(5, 4)},
      {"0.1e1", 1},
      {"100000", 100000},
      {"25.005884000000002", Exact(Integer("25005884000000002"), Integer("1000000000000000"))},
      {"000.5", Exact(1, 2)}};
  for (const auto& [text, value] : cases) {
    CAPTURE(text);
    CHECK(parse_exact(text).value().exact() == value);
  }
}

TEST_CASE("what is no decimal, or too long a one, is refused with its code") {
  for (const char* text : {"", "-", ".5", "5.", "1e", "1e+", "+1", "1,5", "NaN", "Infinity", "0x1",
                           "1 ", " 1", "1e5.5", "--1", "1.2.3"}) {
    CAPTURE(text);
    CHECK(parse_exact(text).error().code == ErrorCode::NumberMalformed);
  }
  for (const char* text : {"1e31", "1e-31", "1e99999999999999999999", "1e-99999999999999999999",
                           "1234567890123456789012345678901"}) {
    CAPTURE(text);
    CHECK(parse_exact(text).error().code == ErrorCode::NumberOutOfRange);
  }
}

TEST_CASE(
    "decimals of different fineness have one scale, and one too far from the rest is refused") {
  Decimals values = decimals("25 0.5 -1e-9");
  CHECK(values[0] == 25);
  CHECK(values[1] == Exact(1, 2));
  CHECK(values[2] == Exact(-1, 1'000'000'000));
  CHECK(values.add("1e29").error().code == ErrorCode::NumberOutOfRange);
  CHECK(values.size() == 3);
  Decimals large = decimals("1e29");
  CHECK(large.add("1e-8").error().code == ErrorCode::NumberOutOfRange);
  CHECK(large.add("1e-7").has_value());
  CHECK(large[0] == Exact(power_of_ten(29)));
}

TEST_CASE("sums beyond 128 bits are exact") {
  ExactSum sum;
  const Wide large = Wide{1} << 126;
  for (int i = 0; i < 8; ++i) sum.add(large);
  sum.add(1);
  CHECK(sum.value() == (Integer(1) << 129) + 1);
  ExactSum squares;
  squares.add_product(large, -large);
  squares.add_product((Wide{1} << 61) + 1, (Wide{1} << 61) + 1);
  CHECK(squares.value() == (Integer(1) << 122) + (Integer(1) << 62) + 1 - (Integer(1) << 252));
}

TEST_CASE("a fraction is rounded once, half to even") {
  CHECK(nearest(Exact(1, 3)) == 1.0L / 3);
  CHECK(nearest(Exact(-1, 10)) == -0.1L);
  const Integer two_64 = Integer(1) << 64;
  CHECK(nearest(Exact(two_64 + 1)) == 0x1p64L);             // half way: even
  CHECK(nearest(Exact(two_64 + 3)) == 0x1p64L + 4);         // half way: even is above
  CHECK(nearest(Exact(2 * two_64 + 3, 2)) == 0x1p64L + 2);  // just above half way
  CHECK(nearest(Exact(Integer(1), Integer(1) << 300)) == std::ldexp(1.0L, -300));
  // By way of the nearest long double it would be 25.009740999999998.
  CHECK(nearest_double(Exact(Integer(25'009'741), Integer(1'000'000))) == 25.009741);
  CHECK(static_cast<double>(nearest(Exact(Integer(25'009'741), Integer(1'000'000)))) != 25.009741);
}

TEST_CASE("a square root is rounded once") {
  CHECK(square_root(2) == std::sqrt(2.0L));
  CHECK(square_root(Exact(1, 100)) == 0.1L);
  CHECK(square_root(Exact(Integer(4), power_of_ten(60))) == 2e-30L);
  CHECK(square_root(0) == 0);
}

TEST_CASE("a summary of one value, and of equal ones, says what is undefined") {
  const Summary one = summarise(decimals("25.003"));
  CHECK(one.moments.mean == Exact(25003, 1000));
  CHECK(std::isnan(one.moments.standard_deviation()));
  CHECK(std::isnan(one.autocorrelation_lag_1));
  CHECK(one.quantiles[4].value == 25.003L);
  const Summary equal = summarise(decimals("1.10 1.1 11e-1"));
  CHECK(equal.moments.standard_deviation() == 0);
  CHECK(std::isnan(equal.autocorrelation_lag_1));
  CHECK(equal.min == equal.max);
}

TEST_CASE("quantiles of type 7 lie between the values at (n - 1) p") {
  const Summary summary = summarise(decimals("4 1 3 2"));
  CHECK(summary.quantiles[3].value == 1.75L);  // numpy.percentile([1, 2, 3, 4], 25)
  CHECK(summary.quantiles[4].value == 2.5L);
  CHECK(summary.quantiles[5].value == 3.25L);
  CHECK(summary.quantiles[8].value == 3.99595L);
}
