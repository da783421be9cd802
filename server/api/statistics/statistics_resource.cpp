#include "api/statistics/measuring_process.hpp"
#include "api/statistics/statistics_answers.hpp"
#include "metrology/statistics/fit_analysis.hpp"
#include "metrology/statistics/gauge_study.hpp"

namespace fitgauge::api {

struct SummaryOrder {
  metrology::Decimals values{};
};
void members(auto& v, SummaryOrder& order) { v.member("values", order.values, "One or more"); }

void members(auto& v, const metrology::Quantile& quantile) {
  v.member("p", quantile.p);
  v.member("value", quantile.value);
}

struct Quantiles {
  std::vector<metrology::Quantile> values{};
};
void members(auto& v, const Quantiles& quantiles) {
  v.member("type", 7, Integer{7, 7}, "Hyndman and Fan 1996");
  v.member("values", quantiles.values);
}

void members(auto& v, const metrology::Summary& summary) {
  formula_members(v, "summary");
  v.member("count", summary.moments.count);
  v.member("mean", summary.moments.mean);
  v.member("standard_deviation", summary.moments.standard_deviation());
  v.member("autocorrelation_lag_1", summary.autocorrelation_lag_1);
  v.member("min", summary.min);
  v.member("max", summary.max);
  v.member("quantiles", Quantiles{{summary.quantiles.begin(), summary.quantiles.end()}});
}

struct GroupsOrder {
  metrology::Groups groups{};
};
void members(auto& v, GroupsOrder& order) {
  v.member("groups", order.groups, "Two or more, of any size");
}

void members(auto& v, const metrology::Anova& anova) {
  formula_members(v, "anova_one_way");
  v.member("between", anova.between, "Groups");
  v.member("within", anova.within, "Variation within the groups");
  members(v, anova.test);
  v.member("r_squared", anova.r_squared);
  v.member("residual_standard_deviation", anova.residual_standard_deviation);
}

struct CapabilityOrder {
  metrology::Subgroups data{};
  metrology::SpecificationLimits limits{};
  double confidence = 0.95;
};
void members(auto& v, CapabilityOrder& order) {
  data_members(v, order.data);
  v.optional("lower", order.limits.lower, "Lower limit; give lower, upper or both");
  v.optional("upper", order.limits.upper);
  v.optional("target", order.limits.target, "Target of cpm (default: the middle of the limits)");
  v.check([](FieldReader& fields) {
    if (!fields.has("lower") && !fields.has("upper"))
      fields.report(ErrorCode::FieldMissing, "upper", "give lower, upper or both");
  });
  v.optional("confidence", order.confidence,
             Number{.least = 0, .most = 1, .ends = Number::Ends::Open},
             "Confidence of the intervals");
}

void members(auto& v, metrology::ChartPlan::Phase& phase) {
  constexpr std::int64_t kMost = 100'000'000;
  v.optional("from", phase.from, Integer{0, kMost});
  v.member("to", phase.to, Integer{0, kMost}, "Exclusive");
}

/// The form of rules by their numbers.
struct Rules {
  std::string schema(Side) const {
    return schema::array(schema::integer(1, metrology::ZoneRules::kCount));
  }
  bool read(FieldReader& fields, std::string_view name, metrology::ZoneRules& to) const {
    const JsonValue* array = fields.array(name);
    if (array == nullptr) return false;
    for (const JsonValue& item : array->items) {
      const int rule = item.text.size() == 1 ? item.text[0] - '0' : 0;
      if (!item.is(JsonValue::Kind::Number) || rule < 1 || rule > metrology::ZoneRules::kCount) {
        fields.report(ErrorCode::FieldInvalid, name, "rules must contain only 1, 2, 3 and 4");
        return false;
      }
      to.add(rule);
    }
    return true;
  }
};

struct ChartOrder {
  metrology::ChartPlan plan{};
  metrology::Subgroups data{};
};
void members(auto& v, ChartOrder& order) {
  metrology::ChartPlan& plan = order.plan;
  constexpr double kLeast = 1e-6;
  v.member("kind", plan.kind, Words{metrology::ChartKind::Cusum});
  data_members(v, order.data);
  v.optional("rules", plan.rules, Rules{}, "Rules (default: none)");
  v.optional("phase1", plan.phase1, "The points the limits are taken from");
  v.optional("centre", plan.centre, "Known centre");
  v.optional("standard_deviation", plan.standard_deviation,
             PositiveExact{ErrorCode::FieldInvalid, "a known standard deviation must be above 0"},
             "Known standard deviation of single values, above 0");
  v.optional("lambda", plan.lambda, Number{metrology::kLeastLambda, 1}, "Weight of ewma");
  v.optional("reference_value", plan.reference_value, Number{kLeast, 10},
             "Reference value k of cusum, in standard deviations");
  v.optional("decision_interval", plan.decision_interval, Number{kLeast, 20},
             "Decision interval h of cusum, in standard deviations");
  v.check([&plan](FieldReader& fields) {
    // Limits are known from `centre` and `standard_deviation`; otherwise one of them is estimated.
    static constexpr std::array<Applicable, 1> kOfLimits = {{{"phase1", "estimated"}}};
    const bool is_known = plan.centre && plan.standard_deviation;
    fields.refuse_not_applicable(kChartMembers, "kind", word(plan.kind));
    fields.refuse_not_applicable(kOfLimits, "limits", is_known ? "known" : "estimated");
  });
}

struct Type1Order {
  metrology::Decimals values{};
  metrology::Exact reference{};
  metrology::Exact tolerance{};
  metrology::Type1Rule rule{};
  std::optional<MeasuringOrder<false>> system{};
};
void members(auto& v, Type1Order& order) {
  v.member("values", order.values, "Two or more, of one master");
  v.member("reference", order.reference, "The size of the master");
  v.member("tolerance", order.tolerance, kTolerance, "Tolerance of the characteristic to measure");
  v.optional("tolerance_percent", order.rule.percent, Integer{1, 100},
             "Percentage of the tolerance in Cg");
  v.optional("spread", order.rule.spread, Integer{2, 6}, "Standard deviations that Cg compares");
  v.optional("measuring_system", order.system,
             "Contributions for the capability of the measuring system (ISO 22514-7)");
}

struct Type1Answer {
  metrology::Type1Study study{};
  std::optional<MeasuringAnswer<false>> system{};
};
void members(auto& v, const Type1Answer& answer) {
  const metrology::Type1Study& study = answer.study;
  formula_members(v, "type1");
  v.member("count", study.count);
  v.member("mean", study.mean);
  v.member("standard_deviation", study.standard_deviation);
  v.member("bias", study.bias);
  v.member("t", study.t);
  v.member("p", study.p);
  v.member("cg", study.cg);
  v.member("cgk", study.cgk);
  v.optional("measuring_system", answer.system, "Present if requested");
}

/// The form of sizes in mm.
struct Sizes {
  std::string schema(Side) const { return schema::array(schema::exact()); }
  bool read(FieldReader& fields, std::string_view name, std::vector<Length>& to) const {
    const JsonValue* array = fields.array(name);
    if (array == nullptr) return false;
    for (std::size_t i = 0; i < array->items.size(); ++i) {
      const JsonValue& item = array->items[i];
      const std::string pointer = pointer_to(fields.at(name), i);
      const bool is_number = item.is(JsonValue::Kind::Number);
      if (!is_number && !item.is(JsonValue::Kind::String)) {
        fields.errors().add(ErrorCode::FieldType, pointer,
                            fmt::format("must be a size in mm; got {}", name_of(item.kind)));
        continue;
      }
      const auto size =
          parse_length_mm(item.text, {.exponent = is_number, .round_to_nearest = true});
      if (size) {
        to.push_back(*size);
      } else {
        fields.errors().add(size.error().code, pointer, size.error().message);
      }
    }
    return true;
  }
};

/// A body may use either name of each list.
struct PairingOrder {
  std::string_view holes_name = "holes";
  std::string_view shafts_name = "shafts";
  std::vector<Length> holes{};
  std::vector<Length> shafts{};
  Length target{};
};
void members(auto& v, PairingOrder& order) {
  v.member(order.holes_name, order.holes, Sizes{}, "Measured sizes in mm");
  v.member(order.shafts_name, order.shafts, Sizes{}, "Measured sizes in mm");
  v.member("target_clearance_um", order.target, Micrometres{}, "Interference is negative");
}

std::string pairing_schema() {
  PairingOrder other{.holes_name = "holes_mm", .shafts_name = "shafts_mm"};
  BodySchema of_other(Side::Order);
  members(of_other, other);
  return schema::one_of({schema_of<PairingOrder>(Side::Order), of_other.json()});
}

void members(auto& v, const metrology::Pair& pair) {
  v.member("hole", pair.hole, "Index, from 0");
  v.member("shaft", pair.shaft, "Index, from 0");
  v.member("clearance_um", pair.clearance, Micrometres{});
}

struct Pairing {
  std::vector<metrology::Pair> pairs{};
};
void members(auto& v, const Pairing& pairing) {
  formula_members(v, "pairing");
  v.member("pairs", pairing.pairs);
}

namespace {

Result<std::string> summary(const JsonValue& body) {
  const auto order = TRY(read_whole<SummaryOrder>(body));
  return body_json(metrology::summarise(order.values));
}

Result<std::string> anova(const JsonValue& body) {
  const auto order = TRY(read_whole<GroupsOrder>(body));
  const auto made = metrology::analyse_variance(order.groups.counts());
  if (!made) return at_member("groups", made.error());
  return body_json(*made);
}

std::string_view data_member(const JsonValue& body) {
  return body.find("subgroups") != nullptr ? "subgroups" : "values";
}

/// Room for one in the text of an answer.
constexpr std::size_t kViolationText = 42;
constexpr std::size_t kPointText = 26;

/// The JSON of a long answer: a text that grows is there twice for a moment.
template <class T>
std::string body_json(const T& answer, std::size_t room) {
  std::string out;
  out.reserve(room);
  JsonWriter json(out);
  write_body(json, answer);
  return out;
}

Result<std::string> capability(JsonValue& body) {
  const auto order = TRY(read_whole<CapabilityOrder>(body));
  const std::string_view data = data_member(body);
  body = {};  // a list of values takes most of the memory
  auto made = metrology::assess_capability(order.data, order.limits, order.confidence);
  if (!made) {
    const Error error = made.error();
    const bool of_limits = error.code == ErrorCode::LimitsInvalid;
    const std::string_view member = of_limits ? "upper" : data;
    return at_member(error.where.empty() ? member : error.where, error);
  }
  const std::size_t room = made->violations.size() * kViolationText;
  return body_json(CapabilityAnswer{*std::move(made), order.limits, order.confidence}, room);
}

Result<std::string> chart(JsonValue& body) {
  const auto order = TRY(read_whole<ChartOrder>(body));
  const std::string_view data = data_member(body);
  body = {};
  auto made = metrology::make_charts(order.data, order.plan);
  if (!made) {
    const std::string& where = made.error().where;
    return at_member(where.empty() ? data : where, made.error());
  }
  const std::size_t room =
      made->violations.size() * kViolationText + 2 * order.data.count() * kPointText;
  return body_json(ChartAnswer{order.plan.kind, *std::move(made)}, room);
}

Result<std::string> pairing(const JsonValue& body) {
  FieldErrors errors;
  PairingOrder order;
  const auto choose = [&](std::string_view& name, std::string_view other) {
    if (body.find(other) == nullptr) return;
    if (body.find(name) != nullptr)
      errors.add(ErrorCode::FieldConflict, fmt::format("/{}", other),
                 fmt::format("give {} or {}, not both", name, other));
    name = other;
  };
  choose(order.holes_name, "holes_mm");
  choose(order.shafts_name, "shafts_mm");
  if (auto error = errors.take()) return *std::move(error);
  read_body(body, "", errors, order);
  if (auto error = errors.take()) return *std::move(error);
  auto made = metrology::pair(order.holes, order.shafts, order.target);
  if (!made)
    return at_member(order.holes.empty() ? order.holes_name : order.shafts_name, made.error());
  return body_json(Pairing{*std::move(made)});
}

}  // namespace

Result<std::string> master_study(const JsonValue& body) {
  const auto order = TRY(read_whole<Type1Order>(body));
  const auto made =
      metrology::study_type1(order.values, order.reference, order.tolerance, order.rule);
  if (!made) return at_member("values", made.error());
  Type1Answer answer{*made};
  if (order.system) {
    auto& system = answer.system.emplace(*order.system, metrology::nearest_double(order.tolerance));
    system.found[metrology::Component::Bi] =
        static_cast<double>(std::abs(made->bias) / std::sqrt(3.0L));
    system.found[metrology::Component::Evr] = static_cast<double>(made->standard_deviation);
  }
  return body_json(answer);
}

void add_statistics_routes(Routes& add) {
  const std::initializer_list<Computation> computations = {
      {"/v1/statistics/summary computeSummary", summary, "Values", "ValueSummary",
       "Count, mean, standard deviation, r(1), extremes and quantiles",
       "Exact sums of decimals, rounded once to 17 digits."},
      {"/v1/statistics/anova analyseVariance", anova, "Groups", "Anova",
       "One-way analysis of variance"},
      {"/v1/statistics/capability assessCapability", capability, "CapabilityOrder", "Capability",
       "Capability and performance indices with their intervals"},
      {"/v1/statistics/chart makeControlChart", chart, "ChartOrder", "ControlChart",
       "Control chart with the violations of its rules and their price"},
      {"/v1/statistics/type1 studyGaugeOnMaster", master_study, "Type1Order", "Type1Study",
       "Repeatability and bias of a gauge on one master: Cg, Cgk"},
      {"/v1/statistics/grr studyGauge", gauge_study, "GaugeStudyOrder", "GaugeStudy",
       "Gauge study: repeatability, reproducibility, parts",
       "`method` selects repeatability and reproducibility, linearity, stability, or agreement of "
       "ratings."},
      {"/v1/statistics/pairing pairParts", pairing, "PairingOrder", "Pairing",
       "Measured holes and shafts paired for a clearance",
       "The least sum of squares of all assignments. The sizes may also be called "
       "holes_mm and shafts_mm."},
  };
  for (const Computation& computation : computations) add_computation(add, computation);
}

void add_statistics_schemas(Schemas& schemas) {
  schemas.push_back(order_schema<SummaryOrder>("Values"));
  schemas.push_back(answer_schema<metrology::Summary>("ValueSummary"));
  schemas.push_back(order_schema<GroupsOrder>("Groups"));
  schemas.push_back(answer_schema<metrology::Anova>("Anova"));
  schemas.push_back(order_schema<CapabilityOrder>("CapabilityOrder"));
  schemas.push_back(answer_schema<IndexAnswer>("CapabilityIndex"));
  schemas.push_back(answer_schema<CapabilityAnswer>("Capability"));
  schemas.push_back(answer_schema<Stored<CapabilityAnswer>>("StoredCapability"));
  schemas.push_back(order_schema<ChartOrder>("ChartOrder"));
  schemas.push_back(answer_schema<ChartAnswer>("ControlChart"));
  schemas.push_back(answer_schema<Stored<ChartAnswer>>("StoredControlChart"));
  schemas.push_back(order_schema<Type1Order>("Type1Order"));
  schemas.push_back(answer_schema<Type1Answer>("Type1Study"));
  add_gauge_study_schemas(schemas);
  schemas.push_back({"PairingOrder", pairing_schema()});
  schemas.push_back(answer_schema<Pairing>("Pairing"));
  add_uncertainty_schemas(schemas);
  add_documents_schemas(schemas);
  add_changes_schemas(schemas);
  add_compensation_schemas(schemas);
}

}  // namespace fitgauge::api
