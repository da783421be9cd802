#include "metrology/statistics/gauge_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "metrology/statistics/summary.hpp"
#include "metrology/statistics/zone_rules.hpp"

namespace fitgauge::metrology {
namespace {

constexpr std::array<std::pair<std::string_view, StudyMethod>, 4> kMethods = {{
    {"anova", StudyMethod::Anova},
    {"average_range", StudyMethod::AverageRange},
    {"type3", StudyMethod::Type3},
    {"nested", StudyMethod::Nested},
}};
constexpr std::array<std::pair<std::string_view, StudyModel>, 3> kModels = {{
    {"auto", StudyModel::Auto},
    {"interaction", StudyModel::Interaction},
    {"pooled", StudyModel::Pooled},
}};

Error too_few(std::string message) { return {ErrorCode::StatisticsTooFew, std::move(message)}; }

/// A balanced study: every cell of part and operator holds the same number of readings.
class Balanced {
 public:
  static Result<Balanced> make(const Readings& readings) {
    if (readings.parts < 2) return too_few("a gauge study takes two parts or more");
    Balanced study(readings);
    if (const auto counted = study.count_trials(); !counted) return counted.error();
    if (moments(readings.values).squares == 0) {
      return Error{ErrorCode::StatisticsZeroSpread,
                   "all readings are equal: the gauge does not tell the parts apart"};
    }
    return study;
  }

  std::size_t parts() const { return readings_.parts; }
  std::size_t operators() const { return readings_.operator_count; }
  std::size_t trials() const { return trials_; }
  Exact total() const { return moments(readings_.values).squares; }

  std::size_t part(std::size_t i) const { return readings_.part[i]; }
  std::size_t operator_of(std::size_t i) const {
    return readings_.operators.empty() ? 0 : readings_.operators[i];
  }
  std::size_t cell(std::size_t i) const { return operator_of(i) * parts() + part(i); }

  /// Readings by a label of theirs below `count`.
  template <class Label>
  std::vector<std::vector<Wide>> by(std::size_t count, const Label& label) const {
    std::vector<std::vector<Wide>> groups(count);
    const auto counts = readings_.values.counts();
    for (std::size_t i = 0; i < counts.size(); ++i) groups[label(i)].push_back(counts[i]);
    return groups;
  }
  std::vector<std::vector<Wide>> cells() const {
    auto groups = by(parts() * std::max<std::size_t>(operators(), 1),
                     [this](std::size_t i) { return cell(i); });
    return groups;
  }

  /// The sum of squares between groups: of their totals, less that of all.
  Exact between(const std::vector<std::vector<Wide>>& groups) const {
    Exact within = 0;
    for (const auto& group : groups) within += moments(group, scale()).squares;
    return total() - within;
  }
  Exact between_parts() const {
    return between(by(parts(), [this](std::size_t i) { return part(i); }));
  }
  Exact between_operators() const {
    return between(by(operators(), [this](std::size_t i) { return operator_of(i); }));
  }

  int scale() const { return readings_.values.scale(); }
  long double in_units(const Integer& sum, std::size_t of) const {
    return nearest(Exact(sum, Integer(of)) / Exact(power_of_ten(scale())));
  }

 private:
  explicit Balanced(const Readings& readings) : readings_(readings) {}

  Result<void> count_trials() {
    const auto groups = cells();
    trials_ = groups.front().size();
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (groups[i].size() == trials_ && trials_ > 0) continue;
      return Error{ErrorCode::StatisticsUnbalanced,
                   fmt::format("every operator measures every part equally often: operator {} has "
                               "{} readings of part {}, others have {}",
                               i / parts() + 1, groups[i].size(), i % parts() + 1, trials_)};
    }
    return {};
  }

