#include "db/store/measurement_statistics.hpp"

#include <doctest/doctest.h>

using namespace fitgauge::store;

namespace {

struct Expected {
  std::string mean_mm;
  std::string standard_deviation_mm;
};

void check(const ExactStatistics& statistics, const Expected& expected) {
  CHECK(statistics.mean_mm() == expected.mean_mm);
  CHECK(statistics.standard_deviation_mm() == expected.standard_deviation_mm);
}

ExactStatistics of(const std::vector<std::int64_t>& values_nm) {
  ExactStatistics statistics;
  for (const std::int64_t value : values_nm) statistics.add(value);
  return statistics;
}

}  // namespace

// The figures are closed forms computed with 60 decimal digits: n values in steps of 1 nm have the
// variance n (n + 1) / 12.
TEST_CASE("mean and standard deviation have every digit") {
  check(of({25'013'000, 25'013'000}), {"25.013", "0"});
  check(of({0, 1, 2, 3, 4, 5, 6}), {"0.000003", "0.000002160247"});
  check(of({-3, -2, -1, 0, 1, 2}), {"-0.0000005", "0.000001870829"});
  check(of({0, 0, 1}), {"0.000000333333", "0.00000057735"});
  check(of({0, -1, -1}), {"-0.000000666667", "0.00000057735"});
}

TEST_CASE("a single value has a mean") { CHECK(of({-7}).mean_mm() == "-0.000007"); }

TEST_CASE("ten million values near 1,000,000.2 mm lose no digit") {
  ExactStatistics statistics;
  for (std::int64_t i = 0; i < 10'000'000; ++i) statistics.add(1'000'000'200'000 + i);
  check(statistics, {"1000005.1999995", "2.886751490286"});
}

TEST_CASE("the longest and the shortest length together lose no digit") {
  ExactStatistics statistics;
  for (int i = 0; i < 500; ++i) {
    statistics.add(1);
    statistics.add(100'000'000'000'000);
  }
  check(statistics, {"50000000.0000005", "50025018.765638183941"});
}
