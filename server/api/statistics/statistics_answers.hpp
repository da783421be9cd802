#pragma once

#include "api/statistics/computation.hpp"
#include "api/statistics/value_selection.hpp"
#include "api/wire/formulas.hpp"

namespace fitgauge::api {

// Responses of /v1/statistics that stored values have too. Figures have 17 digits; null: undefined.

/// Members of a chart's order that only some kinds use, of values that are sent or stored.
inline constexpr std::array<Applicable, 3> kChartMembers = {{
    {"lambda", "ewma"},
    {"reference_value", "cusum"},
    {"decision_interval", "cusum"},
}};

void members(auto& v, const metrology::Variation& variation) {
  const bool varies = variation.degrees_of_freedom > 0;
  v.member("degrees_of_freedom", variation.degrees_of_freedom);
  v.member("sum_of_squares", variation.sum_of_squares);
  v.optional("mean_square", varies ? std::optional(variation.mean_square()) : std::nullopt,
             "Absent without degrees of freedom");
}

void members(auto& v, const metrology::FTest& test) {
  v.member("f", test.f);
  v.member("p", test.p);
}

/// A violation with the stored measurement or subgroup of its point.
struct NamedViolation {
  metrology::ChartViolation violation{};
  std::optional<std::string> id{};
  std::optional<std::string> subgroup{};
};
void members(auto& v, const NamedViolation& named) {
  v.member("chart", named.violation.chart, "Name of the chart");
  v.member("rule", named.violation.rule, Integer{1, metrology::ZoneRules::kCount},
           "Western Electric 1956");
  v.member("index", named.violation.index, "Index of the point, from 0");
  v.optional("id", named.id, "Id of the stored measurement");
  v.optional("subgroup", named.subgroup, "Name of the subgroup of stored values");
}

using NamePoint = std::function<void(NamedViolation&)>;

/// The form of violations.
struct Violations {
  const NamePoint& name;

