#include "metrology/statistics/compensation.hpp"

namespace fitgauge::metrology {
namespace {

constexpr double kBeyondChance = 4;  ///< standard deviations
constexpr double kUnknown = 1e6;     ///< variance of a state that nothing is known of, in scatters
constexpr double kSure = 2;  ///< standard deviations of the offset that a proposal is beyond
constexpr std::size_t kRecent = 50;  ///< parts among which jumps are counted
constexpr std::size_t kMostJumps = 2;

/// Level and wear with their covariance, in units of the scatter's variance.
struct State {
  double level = 0;
  double wear = 0;
  double level_variance = kUnknown;
  double covariance = 0;
  double wear_variance = kUnknown;

  /// To the next part.
  void predict(double wandering, double offset) {
    level += wear + offset;
    level_variance += 2 * covariance + wear_variance + wandering;
    covariance += wear_variance;
  }
  /// Forgets the level, and keeps the wear.
  void forget_level() {
    level_variance = kUnknown;
    covariance = 0;
  }
  void update(double value) {
    const double total = level_variance + 1;
    const double off = value - level;
    const double gain = level_variance / total;
    const double gain_of_wear = covariance / total;
    level += gain * off;
    wear += gain_of_wear * off;
    wear_variance -= gain_of_wear * covariance;
    covariance *= 1 - gain;
    level_variance *= 1 - gain;
  }
};

enum class Kind : std::uint8_t { Usual, Outlier, Jump };

struct Filtered {
  State state;
  double scatter = 0;     ///< variance, by maximum likelihood
  double likelihood = 0;  ///< logarithm of it
};

Filtered filter(std::span<const MadePart> parts, std::span<const Kind> kinds, double wandering) {
  Filtered found;
  double squares = 0;
  double logs = 0;
  double count = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    State& state = found.state;
    if (i > 0) state.predict(wandering, parts[i].offset);
    if (kinds[i] == Kind::Outlier) continue;
    if (kinds[i] == Kind::Jump) state.forget_level();
    const double total = state.level_variance + 1;
    if (total < kUnknown / 100) {
      const double off = parts[i].deviation - state.level;
      squares += off * off / total;
      logs += std::log(total);
      ++count;
    }
    state.update(parts[i].deviation);
  }
  found.scatter = squares / std::max(1.0, count);
  found.likelihood = -(count * std::log(std::max(found.scatter, 1e-12)) + logs) / 2;
  return found;
}

/// The standard deviation of a part by the median of the steps from part to part, which jumps and
/// outliers hardly move.
double robust_scatter(std::span<const MadePart> parts) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].has_new_tool) continue;
    steps.push_back(std::abs(parts[i].deviation - parts[i - 1].deviation - parts[i].offset));
  }
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  constexpr double kOfTwo = 0.9538726;  // median of |N(0, 2)|
  return *middle / kOfTwo;
}

/// Distinguishes jumps and outliers from usual parts, by a filter with the usual wandering.
std::vector<Kind> kinds_of(std::span<const MadePart> parts, double scatter) {
  constexpr double kUsualWandering = 0.1;
  std::vector<Kind> kinds(parts.size(), Kind::Usual);
  State state;
  bool was_far = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) state.predict(kUsualWandering, parts[i].offset);
    const double off = std::abs(parts[i].deviation - state.level);
    const bool is_far = off > kBeyondChance * scatter * std::sqrt(state.level_variance + 1);
    if (parts[i].has_new_tool || (is_far && was_far)) {
      kinds[i] = Kind::Jump;
      state.forget_level();
      state.update(parts[i].deviation);
      was_far = false;
      continue;
    }
    was_far = is_far;
    if (is_far) {
      kinds[i] = Kind::Outlier;
    } else {
      state.update(parts[i].deviation);
    }
  }
  return kinds;
}

