#include "metrology/statistics/uncertainty.hpp"

#include "base/allowance.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

Error impossible() {
  return {ErrorCode::FieldInvalid,
          "the correlations contradict each other: their matrix is not positive"};
}

/// Correlations as the lower triangle L of L L' = R, row by row; none when R is not positive.
std::optional<std::vector<double>> cholesky(const Budget& budget) {
  const std::size_t n = budget.contributions.size();
  std::vector<double> l(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) l[i * n + i] = 1;
  for (const Correlation& c : budget.correlations) {
    l[std::max(c.a, c.b) * n + std::min(c.a, c.b)] = c.coefficient;
  }
  constexpr double kRounding = 1e-12;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = l[i * n + j];
      for (std::size_t k = 0; k < j; ++k) rest -= l[i * n + k] * l[j * n + k];
      if (i == j) {
        if (rest < -kRounding) return std::nullopt;
        l[i * n + i] = std::sqrt(std::max(0.0, rest));
      } else if (l[j * n + j] > kRounding) {
        l[i * n + j] = rest / l[j * n + j];
      } else {
        if (std::abs(rest) > kRounding) return std::nullopt;
        l[i * n + j] = 0;
      }
    }
  }
  return l;
}

/// Returns the group of each contribution: contributions that are correlated, directly or by
/// others, share one.
std::vector<std::size_t> groups_of(const Budget& budget) {
  std::vector<std::size_t> groups(budget.contributions.size());
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  for (const Correlation& c : budget.correlations) {
    if (c.coefficient == 0) continue;
    std::ranges::replace(groups, std::size_t{groups[c.b]}, std::size_t{groups[c.a]});
  }
  return groups;
}

/// SplitMix64 (Steele, Lea and Flood 2014), and its draws.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// Above 0 and below 1.
  double uniform() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
    return (static_cast<double>(z >> 11U) + 0.5) * 0x1p-53;
  }
  double normal() {
    if (!std::isnan(spare_)) return std::exchange(spare_, kNone);
    const double radius = std::sqrt(-2 * std::log(uniform()));
    const double angle = 2 * M_PI * uniform();
    spare_ = radius * std::sin(angle);
    return radius * std::cos(angle);
  }
  /// Student's t (Bailey 1994). @param freedom may be infinite
  double t(double freedom) {
    if (std::isinf(freedom)) return normal();
    const double u = uniform();
    const double angle = 2 * M_PI * uniform();
    return std::sqrt(freedom * (std::pow(u, -2 / freedom) - 1)) * std::cos(angle);
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::uint64_t state_;
  double spare_ = kNone;  ///< normals come in pairs
};

/// A deviation with the contribution's standard uncertainty.
double draw(Random& random, const Contribution& c) {
  switch (c.distribution) {
    case Distribution::Rectangular: {
      double width = c.standard_uncertainty * std::sqrt(3.0);
      if (const double r = c.inexactness; r > 0) {
        width *= (1 + r * (2 * random.uniform() - 1)) / std::sqrt(1 + r * r / 3);
      }
      return width * (2 * random.uniform() - 1);
    }
    case Distribution::Triangular:
      return c.standard_uncertainty * std::sqrt(6.0) * (random.uniform() + random.uniform() - 1);
    case Distribution::UShaped:
      return c.standard_uncertainty * std::sqrt(2.0) * std::cos(M_PI * random.uniform());
    case Distribution::Normal:
    case Distribution::T: break;
  }
  return c.standard_uncertainty * random.t(c.degrees_of_freedom);
}

/// The summary of values, which it sorts.
MonteCarloResult result_of(std::span<double> values, double probability) {
  std::ranges::sort(values);
  MonteCarloResult made{.trials = values.size()};
  const auto count = static_cast<double>(values.size());
  for (const double x : values) made.mean += x / count;
  double squares = 0;
  for (const double x : values) squares += (x - made.mean) * (x - made.mean);
  made.standard_deviation = std::sqrt(squares / (count - 1));
  // JCGM 101, 7.7: the interval has q = p M of the trials, equally many outside on either side.
  const auto inside = static_cast<std::size_t>(std::round(probability * count));
  const std::size_t first = (values.size() - std::min(inside, values.size() - 1)) / 2;
  made.lower = values[first];
  made.upper = values[std::min(first + inside, values.size() - 1)];
  return made;
}

/// Returns whether sequences agree to the requested digits (JCGM 101, 7.9.4, g to k): twice the
/// standard deviation of each figure's mean is at most the tolerance of the digits of u.
bool are_settled(std::span<const MonteCarloResult> sequences, int digits) {
  const auto count = static_cast<double>(sequences.size());
  const auto mean_of = [&](double MonteCarloResult::*figure) {
    double sum = 0;
    for (const MonteCarloResult& each : sequences) sum += each.*figure;
    return sum / count;
  };
  const double u = mean_of(&MonteCarloResult::standard_deviation);
  const double open = numerical_tolerance(u, digits);
  for (const auto figure : {&MonteCarloResult::mean, &MonteCarloResult::standard_deviation,
                            &MonteCarloResult::lower, &MonteCarloResult::upper}) {
    const double mean = mean_of(figure);
    double squares = 0;
    for (const MonteCarloResult& each : sequences)
      squares += (each.*figure - mean) * (each.*figure - mean);
    if (2 * std::sqrt(squares / (count * (count - 1))) > open) return false;
  }
  return true;
}

}  // namespace

