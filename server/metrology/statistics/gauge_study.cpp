#include "metrology/statistics/gauge_study.hpp"

#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

Error too_few(std::string message) { return {ErrorCode::StatisticsTooFew, std::move(message)}; }

/// The means of the cells of part and operator, each of one reading or more. Where their numbers
/// differ, sums of squares are those of unweighted means: of the means of the cells, times the
/// harmonic mean of the numbers of readings (Yates 1934; Burdick, Borror and Montgomery 2005). The
/// expected mean squares are those of a balanced study with so many trials.
class Cells {
 public:
  static Result<Cells> make(const Readings& readings) {
    if (readings.parts < 2) return too_few("a gauge study needs at least two parts");
    Cells cells(readings);
    TRY(cells.fill());
    if (moments(readings.values).squares == 0) {
      return Error{ErrorCode::StatisticsZeroSpread,
                   "all readings are equal: the gauge does not resolve the parts"};
    }
    return cells;
  }

  std::size_t parts() const { return readings_.parts; }
  std::size_t operators() const { return readings_.operator_count; }
  std::size_t count() const { return groups_.size(); }
  const std::vector<std::vector<Wide>>& groups() const { return groups_; }
  /// Returns the number of trials in a cell if all cells have equally many.
  std::optional<std::size_t> equal_trials() const {
    for (const auto& group : groups_) {
      if (group.size() != groups_.front().size()) return std::nullopt;
    }
    return groups_.front().size();
  }
  /// The harmonic mean of the readings of a cell.
  const Exact& trials() const { return trials_; }
  const Variation& error() const { return error_; }
  Variation total() const { return {readings_.part.size() - 1, between() + error_.sum_of_squares}; }

  /// Sums of squares between cells, between parts and between operators.
  Exact between() const {
    return squares(count(), [](std::size_t cell) { return cell; });
  }
  Exact between_parts() const {
    return squares(parts(), [this](std::size_t cell) { return cell % parts(); });
  }
  Exact between_operators() const {
    return squares(operators(), [this](std::size_t cell) { return cell / parts(); });
  }

  /// Readings of a part or an operator.
  std::vector<std::vector<Wide>> by(std::size_t number, const std::vector<std::size_t>& of) const {
    std::vector<std::vector<Wide>> groups(number);
    for (std::size_t i = 0; i < of.size(); ++i) {
      groups[of[i]].push_back(readings_.values.counts()[i]);
    }
    return groups;
  }
  const Readings& readings() const { return readings_; }
  long double in_units(const Integer& sum, std::size_t of) const {
    return nearest(Exact(sum, Integer(of)) / Exact(power_of_ten(readings_.values.scale())));
  }

 private:
  explicit Cells(const Readings& readings) : readings_(readings) {}

  Result<void> fill() {
    groups_.resize(parts() * std::max<std::size_t>(operators(), 1));
    for (std::size_t i = 0; i < readings_.part.size(); ++i) {
      const std::size_t by = readings_.operators.empty() ? 0 : readings_.operators[i];
      groups_[by * parts() + readings_.part[i]].push_back(readings_.values.counts()[i]);
    }
    Exact parts_of_one = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (groups_[i].empty()) {
        return Error{
            ErrorCode::StatisticsUnbalanced,
            fmt::format("operator {} has no reading of part {}: measure it, or remove the part",
                        i / parts() + 1, i % parts() + 1)};
      }
      const Moments of = moments(groups_[i], readings_.values.scale());
      means_.push_back(of.mean);
      error_.sum_of_squares += of.squares;
      parts_of_one += Exact(1) / whole(of.count);
    }
    error_.degrees_of_freedom = readings_.part.size() - count();
    trials_ = whole(count()) / parts_of_one;
    return {};
  }

  /// The sum of squares between groups of as many cells each.
  template <class Label>
  Exact squares(std::size_t number, const Label& label) const {
    std::vector<Exact> sums(number);
    Exact all = 0;
    for (std::size_t cell = 0; cell < count(); ++cell) {
      sums[label(cell)] += means_[cell];
      all += means_[cell];
    }
    Exact between = 0;
    for (const Exact& sum : sums) between += sum * sum;
    return trials_ * (between * whole(number) - all * all) / whole(count());
  }

  const Readings& readings_;
  std::vector<std::vector<Wide>> groups_;
  std::vector<Exact> means_;
  Exact trials_;
  Variation error_;
};

/// (above - below) / n, at least 0: a component of the variance.
Exact component(const Variation& above, const Variation& below, const Exact& n) {
  const Exact difference = above.mean_square() - below.mean_square();
  return difference > 0 ? Exact(difference / n) : Exact(0);
}

/// StudyBounds of components at a confidence: of one mean square exactly, of sums and differences
/// by modified large samples (Graybill and Wang 1980; Ting et al. 1990; Burdick and Graybill 1992).
class StudyBounds {
 public:
  using Interval = StudyIntervals::Interval;
  explicit StudyBounds(long double of) : confidence(of), tail_((1 - of) / 2) {}

  const long double confidence;

  struct Term {
    const Variation& of;
    Exact times;

