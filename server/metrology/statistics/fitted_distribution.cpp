#include "metrology/statistics/capability.hpp"

#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

/// More classes than this add nothing to six digits of a quantile.
constexpr std::size_t kMostClasses = 4096;
/// A class of positive values ends below this multiple of its start: logarithms differ little.
constexpr double kWidestClass = 1.01;

/// Number of values in a class, and their mean; a class ends in the middle between two values.
struct Place {
  double x = 0;
  double count = 0;
  double end = 0;
};
using Places = std::vector<Place>;

Places places_of(const Ranking& ranking, int scale) {
  const double unit = std::pow(10.0, scale);
  const auto at = [&](Wide value) { return static_cast<double>(value) / unit; };
  const double step =
      (at(ranking.back()) - at(ranking.front())) / static_cast<double>(kMostClasses);
  const bool many = ranking.values().size() > kMostClasses;
  Places places;
  double before = 0;
  double first = 0;  // of the class
  double last = 0;
  for (std::size_t i = 0; i < ranking.values().size(); ++i) {
    const double x = at(ranking.values()[i]);
    const double count = ranking.ends()[i] - std::exchange(before, ranking.ends()[i]);
    const bool is_near = x - first < step && (first <= 0 || x < kWidestClass * first);
    if (many && !places.empty() && is_near) {
      Place& place = places.back();
      place.count += count;
      place.x += (x - place.x) * count / place.count;
    } else {
      if (!places.empty()) places.back().end = (last + x) / 2;
      places.push_back({.x = x, .count = count});
      first = x;
    }
    last = x;
  }
  return places;
}

double number_of(const Places& places) {
  double n = 0;
  for (const Place& place : places) n += place.count;
  return n;
}

struct WeightedSpread {
  double share = 0;
  double mean = 0;
  double deviation = 0;
};

/// Mean and standard deviation of f(x), each value with its count and its weight.
WeightedSpread spread_of(const Places& places, const auto& f, const auto& weight) {
  double sum = 0;
  double first = 0;
  double squares = 0;
  const double from = f(places.front().x);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double w = places[i].count * weight(i);
    const double y = f(places[i].x) - from;
    sum += w;
    first += w * y;
    squares += w * y * y;
  }
  const double mean = first / sum;
  return {.share = sum,
          .mean = from + mean,
          .deviation = std::sqrt(std::max(0.0, squares / sum - mean * mean))};
}

WeightedSpread spread_of(const Places& places, const auto& f) {
  return spread_of(places, f, [](std::size_t) { return 1.0; });
}

double quantile_of(const Places& places, double p) {
  double sum = 0;
  const double wanted = p * number_of(places);
  for (const Place& place : places) {
    sum += place.count;
    if (sum >= wanted) return place.x;
  }
  return places.back().x;
}

/// Without the variance that rounding to the resolution adds (Sheppard 1898).
std::array<double, 5> fit_normal(const Places& places) {
  const WeightedSpread s = spread_of(places, [](double x) { return x; });
  double step = places.back().x - places.front().x;
  for (std::size_t i = 1; i < places.size(); ++i) {
    step = std::min(step, places[i].x - places[i - 1].x);
  }
  const double added = step * step / 12;
  return {s.mean, std::sqrt(std::max(s.deviation * s.deviation - added, added))};
}

double mean_square(const Places& places) {
  const WeightedSpread s = spread_of(places, [](double x) { return x * x; });
  return s.mean;
}

/// Newton's method for the shape, whose equation has one root.
std::array<double, 5> fit_weibull(const Places& places) {
  const double top = places.back().x;
  const WeightedSpread logs = spread_of(places, [&](double x) { return std::log(x / top); });
  double shape = 1.2 / logs.deviation;
  double power = 0;
  for (int step = 0; step < 50; ++step) {
    power = 0;
    double first = 0;
    double second = 0;
    for (const Place& place : places) {
      const double log = std::log(place.x / top);
      const double w = place.count * std::exp(shape * log);
      power += w;
      first += w * log;
      second += w * log * log;
    }
    const double ratio = first / power;
    const double f = ratio - 1 / shape - logs.mean;
    const double slope = second / power - ratio * ratio + 1 / (shape * shape);
    const double next = std::max(shape / 2, shape - f / slope);
    if (std::abs(next - shape) < 1e-12 * shape) break;
    shape = next;
  }
  return {shape, top * std::pow(power / number_of(places), 1 / shape)};
}

