#include "metrology/statistics/control_chart.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

constexpr double kFarOut = 9;       // the density beyond is below 1e-18
constexpr double kStep = 1.0 / 16;  // the trapezium rule over such a density is exact to rounding

template <class F>
double over_all(const F& f) {
  double sum = 0;
  for (double x = -kFarOut; x <= kFarOut; x += kStep) sum += f(x);
  return sum * kStep;
}

/// The integral of w times the probability that the range exceeds w: half the mean square range.
double half_mean_square_range(double n) {
  const auto not_within = [n](double w) {
    // The range stays below w: the smallest value at x, the others up to w above it.
    const double within = over_all([&](double x) {
      return n * normal_density(x) * std::pow(normal_below(x + w) - normal_below(x), n - 1);
    });
    return w * (1 - within);
  };
  double sum = 0;
  constexpr int kPanels = 4;
  constexpr double kWidest = 2 * kFarOut;
  for (int panel = 0; panel < kPanels; ++panel) {
    sum += boost::math::quadrature::gauss<double, 20>::integrate(
        not_within, kWidest * panel / kPanels, kWidest * (panel + 1) / kPanels);
  }
  return sum;
}

/// A square system of linear equations, one right side; solved in place.
class Equations {
 public:
  explicit Equations(std::size_t n) : n_(n), cells_(n * (n + 1)) {}

  double& at(std::size_t row, std::size_t column) { return cells_[row * (n_ + 1) + column]; }
  double& right(std::size_t row) { return at(row, n_); }

  /// Gauss with pivots. @pre not singular
  std::vector<double> solve() {
    for (std::size_t k = 0; k < n_; ++k) {
      bring_up_pivot(k);
      for (std::size_t row = k + 1; row < n_; ++row) {
        const double factor = at(row, k) / at(k, k);
        if (factor == 0) continue;
        for (std::size_t column = k; column <= n_; ++column) {
          at(row, column) -= factor * at(k, column);
        }
      }
    }
    std::vector<double> x(n_);
    for (std::size_t k = n_; k-- > 0;) {
      double rest = right(k);
      for (std::size_t column = k + 1; column < n_; ++column) rest -= at(k, column) * x[column];
      x[k] = rest / at(k, k);
    }
    return x;
  }

 private:
  void bring_up_pivot(std::size_t k) {
    std::size_t best = k;
    for (std::size_t row = k + 1; row < n_; ++row) {
      if (std::abs(at(row, k)) > std::abs(at(best, k))) best = row;
    }
    if (best == k) return;
    for (std::size_t column = k; column <= n_; ++column) std::swap(at(k, column), at(best, column));
  }

  std::size_t n_;
  std::vector<double> cells_;
};

/// The nodes and weights of Gauss and Legendre over an interval, 60 for every 20 deviations of the
/// normal density that is integrated.
struct Node {
  double x = 0;
  double weight = 0;
};
std::vector<Node> nodes(double from, double to, double deviation) {
  using Rule = boost::math::quadrature::gauss<double, 60>;
  constexpr double kDeviations = 20;
  const auto parts = std::ceil((to - from) / (kDeviations * deviation));
  const double half = (to - from) / parts / 2;
  std::vector<Node> all;
  for (double part = 0; part < parts; ++part) {
    const double middle = from + (2 * part + 1) * half;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      for (const double sign : {-1.0, 1.0}) {
        all.push_back({middle + sign * half * Rule::abscissa()[i], half * Rule::weights()[i]});
      }
    }
  }
  return all;
}

}  // namespace

RangeConstants range_constants(std::size_t count) {
  const auto n = static_cast<double>(count);
  RangeConstants constants;
  constants.d2 = over_all(
      [n](double x) { return 1 - std::pow(normal_below(x), n) - std::pow(normal_below(-x), n); });
  constants.d3 = std::sqrt(2 * half_mean_square_range(n) - constants.d2 * constants.d2);
  return constants;
}

double c4(std::size_t count) {
  const auto n = static_cast<double>(count);
  return std::sqrt(2 / (n - 1)) * std::exp(std::lgamma(n / 2) - std::lgamma((n - 1) / 2));
}

