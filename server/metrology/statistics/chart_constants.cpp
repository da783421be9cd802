#include "metrology/statistics/chart_constants.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "metrology/statistics/distributions.hpp"

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

}  // namespace fitgauge::metrology
