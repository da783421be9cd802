#include "api/resources.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "api/statistics/computation.hpp"
#include "api/statistics/exact_reader.hpp"
#include "api/statistics/gauge_study_reader.hpp"
#include "api/statistics/statistics_codec.hpp"
#include "api/wire/formulas.hpp"
#include "metrology/statistics/pairing.hpp"
#include "metrology/statistics/run_length.hpp"

namespace fitgauge::api {
namespace {

using metrology::Exact;

Result<std::string> summary(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  const metrology::Decimals values = read_values(fields, "values", errors);
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  std::string out;
  JsonWriter json(out);
  write_summary(json, metrology::summarise(values));
  return out;
}

Result<std::string> anova(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  const metrology::Groups groups = read_groups(fields, "groups", errors);
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  const auto made = metrology::analyse_variance(groups.counts());
  if (!made) return at_member("groups", made.error());
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_formula(json, "anova_one_way");
  json.key("between").begin_object();
  write_variation_members(json, made->between);
  json.end_object().key("within").begin_object();
  write_variation_members(json, made->within);
  json.end_object();
  write_test_members(json, made->test);
  json.key("r_squared").figure(made->r_squared);
  json.key("residual_standard_deviation").figure(made->residual_standard_deviation).end_object();
  return out;
}

std::string_view data_member(const JsonValue& body) {
  return body.find("subgroups") != nullptr ? "subgroups" : "values";
}

Result<std::string> capability(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  const metrology::Subgroups data = read_subgroups(fields, errors);
  const metrology::SpecificationLimits limits{
      .lower = read_exact(fields, "lower", false, errors),
      .upper = read_exact(fields, "upper", false, errors),
      .target = read_exact(fields, "target", false, errors)};
  if (!fields.has("lower") && !fields.has("upper")) {
    fields.report(ErrorCode::FieldMissing, "upper", "give lower, upper or both");
  }
  const double confidence = fields.number_or("confidence", 0.95);
  if (!(confidence > 0 && confidence < 1)) {
    fields.report(ErrorCode::FieldInvalid, "confidence", "confidence lies between 0 and 1");
  }
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  const auto made = metrology::assess_capability(data, limits, confidence);
  if (!made) {
    const Error error = made.error();
    const bool of_limits = error.code == ErrorCode::LimitsInvalid;
    const std::string_view member = of_limits ? "upper" : data_member(body);
    return at_member(error.where.empty() ? member : error.where, error);
  }
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_capability_members(json, *made, limits, confidence);
  json.end_object();
  return out;
}

metrology::ZoneRules read_rules(FieldReader& fields) {
  metrology::ZoneRules rules;
  if (!fields.has("rules")) {
    fields.optional("rules");
    return rules;
  }
  const JsonValue* array = fields.array("rules");
  if (array == nullptr) return rules;
  for (const JsonValue& item : array->items) {
    const bool known = item.is(JsonValue::Kind::Number) && item.text.size() == 1 &&
                       item.text[0] >= '1' && item.text[0] <= '4';
    if (known) {
      rules.add(item.text[0] - '0');
    } else {
      fields.report(ErrorCode::FieldInvalid, "rules", "rules are of 1, 2, 3 and 4");
      return rules;
    }
  }
  return rules;
}

std::optional<metrology::ChartPlan::Phase> read_phase(FieldReader& fields, FieldErrors& errors) {
  if (!fields.has("phase1")) return std::nullopt;
  const JsonValue* object = fields.object("phase1");
  if (object == nullptr) return std::nullopt;
  constexpr std::int64_t kMost = 100'000'000;
  FieldReader phase(*object, fields.at("phase1"), errors);
  const auto from = phase.integer_or("from", 0, 0, kMost);
  if (!phase.has("to")) phase.report(ErrorCode::FieldMissing, "to", "to is required");
  const auto to = phase.integer_or("to", 0, 0, kMost);
  phase.refuse_unknown();
  return metrology::ChartPlan::Phase{static_cast<std::size_t>(from), static_cast<std::size_t>(to)};
}

/// A number within ends that belong to it, or its fallback.
double number_between(FieldReader& fields, std::string_view name, double fallback, double least,
                      double most) {
  const double value = fields.number_or(name, fallback);
  if (value >= least && value <= most) return value;
  fields.report(ErrorCode::FieldInvalid, name,
                fmt::format("{} lies from {} to {}", name, least, most));
  return fallback;
}

/// Limits are known by `centre` and `standard_deviation`, else something of them is estimated.
constexpr std::array<Applicable, 1> kLimitMembers = {{{"phase1", "estimated"}}};

metrology::ChartPlan read_plan(FieldReader& fields, FieldErrors& errors) {
  metrology::ChartPlan plan;
  if (const auto text = fields.text("kind")) {
    const auto kind = metrology::chart_kind_from_word(*text);
    if (!kind) {
      fields.report(ErrorCode::FieldInvalid, "kind", "kind is i_mr, xbar_r, xbar_s, ewma or cusum");
    }
    plan.kind = kind.value_or(plan.kind);
  }
  plan.rules = read_rules(fields);
  plan.phase1 = read_phase(fields, errors);
  plan.centre = read_exact(fields, "centre", false, errors);
  plan.standard_deviation = read_exact(fields, "standard_deviation", false, errors);
  if (plan.standard_deviation && *plan.standard_deviation <= 0) {
    fields.report(ErrorCode::FieldInvalid, "standard_deviation",
                  "a known standard deviation is above 0");
  }
  constexpr double kLeast = 1e-6;
  plan.lambda = number_between(fields, "lambda", plan.lambda, metrology::kLeastLambda, 1);
  plan.reference_value =
      number_between(fields, "reference_value", plan.reference_value, kLeast, 10);
  plan.decision_interval =
      number_between(fields, "decision_interval", plan.decision_interval, kLeast, 20);
  fields.optional("phase1");
  const auto given = [&](const Applicable& row) { return fields.has(row.member); };
  const auto refuse = [&](std::string_view member, std::string message) {
    fields.report(ErrorCode::FieldConflict, member, std::move(message));
  };
  refuse_not_applicable(chart_members(), "kind", word(plan.kind), given, refuse);
  const bool is_known = plan.centre && plan.standard_deviation;
  refuse_not_applicable(kLimitMembers, "limits", is_known ? "known" : "estimated", given, refuse);
  return plan;
}

Result<std::string> chart(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  const metrology::ChartPlan plan = read_plan(fields, errors);
  const metrology::Subgroups data = read_subgroups(fields, errors);
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  const auto made = metrology::make_charts(data, plan);
  if (!made) {
    const std::string& where = made.error().where;
    return at_member(where.empty() ? data_member(body) : where, made.error());
  }
  std::string out;
  JsonWriter json(out);
  json.begin_object().member("kind", word(plan.kind));
  write_formula(json, word(plan.kind));
  write_chart_members(json, *made);
  json.end_object();
  return out;
}

Result<std::string> type1(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  const metrology::Decimals values = read_values(fields, "values", errors);
  const auto reference = read_exact(fields, "reference", true, errors);
  const auto tolerance = read_exact(fields, "tolerance", true, errors);
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  const auto made = metrology::study_type1(values, *reference, *tolerance);
  if (!made) {
    const bool of_tolerance = made.error().code == ErrorCode::LimitsInvalid;
    return at_member(of_tolerance ? "tolerance" : "values", made.error());
  }
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_formula(json, "type1");
  json.member("count", std::uint64_t{made->count}).key("mean").figure(made->mean);
  json.key("standard_deviation").figure(made->standard_deviation).key("bias").figure(made->bias);
  json.key("t").figure(made->t).key("p").figure(made->p);
  json.key("cg").figure(made->cg).key("cgk").figure(made->cgk).end_object();
  return out;
}

/// Sizes of measured parts, under either of two names.
std::vector<Length> read_sizes(FieldReader& fields, std::string_view name, std::string_view other,
                               FieldErrors& errors) {
  const std::string_view given = fields.has(other) && !fields.has(name) ? other : name;
  std::vector<Length> sizes;
  const JsonValue* array = fields.array(given);
  if (array == nullptr) return sizes;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const JsonValue& item = array->items[i];
    const std::string pointer = pointer_to(fields.at(given), i);
    if (!item.is(JsonValue::Kind::Number) && !item.is(JsonValue::Kind::String)) {
      errors.add(ErrorCode::FieldType, pointer,
                 fmt::format("a size in mm is wanted, not {}", name_of(item.kind)));
      continue;
    }
    const auto size = parse_length_mm(
        item.text, {.exponent = item.is(JsonValue::Kind::Number), .round_to_nearest = true});
    if (size) {
      sizes.push_back(*size);
    } else {
      errors.add(size.error().code, pointer, size.error().message);
    }
  }
  return sizes;
}

Result<std::string> pairing(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  const std::vector<Length> holes = read_sizes(fields, "holes", "holes_mm", errors);
  const std::vector<Length> shafts = read_sizes(fields, "shafts", "shafts_mm", errors);
  const auto target = fields.um("target_clearance_um");
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  const auto made = metrology::pair(holes, shafts, *target);
  if (!made) return at_member(holes.empty() ? "holes" : "shafts", made.error());
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_formula(json, "pairing");
  json.key("pairs").begin_array();
  for (const metrology::Pair& pair : *made) {
    json.begin_object()
        .member("hole", std::uint64_t{pair.hole})
        .member("shaft", std::uint64_t{pair.shaft})
        .member_um("clearance_um", pair.clearance)
        .end_object();
  }
  json.end_array().end_object();
  return out;
}

}  // namespace