void ZoneHistory::reduce(ZoneRules rules) {
  unsigned reduced = 0;
  for (const unsigned shift : {0U, kSide}) {
    const unsigned side = past_ >> shift;
    unsigned beyond_1 = side >> kBeyond1 & 0b1111U;
    // A point is the oldest of a pattern of four in five only if three of its five are beyond,
    // counting newer points and points to come.
    for (int age = 4; age >= 1; --age) {
      const unsigned bit = 1U << static_cast<unsigned>(age - 1);
      const int newer = std::popcount(beyond_1 & (bit - 1U));
      if (newer + 5 - age < 3) beyond_1 &= ~bit;
    }
    const unsigned seen = side >> kRun & 0x7FU;
    const unsigned run = (1U << static_cast<unsigned>(std::countr_one(seen))) - 1U;
    unsigned kept = 0;
    if (rules.has(2)) kept |= side & 0b11U << kBeyond2;
    if (rules.has(3)) kept |= beyond_1 << kBeyond1;
    if (rules.has(4)) kept |= run << kRun;
    reduced |= kept << shift;
  }
  past_ = reduced;
}

std::vector<RuleViolation> find_violations(std::span<const double> points, const ZoneLines& lines,
                                           ZoneRules rules) {
  std::vector<RuleViolation> violations;
  if (rules.empty()) return violations;
  ZoneHistory history;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i];
    int zone = 0;
    for (std::size_t k = 0; k < lines.above.size(); ++k) {
      zone += int{x > lines.above[k]} - int{x < lines.below[k]};
    }
    const ZoneRules completed =
        history.add({zone, int{x > lines.centre} - int{x < lines.centre}}) & rules;
    if (completed.empty()) continue;
    for (int rule = 1; rule <= ZoneRules::kCount; ++rule) {
      if (completed.has(rule)) violations.push_back({rule, i});
    }
  }
  return violations;
}

double zone_rules_run_length(ZoneRules rules) {
  // Every history from the empty one, and its successor for each zone of the next point.
  std::map<ZoneHistory, std::size_t> numbers{{ZoneHistory(), 0}};
  std::vector<ZoneHistory> histories{ZoneHistory()};
  struct Step {
    std::size_t from = 0;
    std::size_t to = 0;
    double probability = 0;
  };
  std::vector<Step> steps;
  for (std::size_t from = 0; from < histories.size(); ++from) {
    for (int zone = 0; zone <= 3; ++zone) {
      const double probability =
          (zone == 3 ? 1.0 : normal_below(zone + 1.0)) - normal_below(zone + 0.0);
      for (const int side : {-1, 1}) {
        ZoneHistory next = histories[from];
        if (!(next.add({side * zone, side}) & rules).empty()) continue;
        next.reduce(rules);
        const auto [found, is_new] = numbers.try_emplace(next, histories.size());
        if (is_new) histories.push_back(next);
        steps.push_back({from, found->second, probability});
      }
    }
  }
  // L(h) = 1 + the sum of L over the histories that follow without a signal.
  Equations equations(histories.size());
  for (std::size_t i = 0; i < histories.size(); ++i) {
    equations.at(i, i) = 1;
    equations.right(i) = 1;
  }
  for (const Step& step : steps) equations.at(step.from, step.to) -= step.probability;
  return equations.solve().front();
}

double ewma_run_length(double lambda, double width) {
  const double limit = width * std::sqrt(lambda / (2 - lambda));
  std::vector<Node> grid = nodes(-limit, limit, lambda);
  grid.push_back({0, 0});  // where the chart begins
  Equations equations(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    equations.right(i) = 1;
    for (std::size_t j = 0; j < grid.size(); ++j) {
      const double reached = (grid[j].x - (1 - lambda) * grid[i].x) / lambda;
      equations.at(i, j) = (i == j ? 1.0 : 0.0) - grid[j].weight * normal_density(reached) / lambda;
    }
  }
  return equations.solve().back();
}

double cusum_run_length(double reference_value, double decision_interval) {
  // Siegmund's approximation (1985), if the equations are not accurate enough.
  const double reach = 2 * reference_value * (decision_interval + 1.166);
  const double roughly = (std::expm1(reach) - reach) / (4 * reference_value * reference_value);
  if (roughly > kLongestRun) return std::numeric_limits<double>::infinity();
  std::vector<Node> grid = nodes(0, decision_interval, 1);
  grid.push_back({0, 0});
  const std::size_t zero = grid.size() - 1;
  Equations equations(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    equations.right(i) = 1;
    for (std::size_t j = 0; j < grid.size(); ++j) {
      equations.at(i, j) = (i == j ? 1.0 : 0.0) -
                           grid[j].weight * normal_density(grid[j].x + reference_value - grid[i].x);
    }
    equations.at(i, zero) -= normal_below(reference_value - grid[i].x);  // back to nothing
  }
  return equations.solve().back() / 2;
}

}  // namespace fitgauge::metrology