/// Expectation and maximisation (Dempster, Laird and Rubin 1977) from halves at a quantile.
std::optional<std::array<double, 5>> fit_mixture(const Places& places, double split) {
  const auto itself = [](double x) { return x; };
  const double border = quantile_of(places, split);
  const double floor = (places.back().x - places.front().x) / 1000;
  std::vector<double> first(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) first[i] = places[i].x <= border ? 1 : 0;
  const double n = number_of(places);
  std::array<double, 5> now{};
  for (int step = 0; step < 300; ++step) {
    const WeightedSpread a = spread_of(places, itself, [&](std::size_t i) { return first[i]; });
    const WeightedSpread b = spread_of(places, itself, [&](std::size_t i) { return 1 - first[i]; });
    if (a.share < 5 || b.share < 5) return std::nullopt;
    const auto before = std::exchange(now, {a.share / n, a.mean, std::max(floor, a.deviation),
                                            b.mean, std::max(floor, b.deviation)});
    if (std::abs(now[0] - before[0]) < 1e-7 && std::abs(now[1] - before[1]) < 1e-4 * floor) break;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double p = now[0] / now[2] * normal_density((places[i].x - now[1]) / now[2]);
      const double q = (1 - now[0]) / now[4] * normal_density((places[i].x - now[3]) / now[4]);
      first[i] = p + q > 0 ? p / (p + q) : first[i];
    }
  }
  return now;
}

/// Pearson's test over classes of about equal probability (Mann and Wald 1942: 2 n^0.4 of them).
void test_fit(FittedDistribution& fit, const Places& places) {
  const double n = number_of(places);
  const double classes = std::max(5.0, std::min(n / 8, 2 * std::pow(n, 0.4)));
  double observed = 0;
  double from = 0;
  int used = 0;
  fit.chi_squared = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    observed += places[i].count;
    const bool last = i + 1 == places.size();
    const double to = last ? 1 : fit.below(places[i].end);
    if (!last && (to - from < 1 / classes || 1 - to < 1 / classes)) continue;
    const double expected = std::max(n * (to - from), 1e-9);
    fit.chi_squared += (observed - expected) * (observed - expected) / expected;
    from = to;
    observed = 0;
    ++used;
  }
  fit.degrees_of_freedom = used - 1 - static_cast<double>(fit.named_parameters().size());
  fit.p = fit.degrees_of_freedom < 1
              ? 0
              : static_cast<double>(chi_squared_above(fit.chi_squared, fit.degrees_of_freedom));
}

/// Akaike's criterion of the classes between the values.
double criterion_of(const FittedDistribution& fit, const Places& places) {
  double sum = 0;
  double from = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double to = i + 1 == places.size() ? 1 : fit.below(places[i].end);
    sum += places[i].count * std::log(std::max(to - from, 1e-300));
    from = to;
  }
  return 2 * static_cast<double>(fit.named_parameters().size()) - 2 * sum;
}

