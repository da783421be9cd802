#include <doctest/doctest.h>

#include <random>

#include "metrology/statistics/capability.hpp"
#include "metrology/statistics/summary.hpp"

// What is done otherwise with many values gives the same as with few.

using namespace fitgauge;
using namespace fitgauge::metrology;

namespace {

std::vector<Wide> measured(std::size_t count, int spread) {
  std::mt19937_64 random(7);
  std::vector<Wide> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(25'000'000 + static_cast<Wide>(random() % static_cast<unsigned>(spread)));
  }
  return values;
}

std::vector<Wide> in_order(const Ranking& ranking) {
  std::vector<Wide> values;
  for (std::size_t i = 0; i < ranking.size(); ++i) values.push_back(ranking[i]);
  return values;
}

}  // namespace

TEST_CASE("values that are counted are ranked as those that are compared") {
  for (const int spread : {1, 500, 1 << 19, 1 << 24}) {
    const std::vector<Wide> values = measured(20'000, spread);
    std::vector<Wide> expected = values;
    std::sort(expected.begin(), expected.end());
    CHECK(in_order(Ranking(values)) == expected);
  }
  std::vector<Wide> far = measured(5'000, 100);
  far.front() = -(Wide{1} << 100);  // a difference beyond any table
  std::vector<Wide> expected = far;
  std::sort(expected.begin(), expected.end());
  CHECK(in_order(Ranking(far)) == expected);
  CHECK(Ranking({}).size() == 0);
}

TEST_CASE("Anderson-Darling of equal values is the sum over all of them") {
  const Ranking ranking(measured(3'000, 60));
  const std::vector<Wide> rising = in_order(ranking);
  std::vector<double> values;
  for (const Wide value : rising) values.push_back(static_cast<double>(value - rising.front()));
  const double mean = 29.5;
  const double deviation = 17.3;
  const auto n = static_cast<double>(values.size());
  double sum = 0;  // the definition, value by value
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto below = [&](double x) {
      return std::erfc(-(x - mean) / deviation / std::sqrt(2.0)) / 2;
    };
    sum += static_cast<double>(2 * i + 1) *
           (std::log(below(values[i])) + std::log(1 - below(values[values.size() - 1 - i])));
  }
  const double statistic = test_normality(ranking, mean, deviation).statistic;
  CHECK(statistic == doctest::Approx(-n - sum / n).epsilon(1e-9));
}

TEST_CASE("the scatter within groups is the same in 128 bits as in any number of them") {
  // Deviations beyond 2^40 take the long way: scaled, the analysis must not change.
  Groups groups;
  Groups scaled;
  std::vector<Wide> values = measured(600, 1'000);
  std::vector<Wide> longer = values;
  for (Wide& value : longer) value *= Wide{1} << 40;
  groups.values = Decimals(values, 0);
  scaled.values = Decimals(longer, 0);
  for (std::size_t end = 5; end <= values.size(); end += 5) groups.ends.push_back(end);
  scaled.ends = groups.ends;
  const Anova a = analyse_variance(groups.counts()).value();
  const Anova b = analyse_variance(scaled.counts()).value();
  CHECK(a.test.f == b.test.f);
  CHECK(b.within.sum_of_squares == a.within.sum_of_squares * Exact(Integer(1) << 80));
}
