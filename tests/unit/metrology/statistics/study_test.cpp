#include "metrology/statistics/gauge_study.hpp"
#include "support.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;
using doctest::Approx;

namespace {

/// The study of AIAG, Measurement Systems Analysis, 4th edition, table III-B 6: three appraisers,
/// ten parts, three trials.
Readings msa4() {
  Readings readings;
  readings.values = decimals(reference_set("msa.study"));
  for (std::size_t i = 0; i < readings.values.size(); ++i) {
    readings.part.push_back(i % 10);
    readings.operators.push_back(i / 30);
  }
  readings.parts = 10;
  readings.operator_count = 3;
  return readings;
}

/// A crossed study of two parts, two operators and two trials.
Readings small(const std::string& values) {
  return {.values = decimals(values),
          .part = {0, 0, 1, 1, 0, 0, 1, 1},
          .operators = {0, 0, 0, 0, 1, 1, 1, 1},
          .parts = 2,
          .operator_count = 2};
}

double number(long double value) { return static_cast<double>(value); }

/// Thermal impedance of power modules (Houf and Berman 1988; Burdick, Borror and Montgomery 2003):
/// ten parts, three operators, three trials. @param left_out pairs of part and line
Readings thermal_impedance(const std::vector<std::pair<std::size_t, std::size_t>>& left_out = {}) {
  const Decimals all = decimals(
      "37 42 30 42 28 42 25 40 25 35  38 41 31 43 30 42 26 40 25 34  37 43 31 42 29 43 27 40 25 34 "
      "41 42 31 43 29 45 28 43 27 35  41 42 31 43 30 45 28 42 29 35  40 42 31 43 29 45 30 42 28 34 "
      "41 43 29 42 31 44 29 43 26 35  42 42 30 42 29 46 27 43 26 34  41 43 28 42 29 45 27 41 26 "
      "35");
  Readings readings{.values = {}, .part = {}, .operators = {}, .parts = 10, .operator_count = 3};
  std::vector<Wide> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::pair<std::size_t, std::size_t> at{i % 10, i / 10};
    if (std::find(left_out.begin(), left_out.end(), at) != left_out.end()) continue;
    kept.push_back(all.counts()[i]);
    readings.part.push_back(at.first);
    readings.operators.push_back(at.second / 3);
  }
  readings.values = Decimals(std::move(kept), 0);
  return readings;
}

struct Bounds {
  double lower;
  double upper;
};
void check_interval(const std::optional<StudyIntervals::Interval>& found, Bounds wanted) {
  REQUIRE(found.has_value());
  CHECK(number(found->lower) == Approx(wanted.lower).epsilon(1e-12).scale(0));
  CHECK(number(found->upper) == Approx(wanted.upper).epsilon(1e-12).scale(0));
}

}  // namespace

TEST_CASE("intervals of a crossed study: exact, and by modified large samples") {
  const GaugeStudy study =
      study_gauge(thermal_impedance(), StudyMethod::Anova, StudyModel::Interaction).value();
  // Squared these are 0.3682 to 0.7575, 0.0730 to 25.7508 and 1.2062 to 27.0172, as another program
  // has them; the digits are of mpmath.
  REQUIRE(study.intervals.has_value());
  check_interval(study.intervals->ev, {0.606759866134805333, 0.870369487452308735});
  check_interval(study.intervals->av, {0.270113910880418562, 5.07452161294826055});
  check_interval(study.intervals->grr, {1.09828301181571884, 5.19781096589611711});
  CHECK(number(study.ev * study.ev) == Approx(0.51111111111));
  CHECK(number(study.av * study.av) == Approx(0.56460905350));
  CHECK(number(study.interaction * study.interaction) == Approx(0.72798353909));
  CHECK_FALSE(study_gauge(thermal_impedance(), StudyMethod::AverageRange, StudyModel::Auto)
                  .value()
                  .intervals.has_value());
  const GaugeStudy nested =
      study_gauge(thermal_impedance(), StudyMethod::Nested, StudyModel::Auto).value();
  CHECK_FALSE(nested.intervals->grr.has_value());
}

