#include "metrology/statistics/uncertainty.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::metrology;
using doctest::Approx;

TEST_CASE("what cannot be correlated is refused") {
  const Contribution one{.standard_uncertainty = 1};
  const Budget impossible{.contributions = {one, one, one},
                          .correlations = {{0, 1, 1}, {0, 2, 1}, {1, 2, -1}}};
  CHECK(combine(impossible).error().code == ErrorCode::FieldInvalid);
  Budget rectangular{.contributions = {one, one}, .correlations = {{0, 1, 0.5}}};
  rectangular.contributions[0].distribution = Distribution::Rectangular;
  CHECK(simulate(rectangular, {.trials = 1000, .seed = 1}).error().code == ErrorCode::FieldInvalid);
}

TEST_CASE("Monte Carlo gives the intervals of JCGM 101, 9.2, and the same for the same seed") {
  // Four normal, then four rectangular contributions with u = 1: ±3.92 and ±3.88.
  Budget budget{.contributions = std::vector<Contribution>(4, {.standard_uncertainty = 1})};
  const MonteCarloResult normal = simulate(budget, {.trials = 400'000, .seed = 1}).value();
  CHECK(normal.standard_deviation == Approx(2).epsilon(0.005));
  CHECK(normal.upper == Approx(3.92).epsilon(0.008));
  CHECK(normal.lower == Approx(-3.92).epsilon(0.008));
  for (Contribution& c : budget.contributions) c.distribution = Distribution::Rectangular;
  const MonteCarloResult rectangular = simulate(budget, {.trials = 400'000, .seed = 1}).value();
  CHECK(rectangular.upper == Approx(3.88).epsilon(0.008));
  CHECK(simulate(budget, {.trials = 1000, .seed = 5}).value().upper ==
        simulate(budget, {.trials = 1000, .seed = 5}).value().upper);
  CHECK(simulate(budget, {.trials = 1000, .seed = 5}).value().upper !=
        simulate(budget, {.trials = 1000, .seed = 6}).value().upper);
}

TEST_CASE("correlated contributions have no more freedom than one of them") {
  Budget budget{.contributions = {{.standard_uncertainty = 1, .degrees_of_freedom = 5},
                                  {.standard_uncertainty = 1, .degrees_of_freedom = 7},
                                  {.standard_uncertainty = 0, .degrees_of_freedom = 1}},
                .correlations = {{0, 1, 1}, {1, 2, 0.5}, {0, 2, 0.5}}};
  const CombinedUncertainty one = combine(budget).value();
  CHECK(one.combined == Approx(2));
  CHECK(one.welch_satterthwaite == Approx(5));
  CHECK(one.expanded == Approx(2 * 2.570582).epsilon(1e-6));
  budget.correlations = {};
  // Apart: (1 + 1)^2 / (1/5 + 1/7).
  CHECK(combine(budget)->welch_satterthwaite == Approx(4 / (1.0 / 5 + 1.0 / 7)));
}

TEST_CASE("whole degrees of freedom are not one fewer") {
  const auto freedom = [](std::size_t count, double u, double each) {
    const Contribution one{.standard_uncertainty = u, .degrees_of_freedom = each};
    return combine({.contributions = std::vector<Contribution>(count, one)})->degrees_of_freedom;
  };
  CHECK(freedom(1, 0.8, 31) == 31);
  CHECK(freedom(2, 1.2, 15) == 30);
  CHECK(freedom(3, 0.1, 3) == 9);
  CHECK(freedom(1, 0.8, 31.999999) == 31);
}

TEST_CASE("a normal contribution with degrees of freedom is drawn from their t") {
  const Budget budget{.contributions = {{.standard_uncertainty = 1, .degrees_of_freedom = 5}}};
  const MonteCarloResult drawn = simulate(budget, {.trials = 400'000, .seed = 2}).value();
  CHECK(drawn.upper == Approx(2.570582).epsilon(0.015));
  CHECK(drawn.lower == Approx(-2.570582).epsilon(0.015));
}

TEST_CASE("every shape is drawn with its standard uncertainty") {
  for (const Distribution shape : {Distribution::Normal, Distribution::Rectangular,
                                   Distribution::Triangular, Distribution::UShaped}) {
    Budget budget{.contributions = {{.standard_uncertainty = 2, .distribution = shape}}};
    CHECK(simulate(budget, {.trials = 200'000, .seed = 3}).value().standard_deviation ==
          Approx(2).epsilon(0.01));
  }
  // A t with 10 degrees of freedom is wider: sqrt(10 / 8).
  Budget budget{
      .contributions = {
          {.standard_uncertainty = 2, .degrees_of_freedom = 10, .distribution = Distribution::T}}};
  CHECK(simulate(budget, {.trials = 200'000, .seed = 3}).value().standard_deviation ==
        Approx(2 * std::sqrt(1.25)).epsilon(0.01));
  CHECK(*standard_uncertainty_of(Distribution::Rectangular, 3) == Approx(std::sqrt(3)));
  CHECK_FALSE(standard_uncertainty_of(Distribution::Normal, 3));
}
