#include <doctest/doctest.h>

#include <random>

#include "metrology/statistics/capability.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

using doctest::Approx;

/// A population by the value with a given probability below it, and its percentile index, computed
/// apart from the product by bisection of the probabilities of 0.135 %, 50 % and 99.865 %.
struct Population {
  std::string_view name;
  ProcessDistribution fitted;
  std::function<double(double)> quantile;
  double lower;
  double upper;
  double ppk;
};

double normal(double probability) { return static_cast<double>(normal_quantile(probability)); }

/// As many values as a sample without luck has, one in each of `count` equal parts of probability,
/// in random order.
std::vector<Wide> ideal_sample(const Population& of, std::size_t count, double unit) {
  std::vector<Wide> counts;
  for (std::size_t i = 0; i < count; ++i) {
    const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    counts.push_back(static_cast<Wide>(std::llround(of.quantile(middle) * unit)));
  }
  std::shuffle(counts.begin(), counts.end(), std::mt19937_64(22514));
  return counts;
}

SpecificationLimits limits_of(const Population& of) {
  const auto exact = [](double value) {
    return std::optional(Exact(Integer(std::llround(value * 1000))) / 1000);
  };
  SpecificationLimits limits{};
  limits.upper = exact(of.upper);
  if (std::isfinite(of.lower)) limits.lower = exact(of.lower);
  return limits;
}

std::vector<Population> populations() {
  const double none = -INFINITY;
  const auto folded = [](double p) { return 4 * normal((1 + p) / 2); };
  const auto rayleigh = [](double p) { return 10 * std::sqrt(-2 * std::log1p(-p)); };
  const auto weibull = [](double p) { return 5 * std::pow(-std::log1p(-p), 1 / 1.5); };
  const auto upper_tail = [](double p) { return 20 + std::exp(1 + normal(p) / 2); };
  const auto lower_tail = [](double p) { return 40 - std::exp(1 + normal(p) / 2); };
  // Two parts in five of one machine, three of another: the strata of each by itself.
  const auto machines = [](double p) {
    return p < 0.4 ? 24.99 + 0.002 * normal(p / 0.4) : 25 + 0.002 * normal((p - 0.4) / 0.6);
  };
  return {
      {"folded normal", ProcessDistribution::FoldedNormal, folded, none, 12, 0.9189403067},
      {"Rayleigh", ProcessDistribution::Rayleigh, rayleigh, none, 40, 1.1483860317},
      {"Weibull", ProcessDistribution::Weibull, weibull, none, 20, 1.1748478351},
      {"lognormal", ProcessDistribution::Lognormal, upper_tail, 20, 33, 1.0863947551},
      {"lower tail", ProcessDistribution::Lognormal, lower_tail, 27, 40, 1.0863947551},
      {"two machines", ProcessDistribution::Mixture, machines, 24.98, 25.02, 1.3398410313},
  };
}

}  // namespace

TEST_CASE(
    "each distribution is told from the others, and its percentiles are those of the process") {
  for (const Population& of : populations()) {
    CAPTURE(of.name);
    const Subgroups data{.values = Decimals(ideal_sample(of, 5000, 10'000), 4), .size = 1};
    const Capability c = assess_capability(data, limits_of(of), 0.95L).value();
    CHECK(c.normality->p < 0.01);
    REQUIRE(c.distribution);
    CHECK(word(c.distribution->name) == word(of.fitted));
    CHECK(c.distribution->p > 0.01);
    CHECK(static_cast<double>(c.ppk->value) == Approx(of.ppk).epsilon(0.005));
    CHECK(c.ppk->value == c.cpk->value);
    CHECK(std::isnan(c.ppk->lower));
    CHECK_FALSE(c.reason());
  }
}

TEST_CASE("the index of a normal distribution is not given to a folded one") {
  const Population folded = populations().front();
  const Subgroups data{.values = Decimals(ideal_sample(folded, 500, 1000), 3), .size = 1};
  const Capability c = assess_capability(data, limits_of(folded), 0.95L).value();
  CHECK(static_cast<double>((12 - c.mean) / (3 * c.overall)) > 1.2);
  CHECK(static_cast<double>(c.ppk->value) == Approx(0.919).epsilon(0.02));
}

TEST_CASE("values in more classes than are counted give the figures of all of them") {
  const Population folded = populations().front();
  const std::vector<Wide> values = ideal_sample(folded, 20'000, 1e7);
  double squares = 0;
  for (const Wide value : values) squares += std::pow(static_cast<double>(value) / 1e7, 2);
  const auto fit = fit_distribution(Ranking(values), 7).value();
  CHECK(fit.name == ProcessDistribution::FoldedNormal);
  CHECK(fit.parameters[0] == Approx(std::sqrt(squares / 20'000)).epsilon(1e-6));
}

TEST_CASE("values that crowd near zero keep their logarithms in their classes") {
  Population crowded = populations().at(2);
  crowded.quantile = [](double p) { return 5 * std::pow(-std::log1p(-p), 1 / 0.6); };
  const std::vector<Wide> values = ideal_sample(crowded, 20'000, 1e7);
  // The most likely shape of all values, by bisection.
  double low = 0.3;
  double high = 1.2;
  while (high - low > 1e-9) {
    const double shape = (low + high) / 2;
    double sum = 0;
    double weighted = 0;
    double logarithms = 0;
    for (const Wide value : values) {
      const double x = static_cast<double>(value) / 1e7;
      sum += std::pow(x, shape);
      weighted += std::pow(x, shape) * std::log(x);
      logarithms += std::log(x) / 20'000;
    }
    (weighted / sum - 1 / shape > logarithms ? high : low) = shape;
  }
  const auto fit = fit_distribution(Ranking(values), 7).value();
  CHECK(fit.name == ProcessDistribution::Weibull);
  CHECK(fit.parameters[0] == Approx(low).epsilon(1e-4));
}

TEST_CASE("normal values of a coarse gauge are normal") {
  const Population of{
      .name = {}, .fitted = {}, .quantile = normal, .lower = -5, .upper = 5, .ppk = 0};
  const Subgroups data{.values = Decimals(ideal_sample(of, 100'000, 1), 0), .size = 1};
  const Capability c = assess_capability(data, limits_of(of), 0.95L).value();
  CHECK(c.normality->p < 0.01);
  REQUIRE(c.distribution);
  CHECK(c.distribution->name == ProcessDistribution::Normal);
  CHECK(c.model->model == ProcessModel::A1);
}

TEST_CASE("without a distribution that fits there is no index, and the reason is said") {
  // As many values at 0, 1 and 9 as between 3 and 7.
  const Population of{
      .name = {},
      .fitted = {},
      .quantile = [](double p) { return p < 0.5 ? std::floor(p * 6) * 4.5 : 3 + 8 * (p - 0.5); },
      .lower = -20,
      .upper = 20,
      .ppk = 0};
  const Subgroups data{.values = Decimals(ideal_sample(of, 2000, 1000), 3), .size = 1};
  const Capability c = assess_capability(data, limits_of(of), 0.95L).value();
  CHECK_FALSE(c.distribution);
  CHECK_FALSE(c.percentile);
  CHECK_FALSE(c.ppk);
  CHECK_FALSE(c.cpk);
  CHECK_FALSE(c.cpm);
  CHECK(c.reason());
}

}  // namespace fitgauge::metrology
