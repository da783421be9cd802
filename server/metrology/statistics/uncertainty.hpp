#pragma once

namespace fitgauge::metrology {

/// The shapes of a contribution (JCGM 100, 4.3; JCGM 101, table 1). U-shaped is the arcsine.
enum class Distribution : std::uint8_t { Normal, Rectangular, Triangular, UShaped, T };
constexpr std::string_view word(Distribution distribution) {
  return word_of(distribution, {"normal", "rectangular", "triangular", "u_shaped", "t"});
}

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

inline constexpr std::size_t kLongestModel = 1000;  ///< characters
inline constexpr std::size_t kLongestName = 100;    ///< characters, as muParser has it
/// Quantities with an uncertainty: some 10^5 values of the model.
inline constexpr std::size_t kMostOfSecondOrder = 25;

/// Returns whether a model can use this name for a quantity: at most 100 letters, digits and `_`,
/// not beginning with a digit, not a function, and not `pi`.
bool can_be_quantity(std::string_view name);

/// Reads `P*V/(R*(1+a*(T-T0)))`: + - * / ^ and brackets over quantities, numbers with a point,
/// `pi`, sqrt cbrt exp ln log10 sin cos tan asin acos atan sinh cosh tanh, in doubles and in every
/// locale.
/// @param names that can be quantities, no two alike: of the arguments, in their order
/// @errors FieldInvalid with the character: what cannot be read, a quantity without a name here, a
///   name that the model does not use, a model that is too long.
Result<Model> read_model(const std::string& text, const std::vector<std::string>& names);

/// Gives each contribution its sensitivity, the derivative of the model at the estimates to about
/// 1e-9: central differences, extrapolated (Ridders 1982) with the step whose error is least.
/// @returns the value of the model at the estimates
/// @errors FieldInvalid: no value there, or a derivative not known to 1e-6 of the uncertainty,
///   as at a kink, in noise, and where the uncertainty reaches a pole or the end of the domain.
Result<double> linearise(Budget& budget);

/// The standard uncertainty with the terms of second order (JCGM 100, note to 5.1.2).
/// @pre linearise() has been called.
/// @returns none for correlated quantities, for more than kMostOfSecondOrder, and where the terms
///   are not known to 1e-3 of it.
/// @errors FiguresLimit where the thread's allowance is spent.
Result<std::optional<double>> second_order_uncertainty(const Budget& budget);

}  // namespace fitgauge::metrology