TEST_CASE("a study with missing trials: unweighted means") {
  // Growth hormone (Neter et al., Applied Linear Statistical Models, unequal sample sizes): its
  // table has 0.1200 between the two genders and 1.3000 within; for two levels unweighted means
  // and tests of type III are one. The rest is computed by hand.
  const Readings growth{
      .values = decimals("1.4 2.4 2.2 2.1 1.7 0.7 1.1 2.4 2.5 1.8 2.0 0.5 0.9 1.3"),
      .part = {0, 0, 0, 1, 1, 2, 2, 0, 1, 1, 1, 2, 2, 2},
      .operators = {0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1},
      .parts = 3,
      .operator_count = 2};
  const GaugeStudy hormone =
      study_gauge(growth, StudyMethod::Anova, StudyModel::Interaction).value();
  const Exact squares[] = {Exact(392, 100), Exact(12, 100), Exact(8, 100), Exact(13, 10),
                           Exact(542, 100)};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(hormone.anova[i].variation.sum_of_squares == squares[i]);
  }
  CHECK(hormone.anova.back().variation.degrees_of_freedom == 13);
  CHECK(hormone.av == square_root(Exact(8, 100) / 6));  // harmonic mean of the trials: 2
  CHECK(hormone.pv == square_root(Exact(192, 100) / 4));

  // 86 of 90 readings, computed with the fractions and mpmath of Python.
  const Readings most = thermal_impedance({{0, 2}, {3, 3}, {3, 4}, {9, 8}});
  const GaugeStudy study =
      study_gauge(most, StudyMethod::Anova, StudyModel::Interaction, 0.9L).value();
  const Exact wanted[] = {Exact(118'237, 33), Exact(763, 22), Exact(2831, 66), Exact(91, 3)};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(study.anova[i].variation.sum_of_squares == wanted[i]);
  }
  CHECK(number(study.ev * study.ev) == Approx(0.5416666666666666));
  CHECK(number(study.interaction * study.interaction) == Approx(0.6751543209876543));
  CHECK(number(study.av * study.av) == Approx(0.5484567901234568));
  CHECK(number(study.pv * study.pv) == Approx(48.36594650205761));
  check_interval(study.intervals->ev, {0.638225685585271992, 0.872994609712612895});
  check_interval(study.intervals->av, {0.340522297217227808, 3.50741237719127445});
  check_interval(study.intervals->grr, {1.11423394272301045, 3.68081302050373984});
  const GaugeStudy pooled = study_gauge(most, StudyMethod::Anova, StudyModel::Pooled).value();
  check_interval(pooled.intervals->av, {0.367528494442654508, 5.00764874207227532});
  check_interval(pooled.intervals->grr, {1.03179356984858028, 5.10594040810596763});
  CHECK(study_gauge(most, StudyMethod::Type3, StudyModel::Auto).has_value());
  CHECK(study_gauge(most, StudyMethod::Nested, StudyModel::Auto).has_value());
  CHECK(study_gauge(most, StudyMethod::AverageRange, StudyModel::Auto).error().code ==
        ErrorCode::StatisticsUnbalanced);
  const auto none = study_gauge(thermal_impedance({{3, 3}, {3, 4}, {3, 5}}), StudyMethod::Anova,
                                StudyModel::Auto);
  CHECK(none.error().code == ErrorCode::StatisticsUnbalanced);
  CHECK(none.error().message.find("operator 2 has no reading of part 4") != std::string::npos);
}

TEST_CASE("MSA 4: the published study is pooled, with the rows of its table") {
  // Its figures are in expected.txt of `fitgauged qualify`.
  const GaugeStudy study = study_gauge(msa4(), StudyMethod::Anova, StudyModel::Auto).value();
  CHECK(study.model == StudyModel::Pooled);
  CHECK(study.interaction == 0);
  CHECK(study.interaction_p > 0.25L);
  CHECK(study.anova.back().variation.degrees_of_freedom == 89);
  const GaugeStudy ranges =
      study_gauge(msa4(), StudyMethod::AverageRange, StudyModel::Auto).value();
  CHECK(number(ranges.tv) == Approx(1.14610).epsilon(1e-4));
  CHECK(std::isnan(ranges.interaction));
}