  const Readings& readings_;
  std::size_t trials_ = 0;
};

/// (above - below) / n, at least 0: a component of the variance.
Exact component(const Variation& above, const Variation& below, std::size_t n) {
  const Exact difference = above.mean_square() - below.mean_square();
  return difference > 0 ? difference / whole(n) : Exact(0);
}

void set_categories(GaugeStudy& study) {
  if (study.grr == 0) return;
  const long double ratio = std::floor(std::sqrt(2.0L) * study.pv / study.grr);
  study.ndc = std::max<std::int64_t>(1, static_cast<std::int64_t>(ratio));
}

/// @param none a component that is not told apart
void set_components(GaugeStudy& study, const Exact& ev, const std::optional<Exact>& av,
                    const std::optional<Exact>& interaction, const Exact& pv) {
  const Exact grr = ev + av.value_or(0) + interaction.value_or(0);
  study.ev = square_root(ev);
  if (av) study.av = square_root(*av);
  if (interaction) study.interaction = square_root(*interaction);
  study.grr = square_root(grr);
  study.pv = square_root(pv);
  study.tv = square_root(grr + pv);
  set_categories(study);
}

Result<GaugeStudy> crossed(const Balanced& s, StudyModel wanted) {
  const std::size_t p = s.parts();
  const std::size_t o = s.operators();
  const std::size_t r = s.trials();
  const Variation part{p - 1, s.between_parts()};
  const Variation operators{o - 1, s.between_operators()};
  const Exact cells = s.between(s.cells());
  const Variation interaction{(p - 1) * (o - 1),
                              cells - part.sum_of_squares - operators.sum_of_squares};
  const Variation error{p * o * (r - 1), s.total() - cells};
  const Variation total{p * o * r - 1, s.total()};

  GaugeStudy study;
  FTest of_interaction;
  if (r > 1) of_interaction = f_test(interaction, error);
  study.interaction_p = of_interaction.p;
  if (wanted != StudyModel::Pooled && r == 1) {
    return too_few(
        "one trial does not tell the repeatability from the interaction of part and operator: "
        "measure every part twice or more, or say model \"pooled\", which takes there to be no "
        "interaction and calls all of it repeatability");
  }
  if (wanted == StudyModel::Auto) {
    // Without a p there is nothing but repeatability to pool with.
    const bool pool = of_interaction.p > kPoolingProbability ||
                      (error.sum_of_squares == 0 && interaction.sum_of_squares == 0);
    wanted = pool ? StudyModel::Pooled : StudyModel::Interaction;
  }
  study.model = wanted;
  if (wanted == StudyModel::Interaction) {
    study.anova = {{"part", part, f_test(part, interaction)},
                   {"operator", operators, f_test(operators, interaction)},
                   {"interaction", interaction, of_interaction},
                   {"repeatability", error, {}},
                   {"total", total, {}}};
    set_components(study, error.mean_square(), component(operators, interaction, p * r),
                   component(interaction, error, r), component(part, interaction, o * r));
  } else {
    const Variation pooled{interaction.degrees_of_freedom + error.degrees_of_freedom,
                           interaction.sum_of_squares + error.sum_of_squares};
    study.anova = {{"part", part, f_test(part, pooled)},
                   {"operator", operators, f_test(operators, pooled)},
                   {"repeatability", pooled, {}},
                   {"total", total, {}}};
    set_components(study, pooled.mean_square(), component(operators, pooled, p * r), Exact(0),
                   component(part, pooled, o * r));
  }
  return study;
}

GaugeStudy nested(const Balanced& s) {
  const std::size_t p = s.parts();
  const std::size_t o = s.operators();
  const std::size_t r = s.trials();
  const Exact cells = s.between(s.cells());
  const Variation operators{o - 1, s.between_operators()};
  const Variation part{o * (p - 1), cells - operators.sum_of_squares};
  const Variation error{p * o * (r - 1), s.total() - cells};
  GaugeStudy study;
  study.anova = {{"operator", operators, f_test(operators, part)},
                 {"part", part, f_test(part, error)},
                 {"repeatability", error, {}},
                 {"total", {p * o * r - 1, s.total()}, {}}};
  set_components(study, error.mean_square(), component(operators, part, p * r), std::nullopt,
                 component(part, error, r));
  return study;
}

GaugeStudy without_operators(const Balanced& s) {
  const std::size_t p = s.parts();
  const std::size_t r = s.trials();
  const Variation part{p - 1, s.between_parts()};
  const Variation error{p * (r - 1), s.total() - part.sum_of_squares};
  GaugeStudy study;
  study.anova = {{"part", part, f_test(part, error)},
                 {"repeatability", error, {}},
                 {"total", {p * r - 1, s.total()}, {}}};
  set_components(study, error.mean_square(), std::nullopt, std::nullopt, component(part, error, r));
  return study;
}

/// d2 of one range alone (Duncan 1955): what 1 / K2 and 1 / K3 of MSA 4 are.
long double d2_of_one(std::size_t n) {
  const RangeConstants constants = range_constants(n);
  return std::hypot(constants.d2, constants.d3);
}

/// The range of the totals of groups of equal size, per reading.
long double range_of_means(const Balanced& s, const std::vector<std::vector<Wide>>& groups) {
  std::vector<Integer> totals;
  for (const auto& group : groups) {
    ExactSum sum;
    for (const Wide value : group) sum.add(value);
    totals.push_back(sum.value());
  }
  const auto [low, high] = std::minmax_element(totals.begin(), totals.end());
  return s.in_units(*high - *low, groups.front().size());
}

GaugeStudy average_and_range(const Balanced& s) {
  ExactSum ranges;
  const auto cells = s.cells();
  for (const auto& cell : cells) {
    const auto [low, high] = std::minmax_element(cell.begin(), cell.end());
    ranges.add(*high - *low);
  }
  GaugeStudy study;
  study.ev = s.in_units(ranges.value(), cells.size()) / range_constants(s.trials()).d2;
  const long double reproducibility =
      range_of_means(s, s.by(s.operators(), [&](std::size_t i) { return s.operator_of(i); })) /
      d2_of_one(s.operators());
  const long double readings = static_cast<long double>(s.parts() * s.trials());
  study.av =
      std::sqrt(std::max(0.0L, reproducibility * reproducibility - study.ev * study.ev / readings));
  study.grr = std::hypot(study.ev, study.av);
  study.pv = range_of_means(s, s.by(s.parts(), [&](std::size_t i) { return s.part(i); })) /
             d2_of_one(s.parts());
  study.tv = std::hypot(study.grr, study.pv);
  set_categories(study);
  return study;
}

template <class Enum, std::size_t n>
std::optional<Enum> from_word(const std::array<std::pair<std::string_view, Enum>, n>& words,
                              std::string_view text) {
  for (const auto& [name, value] : words) {
    if (name == text) return value;
  }
  return std::nullopt;
}

}  // namespace

