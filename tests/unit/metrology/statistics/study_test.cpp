#include <cmath>

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

}  // namespace

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

TEST_CASE("studies that say nothing are refused with their code") {
  const auto code = [](const Readings& readings, StudyMethod method, StudyModel model) {
    return study_gauge(readings, method, model).error().code;
  };
  CHECK(code(small("1 1 1 1 1 1 1 1"), StudyMethod::Anova, StudyModel::Auto) ==
        ErrorCode::StatisticsZeroSpread);
  Readings unbalanced = small("0 2 4 6 2 4 2 4");
  unbalanced.part.back() = 0;
  CHECK(code(unbalanced, StudyMethod::Anova, StudyModel::Auto) == ErrorCode::StatisticsUnbalanced);
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
