#include "metrology/statistics/capability.hpp"

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

/// Returns scatter_of() in 128 bits, if every sum of a group fits; else none.
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

/// Returns the sum of squared deviations from the means of the groups. Groups of one size are added
/// as whole numbers: fractions for many groups would take most of the time.
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

constexpr std::size_t kSizeOfValues = 5;
constexpr std::size_t kFewestGroups = 5;

struct Row {
  std::string_view word;
  std::string_view meaning;
};
constexpr std::array<Row, 8> kRows = {{
    {"A1", "location and dispersion constant, normal"},
    {"A2", "location and dispersion constant, not normal"},
    {"B", "location constant, dispersion changes"},
    {"C1", "location changes at random, all values together normal"},
    {"C2", "location changes at random, all values together not normal"},
    {"C3", "location has a trend, dispersion constant"},
    {"C4", "location changes from batch to batch, dispersion constant"},
    {"D", "location and dispersion change"},
}};

/// End of the groups of one size.
std::vector<std::size_t> ends_of(std::size_t groups, std::size_t size) {
  std::vector<std::size_t> ends(groups);
  for (std::size_t i = 0; i < groups; ++i) ends[i] = (i + 1) * size;
  return ends;
}

/// Returns the ends of groups of whole subgroups; single values are grouped.
std::vector<std::size_t> ends_of_groups(const Subgroups& data) {
  const std::size_t size = data.size > 1 ? data.size : kSizeOfValues;
  return ends_of(data.values.size() / size, size);
}

/// The median of an odd group is one of its values: its distance is always 0, and is left out
/// (Hines and Hines 2000; Noguchi and Gel 2010).
std::size_t structural_zeros(std::size_t size) { return size % 2; }

/// Distances from the median of their group, doubled so that they stay whole numbers.
std::vector<Wide> distances_from_medians(const GroupedCounts& groups) {
  std::vector<Wide> distances;
  distances.reserve(groups.counts.size());
  std::vector<Wide> sorted;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto group = groups[i];
    sorted.assign(group.begin(), group.end());
    std::ranges::sort(sorted);
    const Wide twice = sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2];
    std::size_t left_out = structural_zeros(group.size());
    for (const Wide value : group) {
      if (left_out > 0 && 2 * value == twice) {
        --left_out;
        continue;
      }
      distances.push_back(2 * value > twice ? 2 * value - twice : twice - 2 * value);
    }
  }
  return distances;
}

/// Returns the probability that the dispersion changes this much from group to group by chance
/// (Brown and Forsythe 1974). Undefined for groups of two, whose two distances are always equal.
long double dispersion_test(const GroupedCounts& groups) {
  const std::size_t size = groups[0].size();
  if (size < 3) return kUndefined;
  const std::vector<Wide> distances = distances_from_medians(groups);
  const auto ends = ends_of(groups.size(), size - structural_zeros(size));
  return analyse_variance({distances, groups.scale, ends}).value().test.p;
}

/// Whether the means rise or fall with their index: the probability of so steep a slope by chance;
/// and their r(1), which shows batches.
struct Course {
  long double trend = kUndefined;
  double autocorrelation = 0;
};
Course course_of(const GroupedCounts& groups) {
  const std::size_t n = groups.size();
  const long double unit = nearest(Exact(power_of_ten(groups.scale)));
  std::vector<double> means;
  means.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    long double sum = 0;
    for (const Wide value : groups[i]) sum += static_cast<long double>(value);
    means.push_back(static_cast<double>(sum / static_cast<long double>(groups[i].size()) / unit));
  }
  const auto count = static_cast<double>(n);
  double mean = 0;
  for (const double value : means) mean += value / count;
  const double middle = (count - 1) / 2;
  double xx = 0;
  double xy = 0;
  double yy = 0;
  double neighbours = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) - middle;
    const double y = means[i] - mean;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    if (i > 0) neighbours += y * (means[i - 1] - mean);
  }
  if (yy == 0) return {};
  const double unexplained = std::max(0.0, 1 - xy * xy / (xx * yy));
  const double t = std::sqrt(xy * xy / (xx * yy) / unexplained * (count - 2));
  return {.trend = t_beyond(t, count - 2), .autocorrelation = neighbours / yy};
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
    return Error{ErrorCode::StatisticsTooFew, "an analysis of variance needs at least two groups"};
  }
  const Moments all = moments(groups.counts, groups.scale);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].empty()) {
      return Error{ErrorCode::StatisticsTooFew, fmt::format("group {} is empty", i)};
    }
  }
  if (all.count == groups.size()) {
    return Error{ErrorCode::StatisticsTooFew,
                 "every group has one value: a group with two values or more is needed"};
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

std::string_view word(ProcessModel model) { return kRows[static_cast<std::size_t>(model)].word; }
std::string_view meaning(ProcessModel model) {
  return kRows[static_cast<std::size_t>(model)].meaning;
}

std::optional<ModelChoice> choose_model(const Subgroups& data, bool normal) {
  const std::vector<std::size_t> ends = ends_of_groups(data);
  const int scale = data.values.scale();
  if (ends.size() < kFewestGroups) return std::nullopt;
  const GroupedCounts groups{data.values.counts().first(ends.back()), scale, ends};
  ModelChoice choice;
  const Course course = course_of(groups);
  choice.tests.trend = course.trend;
  choice.tests.subgroup_size = groups[0].size();
  choice.tests.location = analyse_variance(groups).value().test.p;
  choice.tests.dispersion = dispersion_test(groups);
  // An undefined probability (no spread within) is not below the significance.
  const bool moves = choice.tests.location < kModelSignificance;
  const bool widens = choice.tests.dispersion < kModelSignificance;
  // Two standard errors of the r(1) of a random series.
  const double random_bound = 2 / std::sqrt(static_cast<double>(ends.size()));
  if (moves && widens) {
    choice.model = ProcessModel::D;
  } else if (widens) {
    choice.model = ProcessModel::B;
  } else if (!moves) {
    choice.model = normal ? ProcessModel::A1 : ProcessModel::A2;
  } else if (choice.tests.trend < kModelSignificance) {
    choice.model = ProcessModel::C3;
  } else if (course.autocorrelation > random_bound) {
    choice.model = ProcessModel::C4;
  } else {
    choice.model = normal ? ProcessModel::C1 : ProcessModel::C2;
  }
  return choice;
}

}  // namespace fitgauge::metrology