std::optional<StudyMethod> study_method_from_word(std::string_view text) {
  return from_word(kMethods, text);
}
std::string_view word(StudyMethod method) {
  return kMethods[static_cast<std::size_t>(method)].first;
}
std::string_view word(StudyModel model) { return kModels[static_cast<std::size_t>(model)].first; }

Result<Type1Study> study_type1(const Decimals& values, const Exact& reference,
                               const Exact& tolerance) {
  if (values.size() < 2) return too_few("a type 1 study takes two readings or more; 50 are usual");
  if (tolerance <= 0) return Error{ErrorCode::LimitsInvalid, "the tolerance must be above 0"};
  const Moments of = moments(values);
  if (of.squares == 0) {
    return Error{ErrorCode::StatisticsZeroSpread,
                 "all readings are equal: the resolution of the gauge is too coarse for Cg"};
  }
  Type1Study study;
  study.count = of.count;
  study.mean = nearest(of.mean);
  study.standard_deviation = of.standard_deviation();
  const Exact bias = of.mean - reference;
  study.bias = nearest(bias);
  study.t = study.bias / study.standard_deviation * std::sqrt(static_cast<long double>(of.count));
  study.p = t_beyond(study.t, static_cast<long double>(of.count - 1));
  study.cg = nearest(tolerance / 5) / (6 * study.standard_deviation);
  study.cgk =
      nearest(tolerance / 10 - (bias < 0 ? Exact(-bias) : bias)) / (3 * study.standard_deviation);
  return study;
}

Result<GaugeStudy> study_gauge(const Readings& readings, StudyMethod method, StudyModel model) {
  if (method != StudyMethod::Type3 && readings.operator_count < 2) {
    return too_few("a gauge study takes two operators or more; method \"type3\" takes none");
  }
  const auto study = Balanced::make(readings);
  if (!study) return study.error();
  if (method != StudyMethod::Anova && study->trials() < 2) {
    return too_few("a gauge study takes two trials of every part or more");
  }
  switch (method) {
    case StudyMethod::Anova: return crossed(*study, model);
    case StudyMethod::AverageRange: return average_and_range(*study);
    case StudyMethod::Type3: return without_operators(*study);
    case StudyMethod::Nested: break;
  }
  return nested(*study);
}

}  // namespace fitgauge::metrology