std::optional<double> standard_uncertainty_of(Distribution distribution, double half_width) {
  switch (distribution) {
    case Distribution::Rectangular: return half_width / std::sqrt(3.0);
    case Distribution::Triangular: return half_width / std::sqrt(6.0);
    case Distribution::UShaped: return half_width / std::sqrt(2.0);
    case Distribution::Normal:
    case Distribution::T: break;
  }
  return std::nullopt;
}

double numerical_tolerance(double u, int digits) {
  return u > 0 ? std::pow(10, std::floor(std::log10(u)) - digits + 1) / 2 : 0;
}

Result<CombinedUncertainty> combine(const Budget& budget) {
  if (!cholesky(budget)) return impossible();
  const auto part = [&](std::size_t i) {
    const Contribution& c = budget.contributions[i];
    return c.sensitivity * c.standard_uncertainty;
  };
  const std::vector<std::size_t> groups = groups_of(budget);
  std::vector<double> variances(groups.size(), 0);
  std::vector<double> freedom(groups.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    variances[groups[i]] += part(i) * part(i);
    if (part(i) == 0) continue;
    double& fewest = freedom[groups[i]];
    fewest = std::min(fewest, budget.contributions[i].degrees_of_freedom);
  }
  for (const Correlation& c : budget.correlations) {
    variances[groups[c.a]] += 2 * c.coefficient * part(c.a) * part(c.b);
  }
  double variance = 0;
  double weighted = 0;  // the denominator of Welch and Satterthwaite
  for (std::size_t i = 0; i < groups.size(); ++i) {
    variance += variances[i];
    weighted += variances[i] * variances[i] / freedom[i];
  }
  CombinedUncertainty result;
  result.combined = std::sqrt(std::max(0.0, variance));
  result.welch_satterthwaite =
      weighted > 0 ? variance * variance / weighted : std::numeric_limits<double>::infinity();
  constexpr double kRounding = 1e-12;  // of sums in binary: 31 degrees must not become 30
  result.degrees_of_freedom =
      std::max(1.0, std::floor(result.welch_satterthwaite * (1 + kRounding)));
  const long double p = (1 + static_cast<long double>(budget.probability)) / 2;
  result.coverage_factor = static_cast<double>(std::isinf(result.degrees_of_freedom)
                                                   ? normal_quantile(p)
                                                   : t_quantile(p, result.degrees_of_freedom));
  result.expanded = result.coverage_factor * result.combined;
  return result;
}

Result<MonteCarloResult> simulate(const Budget& budget, const Simulation& simulation) {
  for (const Correlation& c : budget.correlations) {
    for (const std::size_t i : {c.a, c.b}) {
      if (budget.contributions[i].distribution != Distribution::Normal) {
        return Error{ErrorCode::FieldInvalid,
                     "only normal contributions can have correlations in a simulation"};
      }
    }
  }
  const auto triangle = cholesky(budget);
  if (!triangle) return impossible();
  const std::size_t n = budget.contributions.size();
  std::vector<bool> is_correlated(n, false);
  for (const Correlation& c : budget.correlations) is_correlated[c.a] = is_correlated[c.b] = true;
  Random random(simulation.seed);
  std::vector<double> standard(n);  // normal deviates, before they are correlated
  std::vector<double> arguments(n);
  const auto draw_value = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Contribution& c = budget.contributions[i];
      double deviation = 0;
      if (is_correlated[i]) {
        standard[i] = random.normal();
        for (std::size_t j = 0; j <= i; ++j) deviation += (*triangle)[i * n + j] * standard[j];
        deviation *= c.standard_uncertainty;
      } else {
        deviation = draw(random, c);
      }
      arguments[i] = c.estimate + deviation;
      sum += c.sensitivity * deviation;
    }
    return budget.model ? budget.model(arguments) : sum;
  };
  const double least = simulation.digits ? std::max(1e4, std::ceil(100 / (1 - budget.probability)))
                                         : static_cast<double>(simulation.trials);
  std::vector<double> values;
  std::vector<MonteCarloResult> sequences;
  do {
    const std::size_t begin = values.size();
    if (static_cast<double>(begin) + least > static_cast<double>(simulation.trials)) {
      return Error{ErrorCode::FiguresLimit,
                   "the digits need more trials than a simulation may have: set digits to 1, set "
                   "trials, or use a lower probability"};
    }
    values.resize(begin + static_cast<std::size_t>(least));
    constexpr std::size_t kBetweenLooks = 256;  // trials
    for (std::size_t i = begin; i < values.size(); ++i) {
      if (i % kBetweenLooks == 0 && Allowance::of_thread().is_spent()) {
        return Error{ErrorCode::FiguresLimit,
                     "the simulation needs more time or memory than one request may use"};
      }
      values[i] = draw_value();
      if (std::isfinite(values[i])) continue;
      return Error{
          ErrorCode::NumberOutOfRange,
          "the model has no value for some drawn quantities: use distributions within its domain"};
    }
    if (!simulation.digits) break;
    sequences.push_back(result_of(std::span(values).subspan(begin), budget.probability));
  } while (sequences.size() < 2 || !are_settled(sequences, *simulation.digits));
  const MonteCarloResult made = result_of(values, budget.probability);
  if (std::isfinite(made.mean) && std::isfinite(made.standard_deviation)) return made;
  return Error{ErrorCode::NumberOutOfRange,
               "the mean or the standard deviation of the drawn values is too large for a number: "
               "use another unit"};
}

}  // namespace fitgauge::metrology