void add_statistics_routes(std::vector<http::Route>& routes, const Services& services) {
  const std::initializer_list<Computation> computations = {
      {.pattern = "/v1/statistics/summary",
       .compute = summary,
       .summary = "Count, mean, standard deviation, r(1), extremes and quantiles",
       .description = "Exact sums of decimals, rounded once to 17 digits.",
       .operation = "computeSummary",
       .reads = "Values",
       .answers = "ValueSummary"},
      {.pattern = "/v1/statistics/anova",
       .compute = anova,
       .summary = "One-way analysis of variance",
       .operation = "analyseVariance",
       .reads = "Groups",
       .answers = "Anova"},
      {.pattern = "/v1/statistics/capability",
       .compute = capability,
       .summary = "Capability and performance indices with their intervals",
       .operation = "assessCapability",
       .reads = "CapabilityOrder",
       .answers = "Capability"},
      {.pattern = "/v1/statistics/chart",
       .compute = chart,
       .summary = "Control chart with the violations of its rules and their price",
       .operation = "makeControlChart",
       .reads = "ChartOrder",
       .answers = "ControlChart"},
      {.pattern = "/v1/statistics/type1",
       .compute = type1,
       .summary = "Repeatability and bias of a gauge on one master: Cg, Cgk",
       .operation = "studyGaugeOnMaster",
       .reads = "Type1Order",
       .answers = "Type1Study"},
      {.pattern = "/v1/statistics/grr",
       .compute = gauge_study,
       .summary = "Gauge study: repeatability, reproducibility, parts",
       .description = "Or its linearity, or its stability, by method.",
       .operation = "studyGauge",
       .reads = "GaugeStudyOrder",
       .answers = "GaugeStudy"},
      {.pattern = "/v1/statistics/pairing",
       .compute = pairing,
       .summary = "Measured holes and shafts paired for a clearance",
       .description = "The least sum of squares of all assignments. The sizes may also be called "
                      "holes_mm and shafts_mm.",
       .operation = "pairParts",
       .reads = "PairingOrder",
       .answers = "Pairing"},
  };
  for (const Computation& computation : computations) {
    routes.push_back(route_of(services, computation));
  }
}

}  // namespace fitgauge::api
