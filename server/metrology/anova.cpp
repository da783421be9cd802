#include "metrology/anova.hpp"

#include <fmt/format.h>

#include "metrology/distributions.hpp"

namespace fitgauge::metrology {

FTest f_test(const Variation& effect, const Variation& error) {
  if (error.sum_of_squares == 0) return {};
  const long double f = nearest(effect.mean_square() / error.mean_square());
  return {.f = f,
          .p = f_above(f, static_cast<long double>(effect.degrees_of_freedom),
                       static_cast<long double>(error.degrees_of_freedom))};
}

Result<Anova> analyse_variance(const Groups& groups) {
  if (groups.size() < 2) {
    return Error{ErrorCode::StatisticsTooFew,
                 "an analysis of variance compares two groups or more"};
  }
  const Moments all = moments(groups.values);
  Exact within = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].empty()) {
      return Error{ErrorCode::StatisticsTooFew, fmt::format("group {} is empty", i)};
    }
    within += moments(groups[i], groups.values.scale()).squares;
  }
  if (all.count == groups.size()) {
    return Error{ErrorCode::StatisticsTooFew,
                 "every group has one value: nothing says how they vary within a group"};
  }
  Anova anova;
  anova.between = {groups.size() - 1, all.squares - within};
  anova.within = {all.count - groups.size(), within};
  anova.test = f_test(anova.between, anova.within);
  if (all.squares != 0) anova.r_squared = nearest(anova.between.sum_of_squares / all.squares);
  anova.residual_standard_deviation = square_root(anova.within.mean_square());
  return anova;
}

}  // namespace fitgauge::metrology