    long double value() const { return nearest(times * of.mean_square()); }
    long double freedom() const { return static_cast<long double>(of.degrees_of_freedom); }
  };
  /// @param terms each above 0
  Interval sum(std::initializer_list<Term> terms) const {
    long double value = 0, below = 0, above = 0;
    for (const Term& term : terms) {
      value += term.value();
      below += std::pow(lower(term) * term.value(), 2.0L);
      above += std::pow(upper(term) * term.value(), 2.0L);
    }
    return of_variances(value - std::sqrt(below), value + std::sqrt(above));
  }
  Interval difference(const Variation& of, const Variation& less, const Exact& n) const {
    const Term a{of, 1 / n}, b{less, 1 / n};
    const auto square = [](long double x) { return x * x; };
    const auto room = [&](long double f, long double of_a, long double of_b) {
      const long double both = (square(f - 1) - square(of_a * f) - square(of_b)) / f;
      return std::sqrt(std::max(0.0L, square(of_a * a.value()) + square(of_b * b.value()) +
                                          both * a.value() * b.value()));
    };
    const long double value = a.value() - b.value();
    return of_variances(
        value - room(f_quantile(1 - tail_, a.freedom(), b.freedom()), lower(a), upper(b)),
        value + room(f_quantile(tail_, a.freedom(), b.freedom()), upper(a), lower(b)));
  }

 private:
  static Interval of_variances(long double lower, long double upper) {
    return {std::sqrt(std::max(0.0L, lower)), std::sqrt(std::max(0.0L, upper))};
  }
  long double lower(const Term& t) const {
    return 1 - t.freedom() / chi_squared_quantile(1 - tail_, t.freedom());
  }
  long double upper(const Term& t) const {
    return t.freedom() / chi_squared_quantile(tail_, t.freedom()) - 1;
  }

  long double tail_;
};

/// @param ratio sqrt(2) PV / GRR
void set_categories(GaugeStudy& study, long double ratio) {
  study.ndc = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(ratio)));
}

/// @param none a component that cannot be separated
void set_components(GaugeStudy& study, const Exact& ev, const std::optional<Exact>& av,
                    const std::optional<Exact>& interaction, const Exact& pv) {
  const Exact grr = ev + av.value_or(0) + interaction.value_or(0);
  study.ev = square_root(ev);
  if (av) study.av = square_root(*av);
  if (interaction) study.interaction = square_root(*interaction);
  study.grr = square_root(grr);
  study.pv = square_root(pv);
  study.tv = square_root(grr + pv);
  if (grr > 0) set_categories(study, square_root(2 * pv / grr));
}

Result<GaugeStudy> crossed(const Cells& s, StudyModel wanted, const StudyBounds& intervals) {
  const std::size_t p = s.parts();
  const std::size_t o = s.operators();
  const Exact& r = s.trials();
  const Variation part{p - 1, s.between_parts()};
  const Variation operators{o - 1, s.between_operators()};
  const Variation interaction{(p - 1) * (o - 1),
                              s.between() - part.sum_of_squares - operators.sum_of_squares};
  const Variation& error = s.error();
  const bool has_error = error.degrees_of_freedom > 0;

  GaugeStudy study;
  FTest of_interaction;
  if (has_error) of_interaction = f_test(interaction, error);
  study.interaction_p = of_interaction.p;
  if (wanted != StudyModel::Pooled && !has_error) {
    return too_few(
        "one trial cannot separate repeatability from the interaction of part and operator: "
        "measure every part at least twice, or use model \"pooled\", which counts both as "
        "repeatability");
  }
  if (wanted == StudyModel::Auto) {
    // Without a p there is nothing but repeatability to pool with.
    const bool pool = of_interaction.p > kPoolingProbability ||
                      (error.sum_of_squares == 0 && interaction.sum_of_squares == 0);
    wanted = pool ? StudyModel::Pooled : StudyModel::Interaction;
  }
  study.model = wanted;
  const bool is_pooled = wanted == StudyModel::Pooled;
  const Variation pooled{interaction.degrees_of_freedom + error.degrees_of_freedom,
                         interaction.sum_of_squares + error.sum_of_squares};
  const Variation& within = is_pooled ? pooled : error;
  const Variation& beside = is_pooled ? pooled : interaction;
  const Exact of_operators = whole(p) * r;
  study.anova = {{"part", part, f_test(part, beside)},
                 {"operator", operators, f_test(operators, beside)},
                 {"interaction", interaction, of_interaction},
                 {"repeatability", within, {}},
                 {"total", s.total(), {}}};
  if (is_pooled) study.anova.erase(study.anova.begin() + 2);
  set_components(study, within.mean_square(), component(operators, beside, of_operators),
                 is_pooled ? Exact(0) : component(interaction, error, r),
                 component(part, beside, whole(o) * r));
  if (within.sum_of_squares == 0) return study;
  const Exact share = 1 / of_operators;
  study.intervals = {intervals.confidence, intervals.sum({{within, 1}}),
                     intervals.difference(operators, beside, of_operators),
                     is_pooled ? intervals.sum({{operators, share}, {pooled, 1 - share}})
                               : intervals.sum({{operators, share},
                                                {interaction, whole(p - 1) * share},
                                                {error, 1 - 1 / r}})};
  return study;
}

