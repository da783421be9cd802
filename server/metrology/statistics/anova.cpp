#include "metrology/statistics/anova.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "metrology/statistics/distributions.hpp"

namespace fitgauge::metrology {
namespace {

/// n times the sum of squared deviations from the mean of n values: a whole number.
Integer scatter_of(std::span<const Wide> counts) {
  ExactSum sum;
  ExactSum squares;
  for (const Wide count : counts) {
    const Wide deviation = count - counts.front();
    sum.add(deviation);
    squares.add_product(deviation, deviation);
  }
  const Integer total = sum.value();
  return Integer(counts.size()) * squares.value() - total * total;
}

/// The same in 128 bits, where no sum of a group is longer; else none.
std::optional<Wide> short_scatter_of(std::span<const Wide> counts) {
  constexpr std::size_t kFew = std::size_t{1} << 10;
  constexpr Wide kShort = Wide{1} << 40;
  if (counts.size() > kFew) return std::nullopt;
  Wide sum = 0;
  Wide squares = 0;
  for (const Wide count : counts) {
    const Wide deviation = count - counts.front();
    if (deviation <= -kShort || deviation >= kShort) return std::nullopt;
    sum += deviation;
    squares += deviation * deviation;
  }
  return static_cast<Wide>(counts.size()) * squares - sum * sum;
}

/// The sum of squared deviations from the means of the groups. Those of one size are added as whole
/// numbers: a fraction for each of many groups would take most of the time.
Exact sum_within(const GroupedCounts& groups) {
  struct Scatter {
    ExactSum of_short;
    Integer of_others = 0;
  };
  std::map<std::size_t, Scatter> scatter_by_size;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto group = groups[i];
    Scatter& scatter = scatter_by_size[group.size()];
    if (const auto found = short_scatter_of(group)) {
      scatter.of_short.add(*found);
    } else {
      scatter.of_others += scatter_of(group);
    }
  }
  const Integer unit = power_of_ten(groups.scale);
  Exact within = 0;
  for (const auto& [size, scatter] : scatter_by_size) {
    within += Exact(scatter.of_short.value() + scatter.of_others, Integer(size) * unit * unit);
  }
  return within;
}

}  // namespace

FTest f_test(const Variation& effect, const Variation& error) {
  if (error.sum_of_squares == 0) {
    return {.p = effect.sum_of_squares == 0 ? kUndefined : 0};  // F is beyond all numbers
  }
  const long double f = nearest(effect.mean_square() / error.mean_square());
  return {.f = f,
          .p = f_above(f, static_cast<long double>(effect.degrees_of_freedom),
                       static_cast<long double>(error.degrees_of_freedom))};
}

Result<Anova> analyse_variance(const GroupedCounts& groups) {
  if (groups.size() < 2) {
    return Error{ErrorCode::StatisticsTooFew,
                 "an analysis of variance compares two groups or more"};
  }
  const Moments all = moments(groups.counts, groups.scale);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].empty()) {
      return Error{ErrorCode::StatisticsTooFew, fmt::format("group {} is empty", i)};
    }
  }
  if (all.count == groups.size()) {
    return Error{ErrorCode::StatisticsTooFew,
                 "every group has one value: nothing says how they vary within a group"};
  }
  const Exact within = sum_within(groups);
  Anova anova;
  anova.between = {groups.size() - 1, all.squares - within};
  anova.within = {all.count - groups.size(), within};
  anova.test = f_test(anova.between, anova.within);
  if (all.squares != 0) anova.r_squared = nearest(anova.between.sum_of_squares / all.squares);
  anova.residual_standard_deviation = square_root(anova.within.mean_square());
  return anova;
}

}  // namespace fitgauge::metrology