TEST_CASE("components of variance worked out by hand") {
  // Cell means 1, 5, 3, 3: parts differ by 2, operators not at all, the rest is interaction.
  const GaugeStudy study =
      study_gauge(small("0 2 4 6 2 4 2 4"), StudyMethod::Anova, StudyModel::Interaction).value();
  REQUIRE(study.anova.size() == 5);
  const double squares[] = {8, 0, 8, 8, 24};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(study.anova[i].variation.sum_of_squares == Exact(static_cast<int>(squares[i])));
  }
  CHECK(study.ev == std::sqrt(2.0L));           // 8 / 4
  CHECK(study.interaction == std::sqrt(3.0L));  // (8 - 2) / 2
  CHECK(study.av == 0);                         // negative: 0
  CHECK(study.pv == 0);
  CHECK(study.grr == std::sqrt(5.0L));
  CHECK(study.ndc == 1);

  Readings alone = small("0 2 4 6 2 4 2 4");
  alone.operators.clear();
  alone.operator_count = 0;
  const GaugeStudy type3 = study_gauge(alone, StudyMethod::Type3, StudyModel::Auto).value();
  CHECK(type3.ev == square_root(Exact(16, 6)));  // within parts: 8 and 8 over 6
  CHECK(type3.pv == square_root((Exact(8) - Exact(16, 6)) / 4));
  CHECK(std::isnan(type3.av));

  const GaugeStudy nested =
      study_gauge(small("0 2 4 6 2 4 2 4"), StudyMethod::Nested, StudyModel::Auto).value();
  CHECK(nested.ev == std::sqrt(2.0L));
  CHECK(nested.av == 0);
  CHECK(nested.pv == std::sqrt(3.0L));  // parts within operators: 16 / 2, less 2, over 2
}

TEST_CASE("a whole number of distinct categories is not one fewer") {
  // PV^2 = 49 d^2, GRR^2 = 2 d^2.
  for (const char* values : {"-1 1 9 11", "-0.3 0.3 2.7 3.3", "-0.01 0.01 0.09 0.11"}) {
    const Readings parts{
        .values = decimals(values), .part = {0, 0, 1, 1}, .operators = {}, .parts = 2};
    CHECK(study_gauge(parts, StudyMethod::Type3, StudyModel::Auto)->ndc == 7);
  }
}

TEST_CASE("studies that say nothing are refused with their code") {
  const auto code = [](const Readings& readings, StudyMethod method, StudyModel model) {
    return study_gauge(readings, method, model).error().code;
  };
  CHECK(code(small("1 1 1 1 1 1 1 1"), StudyMethod::Anova, StudyModel::Auto) ==
        ErrorCode::StatisticsZeroSpread);
  Readings one_operator = small("0 2 4 6 2 4 2 4");
  one_operator.operators.assign(8, 0);
  one_operator.operator_count = 1;
  CHECK(code(one_operator, StudyMethod::Anova, StudyModel::Auto) == ErrorCode::StatisticsTooFew);
  const Readings once{.values = decimals("1 2 3 5"),
                      .part = {0, 1, 0, 1},
                      .operators = {0, 0, 1, 1},
                      .parts = 2,
                      .operator_count = 2};
  CHECK(code(once, StudyMethod::Anova, StudyModel::Interaction) == ErrorCode::StatisticsTooFew);
  CHECK(code(once, StudyMethod::AverageRange, StudyModel::Auto) == ErrorCode::StatisticsTooFew);
  CHECK(code(once, StudyMethod::Anova, StudyModel::Auto) == ErrorCode::StatisticsTooFew);
  CHECK(study_gauge(once, StudyMethod::Anova, StudyModel::Pooled).value().model ==
        StudyModel::Pooled);
}