/// The wandering, in scatters, that the values are most likely with.
double likeliest_wandering(std::span<const MadePart> parts, std::span<const Kind> kinds) {
  double best = 0;
  double most = filter(parts, kinds, 0).likelihood;
  for (double exponent = -14; exponent <= 7; ++exponent) {
    const double wandering = std::exp2(exponent);
    const double likelihood = filter(parts, kinds, wandering).likelihood;
    if (likelihood <= most) continue;
    most = likelihood;
    best = wandering;
  }
  return best;
}

/// The deviation at which a correction costs as much as it saves: of wear D³ = 3 c |β| / 4 k, of
/// wandering D⁴ = 6 c q / k, with k the cost of a square micrometre.
double dead_band(double wear, double wandering, double half_tolerance, double cost) {
  const double square = half_tolerance * half_tolerance;
  return std::max(std::cbrt(3 * cost * std::abs(wear) * square / 4),
                  std::sqrt(std::sqrt(6 * cost * wandering * square)));
}

/// Parts until the level may have left the dead band.
std::int64_t parts_until(double level, double variance, double wear, double wandering,
                         double band) {
  constexpr std::int64_t kMost = 100;
  for (std::int64_t n = 1; n < kMost; ++n) {
    const auto parts = static_cast<double>(n);
    const double reach = kSure * std::sqrt(variance + parts * wandering);
    if (std::abs(level + parts * wear) + reach > band + kSure * std::sqrt(variance)) return n;
  }
  return kMost;
}

}  // namespace

Compensation propose_offset(std::span<const MadePart> parts, double half_tolerance, double cost,
                            double made) {
  Compensation found;
  found.reason = "fewer than six values";
  if (parts.size() < kFewestForCompensation) return found;
  const double usual = robust_scatter(parts);
  found.reason = "the values do not differ: the gauge does not resolve the process";
  if (usual == 0) return found;
  const std::vector<Kind> kinds = kinds_of(parts, usual);
  const double ratio = likeliest_wandering(parts, kinds);
  Filtered filtered = filter(parts, kinds, ratio);
  const double variance = filtered.scatter;
  const double wandering = ratio * variance;
  State& state = filtered.state;
  state.predict(ratio, made);
  found.offset = -state.level;
  found.offset_uncertainty = std::sqrt(state.level_variance * variance);
  found.wear = state.wear;
  found.scatter = std::sqrt(variance);
  found.dead_band = dead_band(state.wear, wandering, half_tolerance, cost);
  const double off = std::abs(state.level);
  const auto recent = static_cast<std::ptrdiff_t>(std::min(kRecent, kinds.size()));
  std::size_t jumps = 0;
  for (std::size_t i = kinds.size() - static_cast<std::size_t>(recent); i < kinds.size(); ++i) {
    if (kinds[i] == Kind::Outlier || (kinds[i] == Kind::Jump && !parts[i].has_new_tool)) ++jumps;
  }
  if (jumps > kMostJumps) {
    found.state = CompensationState::Unstable;
    found.reason = "more than two outliers or jumps among the last 50 values: find their cause";
  } else if (kinds.back() == Kind::Outlier) {
    found.reason = "the last value is an outlier: measure the next part";
    found.next_in = 1;
  } else if (off <= std::max(found.dead_band, kSure * found.offset_uncertainty)) {
    found.reason = off <= found.dead_band ? "the offset is within the dead band"
                                          : "the offset is not surely other than zero";
    found.next_in = parts_until(off * (state.level * state.wear < 0 ? -1 : 1),
                                state.level_variance * variance, std::abs(state.wear), wandering,
                                std::max(found.dead_band, kSure * found.offset_uncertainty));
  } else {
    found.state = CompensationState::Propose;
    found.reason = "the offset is beyond the dead band and surely other than zero";
    found.next_in = parts_until(0, state.level_variance * variance, std::abs(state.wear), wandering,
                                std::max(found.dead_band, kSure * found.offset_uncertainty));
  }
  return found;
}

}  // namespace fitgauge::metrology
