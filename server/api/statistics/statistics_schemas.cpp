#include "api/schemas.hpp"
#include "metrology/statistics/uncertainty.hpp"

namespace fitgauge::api {

schema::Fields formula_fields() {
  return {{"formula", schema::text(), "What was computed"},
          {"clause", schema::text(), "Where that is from"}};
}

schema::Fields selection_field() {
  const std::string selection =
      schema::object({{"count", schema::count(), "Values"},
                      {"subgroups", schema::count(), "0 where the values are taken one by one"},
                      {"first_id", schema::text(), "The first of them in storage order"},
                      {"last_id", schema::text(), ""},
                      {"as_of", schema::text(), "The newest measurement there was"},
                      {"lower_limit_mm", schema::number(), "That all of them have", false},
                      {"upper_limit_mm", schema::number(), "", false}});
  return {{"selection", selection, "Which measurements it is of"}};
}

namespace {

using schema::Fields;
using schema::Others;

/// A figure of the answer: null where it is undefined.
std::string figure() { return schema::null_or(schema::number()); }

Fields figures(std::initializer_list<std::string_view> names) {
  Fields fields;
  for (const std::string_view name : names) fields.push_back({std::string(name), figure(), ""});
  return fields;
}

std::string order(const Fields& fields) { return schema::object(fields, Others::Refused); }

std::string exact_values() { return schema::array(schema::exact()); }

/// Single values, or subgroups of one size.
Fields data_fields() {
  return {{"values", exact_values(), "One after another, or subgroups", false},
          {"subgroups", schema::array(exact_values()), "Of one size, two values or more", false}};
}

std::string violations() {
  return schema::array(schema::object({{"chart", schema::text(), "As it is named in charts"},
                                       {"rule", schema::integer(1, 4), "Western Electric 1956"},
                                       {"index", schema::count(), "Of the point, from 0"},
                                       {"id", schema::text(), "Of the stored measurement", false},
                                       {"subgroup", schema::text(), "Of stored ones", false}}));
}

Fields chart_fields() {
  const std::string points = schema::array(schema::number());
  const std::string chart =
      schema::object(Fields{{"name", schema::text(), "i, mr, xbar, r, s, ewma or cusum"}} +
                     figures({"centre", "lower_limit", "upper_limit"}) +
                     Fields{{"points", points, "Nearest doubles"},
                            {"lower_points", points, "Of cusum: the sums below", false}});
  return {{"standard_deviation", figure(), "Of single values, from within"},
          {"charts", schema::array(chart), "Location first"},
          {"violations", violations(), ""},
          {"average_run_length", figure(), "Points to a false alarm of the location chart"}};
}

Fields variation_fields() {
  return {{"degrees_of_freedom", schema::count(), ""},
          {"sum_of_squares", figure(), ""},
          {"mean_square", figure(), "Absent without degrees of freedom", false}};
}

void add_summary(Schemas& schemas) {
  schemas.push_back({"Values", order({{"values", exact_values(), "One or more"}})});
  const std::string quantiles =
      schema::object({{"type", schema::integer(7, 7), "Hyndman and Fan 1996"},
                      {"values", schema::array(schema::object(figures({"p", "value"}))), ""}});
  schemas.push_back(
      {"ValueSummary", schema::object(formula_fields() + Fields{{"count", schema::count(), ""}} +
                                      figures({"mean", "standard_deviation",
                                               "autocorrelation_lag_1", "min", "max"}) +
                                      Fields{{"quantiles", quantiles, ""}})});
  schemas.push_back(
      {"Groups", order({{"groups", schema::array(exact_values()), "Two or more, of any size"}})});
  const std::string variation = schema::object(variation_fields());
  schemas.push_back(
      {"Anova",
       schema::object(formula_fields() +
                      Fields{{"between", variation, "Groups"}, {"within", variation, "Rest"}} +
                      figures({"f", "p", "r_squared", "residual_standard_deviation"}))});
}

void add_capability(Schemas& schemas) {
  schemas.push_back(
      {"CapabilityOrder",
       order(data_fields() +
             Fields{{"lower", schema::exact(), "This, upper or both", false},
                    {"upper", schema::exact(), "", false},
                    {"target", schema::exact(), "Of cpm; the middle when absent", false},
                    {"confidence", schema::with_default(schema::number(0, 1), "0.95"),
                     "Of the intervals", false}})});
  schemas.push_back({"CapabilityIndex",
                     schema::object(figures({"value", "lower", "upper"}) +
                                    Fields{{"interval", schema::text(), "How it is computed"}})});
  const std::string normality =
      schema::object(Fields{{"test", schema::words({"anderson_darling"}), ""}} +
                     figures({"statistic", "adjusted", "p"}));
  const std::string model = schema::object(
      Fields{{"scheme", schema::text(), ""},
             {"name", schema::words({"A1", "A2", "B", "C1", "C2", "C3", "C4", "D"}), ""},
             {"meaning", schema::text(), ""},
             {"significance", schema::number(), ""},
             {"subgroup_size", schema::count(), ""}} +
      figures({"p_location", "p_dispersion", "p_trend"}));
  const std::string percentile =
      schema::object(Fields{{"quantiles", schema::text(), "How they are taken"}} +
                     figures({"x_0135", "x_50", "x_99865", "pp", "ppk"}));
  Fields fields = formula_fields() + Fields{{"count", schema::count(), ""}} +
                  figures({"mean", "standard_deviation_within", "standard_deviation_overall",
                           "lower", "upper", "confidence"});
  for (const char* name : {"cp", "cpk", "cpl", "cpu", "pp", "ppk", "cpm", "cm", "cmk"}) {
    fields.push_back({name, schema::null_or(schema::ref("CapabilityIndex")), ""});
  }
  const Fields others = {{"stable", schema::boolean(), "No rule is broken"},
                         {"violations", violations(), ""},
                         {"normality", schema::null_or(normality), "From five values"},
                         {"model", schema::null_or(model), "From five subgroups"},
                         {"percentile", schema::null_or(percentile), "From 741 values"}};
  schemas.push_back({"Capability", schema::object(fields + others)});
  schemas.push_back({"StoredCapability", schema::object(selection_field() + fields + others)});
}

void add_chart(Schemas& schemas) {
  const std::string phase = order({{"from", schema::with_default(schema::count(), "0"), "", false},
                                   {"to", schema::count(), "Exclusive"}});
  schemas.push_back(
      {"ChartOrder",
       order(Fields{{"kind", schema::words({"i_mr", "xbar_r", "xbar_s", "ewma", "cusum"}), ""}} +
             data_fields() +
             schema::optional({
                 {"rules", schema::array(schema::integer(1, 4)), "None when absent"},
                 {"phase1", phase, "The points the limits are taken from"},
                 {"centre", schema::exact(), "Known"},
                 {"standard_deviation", schema::exact(), "Known, of single values; above 0"},
                 {"lambda", schema::number(0.001, 1), "Of ewma"},
                 {"reference_value", schema::number(0, 10), "k of cusum, in standard deviations"},
                 {"decision_interval", schema::number(0, 20), "h of cusum, likewise"},
             }))});
  const Fields fields = Fields{{"kind", schema::text(), ""}} + formula_fields() + chart_fields();
  schemas.push_back({"ControlChart", schema::object(fields)});
  schemas.push_back({"StoredControlChart", schema::object(selection_field() + fields)});
}

/// Who or what: a word or a number.
std::string label() { return R"({"type":["string","number"]})"; }

/// Rows of a study, with what the method needs of each.
std::string study_rows(const Fields& own) {
  Fields fields = own;
  for (const char* name : {"part", "operator", "trial"}) {
    if (own.front().name != name) fields.push_back({name, label(), "", false});
  }
  fields.push_back({"value", schema::exact(), ""});
  return schema::array(order(fields));
}

/// An order of a study by its method; whatever that is may stand beside a model and a tolerance.
std::string study_order(const schema::Field& method, const std::string& model_of,
                        const std::string& tolerance_for, const schema::Field& rows) {
  return order(
      {method,
       {"model",
        schema::with_default(schema::words({"auto", "interaction", "pooled"}), R"("auto")"),
        model_of, false},
       {"tolerance", schema::exact(), tolerance_for, false},
       rows});
}

void add_gauge_study_orders(Schemas& schemas) {
  const std::string unused = "Without effect here";
  schemas.push_back(
      {"Type1Order", order({{"values", exact_values(), "Two or more, of one master"},
                            {"reference", schema::exact(), "The size of the master"},
                            {"tolerance", schema::exact(), "Of what will be measured"}})});
  schemas.push_back(
      {"VariationStudyOrder",
       study_order({"method",
                    schema::with_default(
                        schema::words({"anova", "average_range", "type3", "nested"}), R"("anova")"),
                    "", false},
                   "Of anova", "For the shares of it",
                   {"measurements", study_rows({{"part", label(), ""}}),
                    "Each with an operator, but for type3"})});
  schemas.push_back(
      {"LinearityStudyOrder",
       study_order(
           {"method", schema::words({"linearity"}), ""}, unused, unused,
           {"measurements", study_rows({{"reference", schema::exact(), "Of the master"}}), ""})});
  schemas.push_back(
      {"StabilityStudyOrder",
       study_order(
           {"method", schema::words({"stability"}), ""}, unused, unused,
           {"measurements", study_rows({{"at", label(), "The same for readings of one time"}}),
            "As many at each time"})});
  schemas.push_back({"GaugeStudyOrder", schema::any_of({schema::ref("VariationStudyOrder"),
                                                        schema::ref("LinearityStudyOrder"),
                                                        schema::ref("StabilityStudyOrder")})});
}

void add_gauge_studies(Schemas& schemas) {
  schemas.push_back(
      {"Type1Study",
       schema::object(formula_fields() + Fields{{"count", schema::count(), ""}} +
                      figures({"mean", "standard_deviation", "bias", "t", "p", "cg", "cgk"}))});
  const Fields components = figures({"ev", "av", "interaction", "grr", "pv", "tv"});
  const std::string shares = schema::object(components);
  const std::string line = schema::object(variation_fields() + figures({"f", "p"}));
  schemas.push_back(
      {"VariationStudy",
       schema::object(
           Fields{{"method", schema::words({"anova", "average_range", "type3", "nested"}), ""},
                  {"model", schema::null_or(schema::text()), "interaction or pooled, of anova"}} +
           formula_fields() + components +
           Fields{{"ndc", schema::null_or(schema::count()), "Distinct categories"},
                  {"contribution_percent", shares, "Of the variance"},
                  {"study_variation_percent", shares, "Of six total standard deviations"},
                  {"tolerance_percent", shares, "Null without a tolerance"},
                  {"interaction_p", figure(), ""},
                  {"anova", schema::null_or(schema::map(line)), "By line of the table"}})});
  const std::string coefficient = schema::object(figures({"value", "standard_error", "p"}));
  const std::string bias = schema::object(
      Fields{{"reference", figure(), ""}, {"count", schema::count(), ""}} + figures({"bias", "p"}));
  schemas.push_back(
      {"LinearityStudy",
       schema::object(Fields{{"method", schema::words({"linearity"}), ""},
                             {"slope", coefficient, "Of the bias on the reference"},
                             {"intercept", coefficient, ""}} +
                      figures({"r_squared", "residual_standard_deviation", "linearity_percent",
                               "average_bias"}) +
                      Fields{{"references", schema::array(bias), ""}} + formula_fields())});
  schemas.push_back(
      {"StabilityStudy", schema::object(Fields{{"method", schema::words({"stability"}), ""},
                                               {"stable", schema::boolean(), "No rule is broken"}} +
                                        formula_fields() + chart_fields())});
  schemas.push_back(
      {"GaugeStudy", schema::any_of({schema::ref("VariationStudy"), schema::ref("LinearityStudy"),
                                     schema::ref("StabilityStudy")})});
}

void add_pairing(Schemas& schemas) {
  schemas.push_back(
      {"PairingOrder",
       schema::object({{"holes", exact_values(), "Measured sizes in mm"},
                       {"shafts", exact_values(), "Measured sizes in mm"},
                       {"target_clearance_um", schema::exact(), "Interference is negative"}})});
  const std::string pair = schema::object({{"hole", schema::count(), "Its place, from 0"},
                                           {"shaft", schema::count(), "Its place, from 0"},
                                           {"clearance_um", schema::number(), ""}});
  schemas.push_back(
      {"Pairing", schema::object(formula_fields() + Fields{{"pairs", schema::array(pair), ""}})});
}

void add_uncertainty(Schemas& schemas) {
  constexpr double kLargest = 1e15;
  const std::string contribution = order(
      Fields{{"name", schema::text(), "No other has it"}} +
      schema::optional({
          {"standard_uncertainty", schema::number(0, kLargest), "This or half_width"},
          {"half_width", schema::number(0, kLargest), ""},
          {"distribution", schema::words({"normal", "rectangular", "triangular", "u_shaped", "t"}),
           "rectangular with a half width, else normal"},
          {"sensitivity", schema::with_default(schema::number(-kLargest, kLargest), "1"), ""},
          {"degrees_of_freedom", schema::number(0, kLargest), "Without end when absent"},
      }));
  const std::string correlation =
      order({{"between", schema::array(schema::text(), 2, 2), "Names of contributions"},
             {"coefficient", schema::number(-1, 1), ""}});
  const std::string simulation =
      order({{"trials", schema::integer(1000, std::int64_t{metrology::kMostDraws} / 5),
              "1,000,000 when absent; trials times contributions have a limit", false},
             {"seed", schema::with_default(schema::count(), "1"), "", false}});
  schemas.push_back(
      {"UncertaintyBudget",
       order({{"contributions", schema::array(contribution), "1 to 100"},
              {"correlations", schema::array(correlation), "", false},
              {"probability", schema::with_default(schema::number(0, 1), "0.95"), "", false},
              {"monte_carlo", simulation, "", false}})});
  const std::string simulated = schema::object(
      {{"trials", schema::count(), ""},
       {"seed", schema::count(), ""},
       {"mean", figure(), "Of the deviation from the estimate"},
       {"standard_deviation", figure(), ""},
       {"interval", schema::object(figures({"lower", "upper"})), "Equal probability outside"}});
  schemas.push_back(
      {"Uncertainty",
       schema::object(formula_fields() +
                      figures({"combined_standard_uncertainty", "effective_degrees_of_freedom",
                               "welch_satterthwaite", "probability", "coverage_factor",
                               "expanded_uncertainty"}) +
                      Fields{{"monte_carlo", simulated, "Where it was asked for", false}})});
}

void add_documents(Schemas& schemas) {
  schemas.push_back(
      {"GaugeInUse",
       order({{"uncertainty", schema::text(200), "The name of its budget, in µm", false},
              {"calibration_due", schema::text(), "A date, to its end in UTC, or an RFC 3339 time"},
              {"comment", schema::text(2000), "", false}})});
  const std::string named =
      schema::object({{"name", schema::text(), ""}, {"modified_at", schema::time(), "In UTC"}});
  schemas.push_back(
      {"UncertaintyBudgetNames", schema::object({{"uncertainties", schema::array(named), ""}})});
  schemas.push_back({"GaugeInUseNames", schema::object({{"gauges", schema::array(named), ""}})});
}

}  // namespace

void add_statistics_schemas(Schemas& schemas) {
  add_summary(schemas);
  add_capability(schemas);
  add_chart(schemas);
  add_gauge_study_orders(schemas);
  add_gauge_studies(schemas);
  add_pairing(schemas);
  add_uncertainty(schemas);
  add_documents(schemas);
}

}  // namespace fitgauge::api
