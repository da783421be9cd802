#pragma once

#include "base/result.hpp"

namespace fitgauge::metrology {

/// The shapes of a contribution (JCGM 100, 4.3; JCGM 101, table 1). U-shaped is the arcsine.
enum class Distribution : std::uint8_t { Normal, Rectangular, Triangular, UShaped, T };
std::string_view word(Distribution distribution);

/// The standard uncertainty of a half width; none for the shapes that have no width.
std::optional<double> standard_uncertainty_of(Distribution distribution, double half_width);

struct Contribution {
  double standard_uncertainty = 0;
  double sensitivity = 1;
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
  Distribution distribution = Distribution::Normal;
  double estimate = 0;  ///< of the quantity, for a model
  /// Half width of inexact rectangular limits (JCGM 101, 6.4.3), divided by the half width of the
  /// quantity.
  double inexactness = 0;
};

/// y = f(x1, ..., xn), not finite if f has no value. Used by one thread at a time.
using Model = std::function<double(const std::vector<double>&)>;

struct Correlation {
  std::size_t a = 0;  ///< indices of contributions
  std::size_t b = 0;
  double coefficient = 0;
};

struct Budget {
  std::vector<Contribution> contributions{};
  std::vector<Correlation> correlations{};
  double probability = 0.95;
  Model model{};  ///< empty: the sum of the deviations with their sensitivities
};

struct CombinedUncertainty {
  double combined = 0;
  double welch_satterthwaite = 0;  ///< may be infinite
  double degrees_of_freedom = 0;   ///< truncated to a whole number, at least 1
  double coverage_factor = 0;      ///< of the t distribution
  double expanded = 0;
};

/// The law of propagation (JCGM 100, 5.1.2 and 5.2.2) with the formula of Welch and Satterthwaite
/// (G.4.1), which holds for independent contributions: those that are correlated count as one, with
/// the fewest degrees of freedom among them.
/// @errors FieldInvalid: correlations that no quantities can have (the variance would be negative).
Result<CombinedUncertainty> combine(const Budget& budget);

struct MonteCarloResult {
  double mean = 0;
  double standard_deviation = 0;
  double lower = 0;  ///< the interval with equal probability below and above it
  double upper = 0;
  std::uint64_t trials = 0;
};
inline constexpr std::uint64_t kMostDraws = 50'000'000;  ///< trials times contributions

struct Simulation {
  std::uint64_t trials = 1'000'000;  ///< of an adaptive one at most
  std::uint64_t seed = 1;
  /// Significant digits of the standard uncertainty that its trials must confirm, also for mean and
  /// interval (JCGM 101, 7.9.4). None: `trials` is used.
  std::optional<int> digits{};
};

/// Returns the numerical tolerance of a standard uncertainty with this number of significant
/// digits: half a unit of the last one (JCGM 101, 7.9.2); 0 for u = 0.
double numerical_tolerance(double u, int digits);

/// The propagation of distributions (JCGM 101), of deviations from the estimate, or of the values
/// of the model. A normal contribution with degrees of freedom is drawn from their t distribution
/// (6.4.9), a correlated one from a normal one. The same seed gives the same answer everywhere.
/// @errors FieldInvalid: correlated contributions that are not normal, or correlations as above;
///   NumberOutOfRange: values at which the model has none, or figures too large;
///   FiguresLimit where the thread's allowance is spent, or `trials` do not reach the digits.
Result<MonteCarloResult> simulate(const Budget& budget, const Simulation& simulation);

}  // namespace fitgauge::metrology