GaugeStudy nested(const Cells& s, const StudyBounds& intervals) {
  const std::size_t p = s.parts();
  const std::size_t o = s.operators();
  const Exact& r = s.trials();
  const Variation operators{o - 1, s.between_operators()};
  const Variation part{o * (p - 1), s.between() - operators.sum_of_squares};
  const Variation& error = s.error();
  GaugeStudy study;
  study.anova = {{"operator", operators, f_test(operators, part)},
                 {"part", part, f_test(part, error)},
                 {"repeatability", error, {}},
                 {"total", s.total(), {}}};
  set_components(study, error.mean_square(), component(operators, part, whole(p) * r), std::nullopt,
                 component(part, error, r));
  if (error.sum_of_squares == 0) return study;
  study.intervals = {intervals.confidence, intervals.sum({{error, 1}}),
                     intervals.difference(operators, part, whole(p) * r)};
  return study;
}

GaugeStudy without_operators(const Cells& s, const StudyBounds& intervals) {
  const Variation part{s.parts() - 1, s.between_parts()};
  const Variation& error = s.error();
  GaugeStudy study;
  study.anova = {
      {"part", part, f_test(part, error)}, {"repeatability", error, {}}, {"total", s.total(), {}}};
  set_components(study, error.mean_square(), std::nullopt, std::nullopt,
                 component(part, error, s.trials()));
  if (error.sum_of_squares == 0) return study;
  const auto ev = intervals.sum({{error, 1}});
  study.intervals = {intervals.confidence, ev, {}, ev};
  return study;
}

/// d2 of a single range (Duncan 1955): 1 / K2 and 1 / K3 of MSA 4.
long double d2_of_one(std::size_t n) {
  const RangeConstants constants = range_constants(n);
  return std::hypot(constants.d2, constants.d3);
}

/// The range of the totals of groups of equal size, per reading.
long double range_of_means(const Cells& s, const std::vector<std::vector<Wide>>& groups) {
  std::vector<Integer> totals;
  for (const auto& group : groups) {
    ExactSum sum;
    for (const Wide value : group) sum.add(value);
    totals.push_back(sum.value());
  }
  const auto [low, high] = std::ranges::minmax_element(totals);
  return s.in_units(*high - *low, groups.front().size());
}

GaugeStudy average_and_range(const Cells& s, std::size_t trials) {
  ExactSum ranges;
  const auto& cells = s.groups();
  for (const auto& cell : cells) {
    const auto [low, high] = std::ranges::minmax_element(cell);
    ranges.add(*high - *low);
  }
  GaugeStudy study;
  study.ev = s.in_units(ranges.value(), cells.size()) / range_constants(trials).d2;
  const long double reproducibility =
      range_of_means(s, s.by(s.operators(), s.readings().operators)) / d2_of_one(s.operators());
  const long double readings = static_cast<long double>(s.parts() * trials);
  study.av =
      std::sqrt(std::max(0.0L, reproducibility * reproducibility - study.ev * study.ev / readings));
  study.grr = std::hypot(study.ev, study.av);
  study.pv = range_of_means(s, s.by(s.parts(), s.readings().part)) / d2_of_one(s.parts());
  study.tv = std::hypot(study.grr, study.pv);
  if (study.grr > 0) set_categories(study, std::sqrt(2.0L) * study.pv / study.grr);
  return study;
}

}  // namespace

Result<Type1Study> study_type1(const Decimals& values, const Exact& reference,
                               const Exact& tolerance, Type1Rule rule) {
  if (values.size() < 2) return too_few("a type 1 study needs at least two readings; 50 are usual");
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
  const Exact half = tolerance * rule.percent / 200;
  study.cg = nearest(half) * 2 / (rule.spread * study.standard_deviation);
  study.cgk = nearest(half - (bias < 0 ? Exact(-bias) : bias)) * 2 /
              (rule.spread * study.standard_deviation);
  return study;
}

Result<GaugeStudy> study_gauge(const Readings& readings, StudyMethod method, StudyModel model,
                               long double confidence) {
  if (method != StudyMethod::Type3 && readings.operator_count < 2) {
    return too_few("a gauge study needs at least two operators; method \"type3\" needs none");
  }
  const auto cells = TRY(Cells::make(readings));
  if (method != StudyMethod::Anova && cells.error().degrees_of_freedom == 0)
    return too_few("a gauge study needs at least two trials of every part");
  const StudyBounds intervals(confidence);
  switch (method) {
    case StudyMethod::Anova: return crossed(cells, model, intervals);
    case StudyMethod::Type3: return without_operators(cells, intervals);
    case StudyMethod::Nested: return nested(cells, intervals);
    case StudyMethod::AverageRange: break;
  }
  const auto trials = cells.equal_trials();
  if (trials) return average_and_range(cells, *trials);
  return Error{ErrorCode::StatisticsUnbalanced,
               "average_range needs the same number of readings of every part by every operator; "
               "method \"anova\" accepts different numbers"};
}

}  // namespace fitgauge::metrology
