#pragma once

#include "metrology/statistics/capability.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

/// Repeatability of one gauge on one master (Bosch Booklet 10, 4.1; ISO 22514-7:2021).
struct Type1Study {
  std::size_t count = 0;
  long double mean = 0;
  long double standard_deviation = 0;
  long double bias = 0;  ///< mean - reference
  long double t = 0;     ///< of the bias, n - 1 degrees of freedom
  long double p = 0;
  long double cg = 0;   ///< 0.2 T / (6 s)
  long double cgk = 0;  ///< (0.1 T - |bias|) / (3 s)
};

/// The comparison of Cg: a part of the tolerance and a number of standard deviations.
struct Type1Rule {
  int percent = 20;
  int spread = 6;
};

/// @param tolerance above 0
/// @errors StatisticsTooFew with one value; StatisticsZeroSpread; LimitsInvalid: the tolerance.
Result<Type1Study> study_type1(const Decimals& values, const Exact& reference,
                               const Exact& tolerance, Type1Rule rule = {});

/// Readings of parts by operators. Labels are numbers from 0 in the order of their first use.
struct Readings {
  Decimals values;
  std::vector<std::size_t> part;
  std::vector<std::size_t> operators;  ///< empty: a study without operators
  std::size_t parts = 0;
  std::size_t operator_count = 0;
};

enum class StudyMethod : std::uint8_t { Anova, AverageRange, Type3, Nested };
inline constexpr std::string_view kStudyWords[] = {"anova", "average_range", "type3", "nested"};
constexpr std::string_view word(StudyMethod method) { return word_of(method, kStudyWords); }
constexpr std::optional<StudyMethod> study_method_from_word(std::string_view text) {
  return enum_of<StudyMethod>(text, kStudyWords);
}

enum class StudyModel : std::uint8_t { Auto, Interaction, Pooled };
constexpr std::string_view word(StudyModel model) {
  return word_of(model, {"auto", "interaction", "pooled"});
}

/// `Auto` pools the interaction with the repeatability above this probability.
inline constexpr double kPoolingProbability = 0.25;

struct AnovaLine {
  std::string_view name;
  Variation variation;
  FTest test;
};

/// Intervals of standard deviations.
struct StudyIntervals {
  struct Interval {
    long double lower = 0;
    long double upper = 0;
  };
  long double confidence = 0;
  Interval ev;
  std::optional<Interval> av{};   ///< with operators
  std::optional<Interval> grr{};  ///< not of Nested
};

/// Standard deviations; kUndefined for a component that the method cannot separate.
struct GaugeStudy {
  long double ev = kUndefined;           ///< equipment: repeatability
  long double av = kUndefined;           ///< appraiser: reproducibility
  long double interaction = kUndefined;  ///< of part and operator
  long double grr = 0;
  long double pv = 0;  ///< part
  long double tv = 0;  ///< total
  /// Number of distinct categories: the whole part of sqrt(2) pv / grr, at least 1; none if grr is
  /// 0.
  std::optional<std::int64_t> ndc{};
  std::optional<StudyModel> model{};  ///< of Anova: Interaction or Pooled
  long double interaction_p = kUndefined;
  std::vector<AnovaLine> anova{};             ///< of all but AverageRange, the total last
  std::optional<StudyIntervals> intervals{};  ///< absent for AverageRange and without repeatability
};

/// Numbers of readings may differ: the components are those of unweighted means.
/// @param confidence of the intervals, between 0 and 1
/// @errors StatisticsTooFew: fewer than two parts, operators or, where they are needed, trials;
///   StatisticsUnbalanced: a part that an operator did not measure, of AverageRange another number
///   of readings; StatisticsZeroSpread.
Result<GaugeStudy> study_gauge(const Readings& readings, StudyMethod method, StudyModel model,
                               long double confidence = 0.95L);

/// Bias over the measuring range: the regression of every reading's bias on its reference
/// (MSA 4, III-B). Standard errors for tests of t with n - 2 degrees of freedom.
struct LinearityStudy {
  struct Coefficient {
    long double value = 0;
    long double standard_error = kUndefined;
    long double p = kUndefined;
  };
  struct Bias {
    long double reference = 0;
    std::size_t count = 0;
    long double bias = 0;
    long double p = kUndefined;  ///< that the bias is 0, from its readings
  };
  Coefficient slope;
  Coefficient intercept;
  long double r_squared = kUndefined;
  long double residual_standard_deviation = kUndefined;
  long double average_bias = 0;
  std::vector<Bias> references;  ///< ascending
};

/// @param references of each value @pre as many as values
/// @errors StatisticsTooFew: fewer than two references, or three readings.
Result<LinearityStudy> study_linearity(const Decimals& values,
                                       const std::vector<Exact>& references);

/// Ratings of parts by operators, in the order of their trials. Labels are small numbers from 0.
struct Ratings {
  std::vector<std::size_t> part{};
  std::vector<std::size_t> operators{};
  std::vector<std::size_t> category{};
  std::size_t parts = 0;
  std::size_t categories = 0;
  std::vector<std::string> names{};      ///< of the operators
  std::vector<std::size_t> reference{};  ///< the right category of each part; empty: unknown
  std::optional<std::size_t> good{};     ///< the category of parts that are accepted
};

