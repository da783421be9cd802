#include "api/statistics/statistics_answers.hpp"

#include "api/statistics/measuring_process.hpp"
#include "api/statistics/study_rows.hpp"
#include "metrology/statistics/gauge_study.hpp"

namespace fitgauge::api {

using metrology::StudyMethod;
using metrology::StudyModel;

/// The form of a decimal that is added to the others.
struct OneMore {
  std::string schema(Side) const { return schema::exact(); }
  bool read(FieldReader& fields, std::string_view name, metrology::Decimals& to) const {
    const JsonValue* value = fields.any(name);
    if (value != nullptr) add_exact(*value, fields.at(name), to, fields.errors());
    return value != nullptr;
  }
};

/// Members of every method. The tolerance is of the parts; `auto` lets the method choose.
struct StudyChoices {
  StudyModel model = StudyModel::Auto;
  std::optional<metrology::Exact> tolerance{};
};

/// The form of a model; only the method `anova` has a choice.
struct ModelForm : Words<StudyModel> {
  bool is_free;

  std::string schema(Side side) const {
    return is_free ? Words::schema(side) : Words{StudyModel::Auto}.schema(side);
  }
};

void choice_members(auto& v, StudyChoices& choices, std::string_view method, bool has_models) {
  constexpr std::string_view kUnused = "Without effect here";
  v.optional("model", choices.model, ModelForm{{StudyModel::Pooled}, has_models},
             has_models ? "Model of the method `anova`" : kUnused);
  v.check([&choices, method](FieldReader& fields) {
    static constexpr std::array<Applicable, 1> kMembers = {
        {{"model", "anova", "interaction and pooled"}}};
    if (choices.model != StudyModel::Auto) fields.refuse_not_applicable(kMembers, "method", method);
  });
  v.optional("tolerance", choices.tolerance, kTolerance,
             has_models ? "Tolerance, for percentages of the tolerance" : kUnused);
}

struct VariationOrder {
  StudyMethod method = StudyMethod::Anova;
  StudyChoices choices{};
  metrology::Readings readings{};
  StudyLabels parts{};
  StudyLabels operators{};
  double confidence = 0.95;
  std::optional<MeasuringOrder<true>> process{};
  std::set<std::tuple<std::string, std::string, std::string>> seen{};
};
void row_members(auto& v, VariationOrder& study) {
  const bool with_operators = study.method != StudyMethod::Type3;
  std::optional<std::string> part;
  std::optional<std::string> by;
  std::optional<std::string> trial;
  v.member("part", part, StudyLabel{});
  v.optional("operator", by, StudyLabel{});
  v.optional("trial", trial, StudyLabel{});
  v.member("value", study.readings.values, OneMore{});
  v.check([&](FieldReader& row) {
    if (with_operators && !row.has("operator")) row.any("operator");
    if (!part || (with_operators && !by)) return;
    if (trial && !study.seen.emplace(*part, by.value_or(""), *trial).second) {
      row.report(ErrorCode::FieldConflict, "trial",
                 "this trial of the part by this operator is repeated");
    }
    study.readings.part.push_back(study.parts.number(*part));
    if (with_operators) study.readings.operators.push_back(study.operators.number(*by));
  });
}
void members(auto& v, VariationOrder& study) {
  v.optional("method", study.method, Words{StudyMethod::Nested});
  choice_members(v, study.choices, word(study.method), true);
  v.member("measurements", study, StudyRows<VariationOrder>{},
           "Each with an operator, but for type3");
  v.optional("confidence", study.confidence,
             Number{.least = 0, .most = 1, .ends = Number::Ends::Open},
             "Confidence of the intervals; average_range has none");
  v.check([&study](FieldReader& fields) {
    static constexpr std::array<Applicable, 1> kOfIntervals = {
        {{"confidence", "anova nested type3"}}};
    fields.refuse_not_applicable(kOfIntervals, "method", word(study.method));
  });
  v.optional("measuring_process", study.process,
             "Contributions for the capability of the measuring process (ISO 22514-7), with u_bi "
             "and u_evr of a type1 study");
}

/// StudyLabels that a method does not use.
void unused_labels(auto& v) {
  std::string unused;
  for (const std::string_view label : {"part", "operator", "trial"})
    v.optional(label, unused, StudyLabel{});
}

struct LinearityOrder {
  StudyChoices choices{};
  metrology::Decimals values{};
  std::vector<metrology::Exact> references{};
};
void row_members(auto& v, LinearityOrder& study) {
  v.member("reference", study.references.emplace_back(), "Size of the master");
  unused_labels(v);
  v.member("value", study.values, OneMore{});
}
void members(auto& v, LinearityOrder& study) {
  std::string method;
  v.member("method", method, Word{"linearity"});
  choice_members(v, study.choices, "linearity", false);
  v.member("measurements", study, StudyRows<LinearityOrder>{});
}

/// Readings of one master over time: readings of one time are a subgroup.
struct StabilityOrder {
  StudyChoices choices{};
  StudyLabels times{};
  std::vector<std::size_t> time{};
  metrology::Decimals values{};
};
void row_members(auto& v, StabilityOrder& study) {
  std::string at;
  v.member("at", at, StudyLabel{}, "Time label; equal for readings of one time");
  unused_labels(v);
  v.member("value", study.values, OneMore{});
  study.time.push_back(study.times.number(at));
}
void members(auto& v, StabilityOrder& study) {
  std::string method;
  v.member("method", method, Word{"stability"});
  choice_members(v, study.choices, "stability", false);
  v.member("measurements", study, StudyRows<StabilityOrder>{},
           "Rows of readings; each time needs an equal number of readings");
}

/// The components of a study: standard deviations, or their shares.
struct StudyComponents {
  long double ev = 0, av = 0, interaction = 0, grr = 0, pv = 0, tv = 0;