/// The most likely origin beyond the shorter side, sought by its distance from the nearest value:
/// first in steps of a factor of two, then by golden section (Kiefer 1953).
FittedDistribution fit_lognormal(const Places& places, double tail) {
  const double nearest_value = tail > 0 ? places.front().x : places.back().x;
  const double range = places.back().x - places.front().x;
  const auto at = [&](double exponent) {
    const double origin = nearest_value - tail * range * std::exp2(exponent);
    const WeightedSpread s =
        spread_of(places, [&](double x) { return std::log(tail * (x - origin)); });
    return FittedDistribution{ProcessDistribution::Lognormal, {s.mean, s.deviation, origin, tail}};
  };
  const auto criterion = [&](double exponent) { return criterion_of(at(exponent), places); };
  double best = -12;
  for (double exponent = best + 1; exponent <= 6; ++exponent) {
    if (criterion(exponent) < criterion(best)) best = exponent;
  }
  constexpr double kGolden = 0.6180339887498949;
  double low = best - 1;
  double high = best + 1;
  while (high - low > 1e-4) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    if (criterion(left) < criterion(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return at((low + high) / 2);
}

std::vector<FittedDistribution> candidates(const Places& places) {
  std::vector<FittedDistribution> found = {{ProcessDistribution::Normal, fit_normal(places)}};
  if (places.front().x >= 0) {
    const double square = mean_square(places);
    found.push_back({ProcessDistribution::FoldedNormal, {std::sqrt(square)}});
    found.push_back({ProcessDistribution::Rayleigh, {std::sqrt(square / 2)}});
  }
  if (places.front().x > 0) found.push_back({ProcessDistribution::Weibull, fit_weibull(places)});
  for (const double tail : {1.0, -1.0}) found.push_back(fit_lognormal(places, tail));
  for (const double split : {0.2, 0.5, 0.8}) {
    if (const auto fit = fit_mixture(places, split)) {
      found.push_back({ProcessDistribution::Mixture, *fit});
    }
  }
  return found;
}

}  // namespace

double FittedDistribution::below(double x) const {
  const auto& [a, b, c, d, e] = parameters;
  switch (name) {
    case ProcessDistribution::Normal: return normal_below((x - a) / b);
    case ProcessDistribution::FoldedNormal: return x <= 0 ? 0 : std::erf(x / a / std::sqrt(2.0));
    case ProcessDistribution::Rayleigh: return x <= 0 ? 0 : -std::expm1(-x * x / (2 * a * a));
    case ProcessDistribution::Weibull: return x <= 0 ? 0 : -std::expm1(-std::pow(x / b, a));
    case ProcessDistribution::Lognormal: {
      const double beyond = d * (x - c);
      const double under = beyond <= 0 ? 0 : normal_below((std::log(beyond) - a) / b);
      return d > 0 ? under : 1 - under;
    }
    case ProcessDistribution::Mixture:
      return a * normal_below((x - b) / c) + (1 - a) * normal_below((x - d) / e);
  }
  return kUndefined;
}

double FittedDistribution::quantile(double probability) const {
  double low = -1;
  double high = 1;
  while (below(low) > probability) low *= 2;
  while (below(high) < probability) high *= 2;
  for (int step = 0; step < 200 && low < high; ++step) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (below(middle) < probability ? low : high) = middle;
  }
  return high;
}

std::vector<std::pair<std::string_view, double>> FittedDistribution::named_parameters() const {
  constexpr std::array<std::string_view, 5> kNames[] = {
      // in the order of ProcessDistribution
      {"mean", "standard_deviation"},
      {"scale"},
      {"scale"},
      {"shape", "scale"},
      {"log_mean", "log_standard_deviation", "origin", "tail"},
      {"share", "mean", "standard_deviation", "second_mean", "second_standard_deviation"}};
  std::vector<std::pair<std::string_view, double>> named;
  const auto& names = kNames[static_cast<std::size_t>(name)];
  for (std::size_t i = 0; i < names.size() && !names[i].empty(); ++i)
    named.emplace_back(names[i], parameters[i]);
  return named;
}

std::optional<FittedDistribution> fit_distribution(const Ranking& ranking, int scale) {
  const Places places = places_of(ranking, scale);
  std::optional<FittedDistribution> best;
  double least = 0;
  for (FittedDistribution& fit : candidates(places)) {
    test_fit(fit, places);
    if (fit.p < kModelSignificance) continue;
    const double criterion = criterion_of(fit, places);
    if (best && criterion >= least) continue;
    best = fit;
    least = criterion;
  }
  return best;
}

}  // namespace fitgauge::metrology
