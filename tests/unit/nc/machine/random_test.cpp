#include "nc/machine/random.hpp"

#include <doctest/doctest.h>

using fitgauge::machine::Random;

TEST_CASE("the generator gives the published sequence") {
  // xoshiro256++ on the state that SplitMix64 makes of 1, computed with whole numbers of any size.
  Random random(1);
  CHECK(random.next() == 0xcfc5d07f6f03c29b);
  CHECK(random.next() == 0xbf424132963fe08d);
  CHECK(random.next() == 0x19a37d5757aaf520);
  CHECK(random.next() == 0xbf08119f05cd56d6);
}

TEST_CASE("normal numbers are the exact fractions rounded once") {
  Random random(1);
  CHECK(random.normal() == 0.18531021134356962);
  CHECK(random.normal() == -1.0268499787961431);
  CHECK(random.normal() == 0.9960464321469935);
}

TEST_CASE("normal numbers have mean 0, deviation 1 and the share of a normal distribution") {
  Random random(20260101);
  constexpr int kCount = 200'000;
  double sum = 0;
  double squares = 0;
  int within_one = 0;
  for (int k = 0; k < kCount; ++k) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
    within_one += std::abs(value) < 1;
  }
  CHECK(std::abs(sum / kCount) < 0.01);
  CHECK(std::abs(squares / kCount - 1) < 0.02);
  CHECK(std::abs(within_one / static_cast<double>(kCount) - 0.683) < 0.01);
}