  template <class Share>
  StudyComponents each(const Share& share) const {
    return {share(ev), share(av), share(interaction), share(grr), share(pv), share(tv)};
  }
};
void members(auto& v, const StudyComponents& of) {
  v.member("ev", of.ev);
  v.member("av", of.av);
  v.member("interaction", of.interaction);
  v.member("grr", of.grr);
  v.member("pv", of.pv);
  v.member("tv", of.tv);
}

/// A line of the table, without its name.
void members(auto& v, const metrology::AnovaLine& line) {
  members(v, line.variation);
  members(v, line.test);
}

/// The form of the table of the analysis of variance: its lines by name.
struct AnovaTable {
  std::string schema(Side side) const {
    return schema::null_or(schema::map(schema_of<metrology::AnovaLine>(side)));
  }
  void write(JsonWriter& json, const std::vector<metrology::AnovaLine>& table) const {
    if (table.empty()) return void(json.null());
    json.begin_object();
    for (const metrology::AnovaLine& line : table) write_body(json.key(line.name), line);
    json.end_object();
  }
};

void members(auto& v, const metrology::StudyIntervals::Interval& interval) {
  v.member("lower", interval.lower);
  v.member("upper", interval.upper);
}
void members(auto& v, const metrology::StudyIntervals& of) {
  v.member("confidence", of.confidence);
  v.member("ev", of.ev, "Chi-square");
  v.optional("av", of.av, "Modified large samples, Ting et al. 1990");
  v.optional("grr", of.grr, "Modified large samples, Graybill and Wang 1980; none of nested");
}

struct VariationAnswer {
  StudyMethod method{};
  metrology::GaugeStudy study{};
  std::optional<metrology::Exact> tolerance{};
  std::optional<MeasuringAnswer<true>> process{};
};
void members(auto& v, const VariationAnswer& answer) {
  constexpr long double kPercent = 100;
  const metrology::GaugeStudy& s = answer.study;
  const StudyComponents sigmas{s.ev, s.av, s.interaction, s.grr, s.pv, s.tv};
  const long double tolerance =
      answer.tolerance ? metrology::nearest(*answer.tolerance) : metrology::kUndefined;
  v.member("method", answer.method, Words{StudyMethod::Nested});
  formula_members(v, word(answer.method));
  v.member("model", s.model ? std::optional(word(*s.model)) : std::nullopt,
           "interaction or pooled, of anova");
  members(v, sigmas);
  v.member("ndc", s.ndc, "Distinct categories");
  v.member("contribution_percent", sigmas.each([&](long double sigma) {
    return kPercent * (sigma / s.tv) * (sigma / s.tv);
  }),
           "Percentage of the variance");
  v.member("study_variation_percent",
           sigmas.each([&](long double sigma) { return kPercent * sigma / s.tv; }),
           "Percentage of six total standard deviations");
  v.member("tolerance_percent",
           sigmas.each([&](long double sigma) { return kPercent * 6 * sigma / tolerance; }),
           "Percentage of the tolerance; null without a tolerance");
  v.member("interaction_p", s.interaction_p);
  v.member("anova", s.anova, AnovaTable{}, "Lines of the ANOVA table by name");
  v.optional("intervals", s.intervals,
             "Intervals of the standard deviations; average_range has none");
  v.optional("measuring_process", answer.process, "Present if requested");
}

void members(auto& v, const metrology::LinearityStudy::Coefficient& of) {
  v.member("value", of.value);
  v.member("standard_error", of.standard_error);
  v.member("p", of.p);
}
void members(auto& v, const metrology::LinearityStudy::Bias& of) {
  v.member("reference", of.reference);
  v.member("count", of.count);
  v.member("bias", of.bias);
  v.member("p", of.p);
}
void members(auto& v, const metrology::LinearityStudy& study) {
  v.member("method", "linearity", Word{"linearity"});
  formula_members(v, "linearity");
  v.member("slope", study.slope, "Slope of the bias over the reference");
  v.member("intercept", study.intercept);
  v.member("r_squared", study.r_squared);
  v.member("residual_standard_deviation", study.residual_standard_deviation);
  v.member("linearity_percent", 100 * std::abs(study.slope.value));
  v.member("average_bias", study.average_bias);
  v.member("references", study.references);
}

struct StabilityAnswer {
  metrology::ControlCharts charts{};
};
void members(auto& v, const StabilityAnswer& answer) {
  v.member("method", "stability", Word{"stability"});
  formula_members(v, "stability");
  v.member("stable", answer.charts.violations.empty(), "true if no rule is broken");
  chart_members(v, answer.charts, {});
}

namespace {

/// Parts that each operator has for himself: numbered within the operator that measured them.
void number_within_operators(metrology::Readings& readings) {
  std::vector<std::map<std::size_t, std::size_t>> numbers(readings.operator_count);
  readings.parts = 0;
  for (std::size_t i = 0; i < readings.part.size(); ++i) {
    auto& own = numbers[readings.operators[i]];
    readings.part[i] = own.try_emplace(readings.part[i], own.size()).first->second;
    readings.parts = std::max(readings.parts, own.size());
  }
}

Result<std::string> components(const JsonValue& body) {
  auto order = TRY(read_whole<VariationOrder>(body));
  metrology::Readings& readings = order.readings;
  readings.parts = order.parts.size();
  readings.operator_count = order.operators.size();
  if (order.method == StudyMethod::Nested) number_within_operators(readings);
  auto study =
      metrology::study_gauge(readings, order.method, order.choices.model, order.confidence);
  if (!study) return at_member("measurements", study.error());
  VariationAnswer answer{order.method, *std::move(study), order.choices.tolerance};
  if (order.process) {
    using metrology::Component;
    const double tolerance = answer.tolerance ? metrology::nearest_double(*answer.tolerance)
                                              : std::numeric_limits<double>::quiet_NaN();
    auto& found = answer.process.emplace(*order.process, tolerance).found;
    const auto put = [&](Component to, long double sigma) {
      if (!std::isnan(sigma)) found[to] = static_cast<double>(sigma);
    };
    put(Component::Evo, answer.study.ev);
    put(Component::Av, answer.study.av);
    put(Component::Ia, answer.study.interaction);
  }
  return body_json(answer);
}

Result<std::string> linearity(const JsonValue& body) {
  const auto order = TRY(read_whole<LinearityOrder>(body));
  const auto study = metrology::study_linearity(order.values, order.references);
  if (!study) return at_member("measurements", study.error());
  return body_json(*study);
}

Result<std::string> stability(const JsonValue& body) {
  const auto order = TRY(read_whole<StabilityOrder>(body));
  const metrology::Decimals& values = order.values;
  std::vector<std::vector<metrology::Wide>> groups(order.times.size());
  for (std::size_t i = 0; i < order.time.size(); ++i)
    groups[order.time[i]].push_back(values.counts()[i]);
  std::vector<metrology::Wide> counts;
  for (const auto& group : groups) {
    if (group.size() != groups.front().size()) {
      return at_member("measurements", {ErrorCode::StatisticsUnbalanced,
                                        "each time must have the same number of readings"});
    }
    counts.insert(counts.end(), group.begin(), group.end());
  }
  const metrology::Subgroups data{.values = metrology::Decimals(std::move(counts), values.scale()),
                                  .size = groups.front().size()};
  auto charts = metrology::make_charts(
      data, {.kind = data.size > 1 ? metrology::ChartKind::XbarR : metrology::ChartKind::IMr,
             .rules = metrology::ZoneRules::all()});
  if (!charts) return at_member("measurements", charts.error());
  return body_json(StabilityAnswer{*std::move(charts)});
}

}  // namespace

Result<std::string> gauge_study(const JsonValue& body) {
  const JsonValue& given = body.member("method");
  const bool is_text = given.is(JsonValue::Kind::String);
  const std::string_view method = is_text ? std::string_view(given.text) : word(StudyMethod::Anova);
  if (method == "linearity") return linearity(body);
  if (method == "stability") return stability(body);
  if (method == "attribute") return attribute_study(body);
  if (metrology::study_method_from_word(method)) return components(body);
  return at_member("method", {ErrorCode::FieldInvalid,
                              "method must be one of: anova, average_range, type3, nested, "
                              "linearity, stability, attribute"});
}

void add_gauge_study_schemas(Schemas& schemas) {
  schemas.push_back(order_schema<VariationOrder>("VariationStudyOrder"));
  schemas.push_back(order_schema<LinearityOrder>("LinearityStudyOrder"));
  schemas.push_back(order_schema<StabilityOrder>("StabilityStudyOrder"));
  add_attribute_study_schemas(schemas);
  // An order without a method is of the variation, so that no word tells the choices apart.
  schemas.push_back(
      {"GaugeStudyOrder",
       schema::one_of({schema::ref("VariationStudyOrder"), schema::ref("LinearityStudyOrder"),
                       schema::ref("StabilityStudyOrder"), schema::ref("AttributeStudyOrder")})});
  schemas.push_back(answer_schema<VariationAnswer>("VariationStudy"));
  schemas.push_back(answer_schema<metrology::LinearityStudy>("LinearityStudy"));
  schemas.push_back(answer_schema<StabilityAnswer>("StabilityStudy"));
  schemas.push_back({"GaugeStudy", schema::one_of("method", {{"anova", "VariationStudy"},
                                                             {"average_range", "VariationStudy"},
                                                             {"type3", "VariationStudy"},
                                                             {"nested", "VariationStudy"},
                                                             {"linearity", "LinearityStudy"},
                                                             {"stability", "StabilityStudy"},
                                                             {"attribute", "AttributeStudy"}})});
}

}  // namespace fitgauge::api