  std::string schema(Side side) const { return schema::array(schema_of<NamedViolation>(side)); }
  void write(JsonWriter& json, const std::vector<metrology::ChartViolation>& from) const {
    json.begin_array();
    for (const metrology::ChartViolation& violation : from) {
      NamedViolation named{violation};
      if (name) name(named);
      write_body(json, named);
    }
    json.end_array();
  }
};

/// The form of many points: the nearest doubles.
struct Points {
  std::string schema(Side) const { return schema::array(schema::number()); }
  void write(JsonWriter& json, const std::vector<double>& points) const;
};

void members(auto& v, const metrology::Chart& chart) {
  v.member("name", chart.name, "i, mr, xbar, r, s, ewma or cusum");
  v.member("centre", chart.centre);
  v.member("lower_limit", chart.lower_limit);
  v.member("upper_limit", chart.upper_limit);
  v.member("points", chart.points, Points{}, "Nearest doubles");
  v.optional("lower_points", chart.lower_points.empty() ? nullptr : &chart.lower_points, Points{},
             "Lower sums of a cusum chart");
}

void chart_members(auto& v, const metrology::ControlCharts& charts, const NamePoint& name) {
  v.member("standard_deviation", charts.standard_deviation,
           "Standard deviation of single values within subgroups");
  v.member("charts", charts.charts, "Charts; the chart of the location is the first");
  v.member("violations", charts.violations, Violations{name});
  v.member("average_run_length", charts.average_run_length,
           "Points to a false alarm of the location chart");
}

struct ChartAnswer {
  metrology::ChartKind kind{};
  metrology::ControlCharts charts{};
  NamePoint name{};
};
void members(auto& v, const ChartAnswer& answer) {
  v.member("kind", word(answer.kind));
  formula_members(v, word(answer.kind));
  chart_members(v, answer.charts, answer.name);
}

/// An answer of stored values.
template <class Answer>
struct Stored {
  Selection selection{};
  Answer answer{};
};
template <class Answer>
void members(auto& v, const Stored<Answer>& stored) {
  v.member("selection", stored.selection, "Measurements of the figure");
  members(v, stored.answer);
}

/// An index with the way its interval is computed.
struct IndexAnswer {
  metrology::CapabilityIndex index{};
  std::string_view interval{};
};
void members(auto& v, const IndexAnswer& answer) {
  v.member("value", answer.index.value);
  v.member("lower", answer.index.lower);
  v.member("upper", answer.index.upper);
  v.member("interval", answer.interval, "Method of the interval");
}

void members(auto& v, const metrology::NormalityTest& test) {
  v.member("test", "anderson_darling", Word{"anderson_darling"});
  v.member("statistic", test.statistic);
  v.member("adjusted", test.adjusted);
  v.member("p", test.p);
}

void members(auto& v, const metrology::ModelChoice& choice) {
  v.member("scheme", std::string_view("ISO 22514-2:2017"));
  v.member("name", choice.model, Words{metrology::ProcessModel::D});
  v.member("meaning", meaning(choice.model));
  v.member("significance", metrology::kModelSignificance, Finite{});
  v.member("subgroup_size", choice.tests.subgroup_size);
  v.member("p_location", choice.tests.location);
  v.member("p_dispersion", choice.tests.dispersion);
  v.member("p_trend", choice.tests.trend);
}

void members(auto& v, const metrology::PercentileCapability& percentile) {
  v.member("quantiles", std::string_view("of the distribution"), "Quantiles of the model");
  v.member("x_0135", percentile.x_0135);
  v.member("x_50", percentile.x_50);
  v.member("x_99865", percentile.x_99865);
  v.member("pp", percentile.pp);
  v.member("ppk", percentile.ppk);
}

struct ParameterAnswer {
  std::string_view name{};
  double value = 0;
};
void members(auto& v, const ParameterAnswer& parameter) {
  v.member("name", parameter.name);
  v.member("value", parameter.value);
}

void members(auto& v, const metrology::FittedDistribution& fit) {
  v.member("name", fit.name, Words{metrology::ProcessDistribution::Mixture});
  std::vector<ParameterAnswer> parameters;
  for (const auto& [name, value] : fit.named_parameters()) parameters.push_back({name, value});
  v.member("parameters", parameters);
  v.member("chi_squared", fit.chi_squared,
           "Statistic of the test of this fit; null for a normal distribution that the "
           "test of normality does not reject");
  v.member("degrees_of_freedom", fit.degrees_of_freedom);
  v.member("p", fit.p);
}

struct CapabilityAnswer {
  metrology::Capability capability{};
  metrology::SpecificationLimits limits{};
  long double confidence = 0;
  NamePoint name{};
};
void members(auto& v, const CapabilityAnswer& answer) {
  constexpr std::string_view kWidth = "chi-square, n - 1";
  static constexpr std::string_view kFitted = "none: percentile method";
  constexpr std::string_view kDistance = "normal, Bissell 1990";
  const metrology::Capability& c = answer.capability;
  const auto index = [&v, &c](std::string_view name,
                              const std::optional<metrology::CapabilityIndex>& of,
                              std::string_view interval) {
    const bool is_fitted = of && std::isnan(of->lower) && c.percentile;
    v.member(name,
             of ? std::optional(IndexAnswer{*of, is_fitted ? kFitted : interval}) : std::nullopt,
             Object<IndexAnswer>{"CapabilityIndex"});
  };
  formula_members(v, "capability");
  v.member("count", c.count);
  v.member("mean", c.mean);
  v.member("standard_deviation_within", c.within);
  v.member("standard_deviation_overall", c.overall);
  v.member("lower", answer.limits.lower);
  v.member("upper", answer.limits.upper);
  v.member("confidence", answer.confidence);
  index("cp", c.cp, kWidth);
  index("cpk", c.cpk, kDistance);
  index("cpl", c.cpl, kDistance);
  index("cpu", c.cpu, kDistance);
  index("pp", c.pp, kWidth);
  index("ppk", c.ppk, kDistance);
  index("cpm", c.cpm, "chi-square, Boyles 1991");
  index("cm", c.cm, kWidth);
  index("cmk", c.cmk, kDistance);
  v.member("stable", c.stable, "true if no rule is broken");
  v.member("violations", c.violations, Violations{answer.name});
  v.member("normality", c.normality, "Test of normality, from five values on");
  v.member("model", c.model, "Model, from five subgroups on");
  v.member("distribution", c.distribution,
           "Fitted distribution, from 25 values on; null with a `reason` if no known one fits");
  v.member("percentile", c.percentile,
           "Percentile method with the fitted distribution, from 25 values on");
  v.member("reason", c.reason(), "Reason why indices are null");
}

/// The answer to a gauge study's body, by its method, and to one on a master.
Result<std::string> gauge_study(const JsonValue& body);
Result<std::string> master_study(const JsonValue& body);
/// The answer to a budget. @errors RequestInvalid with every bad field.
Result<std::string> compute_uncertainty(const JsonValue& body);

void add_gauge_study_schemas(Schemas& schemas);

}  // namespace fitgauge::api