TEST_CASE("type 1: Cg and Cgk of a gauge on its master") {
  // Mean 10.002, deviations ±0.001: s^2 = 4e-6 / 3.
  const Type1Study study =
      study_type1(decimals("10.001 10.003 10.001 10.003"), 10, Exact(1, 10)).value();
  const double s = std::sqrt(4e-6 / 3);
  CHECK(number(study.cg) == Approx(0.02 / (6 * s)).epsilon(1e-14));
  CHECK(number(study.cgk) == Approx((0.01 - 0.002) / (3 * s)).epsilon(1e-14));
  CHECK(number(study.t) == Approx(0.002 / (s / 2)).epsilon(1e-14));
  const auto code = [](const char* values, const Exact& tolerance) {
    return study_type1(decimals(values), 10, tolerance).error().code;
  };
  CHECK(code("10", 1) == ErrorCode::StatisticsTooFew);
  CHECK(code("10 10", 1) == ErrorCode::StatisticsZeroSpread);
  CHECK(code("10 11", 0) == ErrorCode::LimitsInvalid);
}

TEST_CASE("type 1: Cg by another share of the tolerance and another spread") {
  const auto values = decimals("10.001 10.003 10.001 10.003");
  const double s = std::sqrt(4e-6 / 3);
  const Type1Study study =
      study_type1(values, 10, Exact(1, 10), {.percent = 15, .spread = 4}).value();
  CHECK(number(study.cg) == Approx(0.015 / (4 * s)).epsilon(1e-14));
  CHECK(number(study.cgk) == Approx((0.0075 - 0.002) / (2 * s)).epsilon(1e-14));
}

TEST_CASE("ISO 22514-7: the greatest repeatability counts, and each other component") {
  // The printed example is in expected.txt of `fitgauged qualify`.
  MeasuringProcess process;
  process[Component::Cal] = 3;
  process[Component::Evr] = 4;
  CHECK(process.system() == 5);
  process[Component::Re] = 3.5;  // below u_EVR: no part of it
  CHECK(process.system() == 5);
  CHECK(process.process() == 5);
  process[Component::Evo] = 12;
  CHECK(process.system() == 5);
  CHECK(process.process() == std::sqrt(9 + 144.0));
  process[Component::Re] = 20;
  CHECK(process.process() == std::sqrt(9 + 400.0));
  process = {};
  for (std::size_t i = 0; i < kComponents.size(); ++i) process[static_cast<Component>(i)] = 1;
  CHECK(process.system() == std::sqrt(5.0));    // CAL, one repeatability, BI, LIN, rest
  CHECK(process.process() == std::sqrt(12.0));  // and AV, IA, GV, STAB, T, OBJ, rest
  const MeasuringCapability at_bound(0.075, 1, true);
  CHECK(at_bound.percent == Approx(30));
  CHECK(at_bound.index == Approx(4.0 / 3));
  CHECK(at_bound.least_tolerance == Approx(1));
  CHECK(MeasuringCapability(0.0375, 1, false).index == Approx(4.0 / 3));
}

TEST_CASE("linearity: the regression of bias on reference") {
  // Biases 0.1 x + 0.05 with ±0.01 about it: slope and intercept stay exact.
  const auto study = study_linearity(decimals("1.14 1.16 2.24 2.26 3.34 3.36"),
                                     {Exact(1), Exact(1), Exact(2), Exact(2), Exact(3), Exact(3)})
                         .value();
  CHECK(study.slope.value == 0.1L);
  CHECK(study.intercept.value == 0.05L);
  CHECK(number(study.residual_standard_deviation) == Approx(std::sqrt(6e-4 / 4)).epsilon(1e-14));
  CHECK(number(study.slope.standard_error) == Approx(std::sqrt(6e-4 / 4 / 4)).epsilon(1e-14));
  CHECK(study.references.size() == 3);
  CHECK(study.average_bias == 0.25L);
  CHECK(study_linearity(decimals("1 1 1"), {Exact(1), Exact(1), Exact(1)}).error().code ==
        ErrorCode::StatisticsTooFew);
}