/// A share of parts, with the 95 % interval of Clopper and Pearson 1934.
struct AttributeShare {
  std::size_t count = 0;
  std::size_t of = 0;
  long double lower = 0;
  long double upper = 1;
};

/// Agreement of ratings (AIAG MSA 4, III-C). A kappa without chance of disagreement is kUndefined.
struct AttributeStudy {
  struct Operator {
    std::string name{};
    AttributeShare consistent{};                    ///< parts with equal ratings in all trials
    long double within = kUndefined;                ///< kappa of the trials: Fleiss 1971
    std::optional<AttributeShare> effectiveness{};  ///< parts rated right in all trials
    long double reference = kUndefined;             ///< kappa with the reference: Cohen 1960
    std::optional<AttributeShare> misses{};         ///< ratings of bad parts that are good
    std::optional<AttributeShare> false_alarms{};   ///< ratings of good parts that are not
  };
  struct Pair {
    std::array<std::string, 2> names{};
    long double kappa = kUndefined;  ///< of the same trials: Cohen
  };
  std::vector<Operator> operators{};
  std::vector<Pair> pairs{};
  long double between = kUndefined;  ///< kappa of all ratings: Fleiss
  AttributeShare alike{};            ///< parts with equal ratings in all trials
  std::optional<AttributeShare> right{};
};
inline constexpr std::size_t kMostOperators = 50;

/// @errors StatisticsTooFew: fewer than two parts or operators; StatisticsTooMany: operators;
///   StatisticsUnbalanced: a part that was not rated as often by each operator.
Result<AttributeStudy> study_attributes(const Ratings& ratings);

/// Components of the uncertainty of a measuring process (ISO 22514-7; VDA 5). The first ones, up to
/// MsRest, belong to the measuring system.
enum class Component : std::uint8_t {  // clang-format off
  Cal, Re, Bi, Lin, Evr, MsRest, Evo, Av, Ia, Gv, Stab, T, Obj, MpRest };  // clang-format on

/// The source of a component: a `Master` study, a study of `Parts`, or neither.
enum class ComponentOf : std::uint8_t { Given, Master, Parts };
struct ComponentRow {
  std::string_view name;
  ComponentOf of;
  std::string_view meaning;
};
inline constexpr std::array<ComponentRow, 14> kComponents = {{
    {"u_cal", ComponentOf::Given, "Calibration of the master, U/k of its certificate"},
    {"u_re", ComponentOf::Master, "Resolution/√12"},
    {"u_bi", ComponentOf::Master, "Bias on the master/√3"},
    {"u_lin", ComponentOf::Given, "Linearity"},
    {"u_evr", ComponentOf::Master, "Repeatability on the master"},
    {"u_ms_rest", ComponentOf::Given, "Other contributions of the measuring system"},
    {"u_evo", ComponentOf::Parts, "Repeatability on parts"},
    {"u_av", ComponentOf::Parts, "Operators"},
    {"u_ia", ComponentOf::Parts, "Interaction of part and operator"},
    {"u_gv", ComponentOf::Given, "Gauges of one kind"},
    {"u_stab", ComponentOf::Given, "Stability over time"},
    {"u_t", ComponentOf::Given, "Temperature"},
    {"u_obj", ComponentOf::Given, "Form of the part"},
    {"u_mp_rest", ComponentOf::Given, "Other contributions of the measuring process"},
}};

/// Standard uncertainties in the unit of the readings; absent: no part of it.
struct MeasuringProcess {
  std::array<std::optional<double>, kComponents.size()> components{};

  std::optional<double>& operator[](Component of) {
    return components.at(static_cast<std::size_t>(of));
  }
  const std::optional<double>& operator[](Component of) const {
    return components.at(static_cast<std::size_t>(of));
  }
  /// u_MS and u_MP: the root of the sum of squares. Only the largest of u_EVR and u_RE, for the
  /// process of u_EVR, u_EVO and u_RE, counts (ISO 22514-7:2012, A.3).
  double system() const { return combined(Component::MsRest); }
  double process() const { return combined(Component::MpRest); }

 private:
  double combined(Component last) const {
    double variance = 0, repeatability = 0;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(last); ++i) {
      const double u = components.at(i).value_or(0);
      const auto of = static_cast<Component>(i);
      const bool repeats = of == Component::Re || of == Component::Evr || of == Component::Evo;
      repeats ? repeatability = std::max(repeatability, u) : variance += u * u;
    }
    return std::sqrt(variance + repeatability * repeatability);
  }
};

/// Capability of a standard uncertainty u of a system or a process (ISO 22514-7, clause 9).
struct MeasuringCapability {
  MeasuringCapability(double u, double tolerance, bool is_process)
      : percent(400 * u / tolerance),
        index(0.3 * tolerance / ((is_process ? 3 : 6) * u)),
        least_tolerance(4 * u / (is_process ? 0.30 : 0.15)) {}

  double percent;          ///< Q: 2 k u/T with k = 2
  double index;            ///< C: 0.3 T/(6 u), of a process 0.3 T/(3 u)
  double least_tolerance;  ///< with Q of 15 %, of a process of 30 %
};

}  // namespace fitgauge::metrology
