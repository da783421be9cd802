#include "api/statistics/statistics_codec.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "api/wire/formulas.hpp"
#include "base/write_text.hpp"

namespace fitgauge::api {
namespace {

using metrology::CapabilityIndex;
using metrology::ChartViolation;
using metrology::Exact;
using metrology::nearest;

std::uint64_t count_of(std::size_t count) { return count; }

void write_exact(JsonWriter& json, std::string_view name, const std::optional<Exact>& value) {
  json.key(name);
  if (value) {
    json.figure(nearest(*value));
  } else {
    json.null();
  }
}

void write_figure(JsonWriter& json, std::string_view name,
                  const std::optional<long double>& value) {
  json.key(name).figure(value.value_or(metrology::kUndefined));
}

constexpr std::size_t kPointRoom = 32;  ///< for any double, and the comma before it

/// A point of a measured value is a decimal of nanometres. Up to 15 digits that decimal is the
/// shortest that reads back as the same double, and is found sooner.
/// @returns the end of its text
char* write_point(char* to, double point) {
  constexpr double kNanometresOfOne = 1e6;
  constexpr double kMost = 1e15;
  constexpr int kDecimals = 6;
  const double nanometres = std::nearbyint(point * kNanometresOfOne);
  if (std::abs(nanometres) < kMost && nanometres / kNanometresOfOne == point) {
    return write_decimal(to, static_cast<std::int64_t>(nanometres), kDecimals);
  }
  if (!std::isfinite(point)) return std::copy_n("null", 4, to);
  return std::to_chars(to, to + kPointRoom, point).ptr;
}

/// Some hundred points at a time.
void write_points(JsonWriter& json, std::string_view name, const std::vector<double>& points) {
  json.key(name).begin_array();
  std::array<char, 8192> piece{};
  char* at = piece.data();
  for (const double point : points) {
    if (at != piece.data()) *at++ = ',';
    at = write_point(at, point);
    if (piece.data() + piece.size() - at >= static_cast<std::ptrdiff_t>(kPointRoom)) continue;
    json.raw({piece.data(), at});
    at = piece.data();
  }
  if (at != piece.data()) json.raw({piece.data(), at});
  json.end_array();
}

void write_violations(JsonWriter& json, const std::vector<ChartViolation>& violations,
                      const PointName& name) {
  json.key("violations").begin_array();
  for (const ChartViolation& violation : violations) {
    json.begin_object()
        .member("chart", violation.chart)
        .member("rule", violation.rule)
        .member("index", count_of(violation.index));
    if (name) name(json, violation);
    json.end_object();
  }
  json.end_array();
}

void write_index(JsonWriter& json, std::string_view name,
                 const std::optional<CapabilityIndex>& index, std::string_view interval) {
  json.key(name);
  if (!index) {
    json.null();
    return;
  }
  json.begin_object();
  json.key("value").figure(index->value).key("lower").figure(index->lower);
  json.key("upper").figure(index->upper).member("interval", interval).end_object();
}

void write_normality(JsonWriter& json, const std::optional<metrology::NormalityTest>& test) {
  json.key("normality");
  if (!test) {
    json.null();
    return;
  }
  json.begin_object()
      .member("test", "anderson_darling")
      .member("statistic", test->statistic)
      .member("adjusted", test->adjusted)
      .member("p", test->p)
      .end_object();
}

void write_model(JsonWriter& json, const std::optional<metrology::ModelChoice>& choice) {
  json.key("model");
  if (!choice) {
    json.null();
    return;
  }
  json.begin_object()
      .member("scheme", "ISO 22514-2:2017")
      .member("name", word(choice->model))
      .member("meaning", meaning(choice->model))
      .member("significance", metrology::kModelSignificance)
      .member("subgroup_size", count_of(choice->tests.subgroup_size));
  json.key("p_location").figure(choice->tests.location);
  json.key("p_dispersion").figure(choice->tests.dispersion);
  json.key("p_trend").figure(choice->tests.trend).end_object();
}

void write_percentile(JsonWriter& json,
                      const std::optional<metrology::PercentileCapability>& percentile) {
  json.key("percentile");
  if (!percentile) {
    json.null();
    return;
  }
  json.begin_object().member("quantiles", "empirical, type 7");
  json.key("x_0135").figure(percentile->x_0135).key("x_50").figure(percentile->x_50);
  json.key("x_99865").figure(percentile->x_99865);
  write_figure(json, "pp", percentile->pp);
  write_figure(json, "ppk", percentile->ppk);
  json.end_object();
}

}  // namespace

std::span<const Applicable> chart_members() {
  static constexpr std::array<Applicable, 3> kMembers = {{
      {"lambda", "ewma"},
      {"reference_value", "cusum"},
      {"decision_interval", "cusum"},
  }};
  return kMembers;
}

void write_summary(JsonWriter& json, const metrology::Summary& summary) {
  json.begin_object();
  write_formula(json, "summary");
  json.member("count", count_of(summary.moments.count));
  write_exact(json, "mean", summary.moments.mean);
  json.key("standard_deviation").figure(summary.moments.standard_deviation());
  json.key("autocorrelation_lag_1").figure(summary.autocorrelation_lag_1);
  write_exact(json, "min", summary.min);
  write_exact(json, "max", summary.max);
  json.key("quantiles").begin_object().member("type", 7).key("values").begin_array();
  for (const metrology::Quantile& quantile : summary.quantiles) {
    json.begin_object()
        .key("p")
        .figure(quantile.p)
        .key("value")
        .figure(quantile.value)
        .end_object();
  }
  json.end_array().end_object().end_object();
}

void write_variation_members(JsonWriter& json, const metrology::Variation& variation) {
  json.member("degrees_of_freedom", count_of(variation.degrees_of_freedom));
  write_exact(json, "sum_of_squares", variation.sum_of_squares);
  if (variation.degrees_of_freedom > 0) write_exact(json, "mean_square", variation.mean_square());
}

void write_test_members(JsonWriter& json, const metrology::FTest& test) {
  json.key("f").figure(test.f).key("p").figure(test.p);
}

void write_chart_members(JsonWriter& json, const metrology::ControlCharts& charts,
                         const PointName& name) {
  json.key("standard_deviation").figure(charts.standard_deviation).key("charts").begin_array();
  for (const metrology::Chart& chart : charts.charts) {
    json.begin_object().member("name", chart.name);
    json.key("centre").figure(chart.centre).key("lower_limit").figure(chart.lower_limit);
    json.key("upper_limit").figure(chart.upper_limit);
    write_points(json, "points", chart.points);
    if (!chart.lower_points.empty()) write_points(json, "lower_points", chart.lower_points);
    json.end_object();
  }
  json.end_array();
  write_violations(json, charts.violations, name);
  json.member("average_run_length", charts.average_run_length);
}

void write_capability_members(JsonWriter& json, const metrology::Capability& c,
                              const metrology::SpecificationLimits& limits, long double confidence,
                              const PointName& name) {
  constexpr std::string_view kWidth = "chi-square, n - 1";
  constexpr std::string_view kDistance = "normal, Bissell 1990";
  write_formula(json, "capability");
  json.member("count", count_of(c.count)).key("mean").figure(c.mean);
  json.key("standard_deviation_within").figure(c.within);
  json.key("standard_deviation_overall").figure(c.overall);
  write_exact(json, "lower", limits.lower);
  write_exact(json, "upper", limits.upper);
  json.key("confidence").figure(confidence);
  write_index(json, "cp", c.cp, kWidth);
  write_index(json, "cpk", c.cpk, kDistance);
  write_index(json, "cpl", c.cpl, kDistance);
  write_index(json, "cpu", c.cpu, kDistance);
  write_index(json, "pp", c.pp, kWidth);
  write_index(json, "ppk", c.ppk, kDistance);
  write_index(json, "cpm", c.cpm, "chi-square, Boyles 1991");
  write_index(json, "cm", c.cm, kWidth);
  write_index(json, "cmk", c.cmk, kDistance);
  json.member("stable", c.stable);
  write_violations(json, c.violations, name);
  write_normality(json, c.normality);
  write_model(json, c.model);
  write_percentile(json, c.percentile);
}

void write_gauge_study(JsonWriter& json, const metrology::GaugeStudy& study,
                       metrology::StudyMethod method, const std::optional<long double>& tolerance) {
  const std::array<std::pair<std::string_view, long double>, 6> components = {
      {{"ev", study.ev},
       {"av", study.av},
       {"interaction", study.interaction},
       {"grr", study.grr},
       {"pv", study.pv},
       {"tv", study.tv}}};
  const auto shares = [&](std::string_view name, auto share) {
    json.key(name).begin_object();
    for (const auto& [component, sigma] : components) json.key(component).figure(share(sigma));
    json.end_object();
  };
  constexpr long double kPercent = 100;
  json.begin_object().member("method", word(method));
  write_formula(json, word(method));
  json.key("model");
  if (study.model) {
    json.value(word(*study.model));
  } else {
    json.null();
  }
  for (const auto& [component, sigma] : components) json.key(component).figure(sigma);
  json.key("ndc");
  if (study.ndc) {
    json.value(*study.ndc);
  } else {
    json.null();
  }
  shares("contribution_percent",
         [&](long double sigma) { return kPercent * (sigma / study.tv) * (sigma / study.tv); });
  shares("study_variation_percent", [&](long double sigma) { return kPercent * sigma / study.tv; });
  shares("tolerance_percent", [&](long double sigma) {
    return tolerance ? kPercent * 6 * sigma / *tolerance : metrology::kUndefined;
  });
  json.key("interaction_p").figure(study.interaction_p).key("anova");
  if (study.anova.empty()) {
    json.null().end_object();
    return;
  }
  json.begin_object();
  for (const metrology::AnovaLine& line : study.anova) {
    json.key(line.name).begin_object();
    write_variation_members(json, line.variation);
    write_test_members(json, line.test);
    json.end_object();
  }
  json.end_object().end_object();
}

void write_linearity(JsonWriter& json, const metrology::LinearityStudy& study) {
  const auto coefficient = [&](std::string_view name,
                               const metrology::LinearityStudy::Coefficient& c) {
    json.key(name).begin_object().key("value").figure(c.value);
    json.key("standard_error").figure(c.standard_error).key("p").figure(c.p).end_object();
  };
  json.begin_object().member("method", "linearity");
  write_formula(json, "linearity");
  coefficient("slope", study.slope);
  coefficient("intercept", study.intercept);
  json.key("r_squared").figure(study.r_squared);
  json.key("residual_standard_deviation").figure(study.residual_standard_deviation);
  json.key("linearity_percent").figure(100 * std::abs(study.slope.value));
  json.key("average_bias").figure(study.average_bias).key("references").begin_array();
  for (const metrology::LinearityStudy::Bias& bias : study.references) {
    json.begin_object()
        .key("reference")
        .figure(bias.reference)
        .member("count", count_of(bias.count));
    json.key("bias").figure(bias.bias).key("p").figure(bias.p).end_object();
  }
  json.end_array().end_object();
}

}  // namespace fitgauge::api
