#include "api/resources.hpp"

#include "api/handlers.hpp"
#include "api/measurements/measurement_listing.hpp"
#include "api/statistics/statistics_answers.hpp"
#include "api/statistics/value_selection.hpp"
#include "api/wire/formulas.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

using metrology::ChartKind;

constexpr int kScale = 6;
constexpr double kMillion = 1e6;

/// A computation over a selection, given the newest id.
using Figure = std::function<Result<std::string>(ValueSelection&&, const std::string& as_of)>;

/// Reads the values of the filters and computes from them; both may be slow.
void answer_with(const Services& services, const http::Request& request, http::Responder responder,
                 Figure figure) {
  auto query = measurement_query(services, request);
  if (!query) return responder.fail(query.error());
  if (const auto last = request.integer("last")) query->last = static_cast<std::size_t>(*last);
  services.jobs.figures.run(
      [&services, query = *std::move(query),
       figure = std::move(figure)]() -> Result<http::Response> {
        ValueSelection selection;
        const auto read = TRY(selection.read(services.measurements, query));
        return json_response(figure(std::move(selection), read));
      },
      answer_by(share(std::move(responder))));
}

/// The subgroup or the measurement that a point is of. A moving range is named by its later value.
NamePoint name_in(const SelectedValues& selected) {
  return [&selected](NamedViolation& named) {
    if (!selected.subgroups.empty()) {
      named.subgroup = selected.subgroups[named.violation.index];
    } else {
      const std::size_t later = named.violation.chart == "mr" ? 1 : 0;
      named.id = selected.ids.text(named.violation.index + later);
    }
  };
}

void find_capability(const Services& services, const http::Request& request,
                     http::Responder responder) {
  const auto target = request.length("target_mm");
  constexpr std::int64_t kUsual = 950'000;
  const long double confidence =
      static_cast<long double>(request.integer("confidence").value_or(kUsual)) / kMillion;
  answer_with(services, request, std::move(responder),
              [target, confidence, ignore = ignores_subgroups(request)](
                  ValueSelection&& selection, const std::string& as_of) -> Result<std::string> {
                auto selected = TRY(std::move(selection).selected(ignore));
                if (target) selected.limits.target = exact_mm(*target);
                auto made =
                    TRY(metrology::assess_capability(selected.data, selected.limits, confidence));
                return body_json(Stored<CapabilityAnswer>{
                    selection_of(selected, as_of),
                    {std::move(made), selected.limits, confidence, name_in(selected)}});
              });
}

Error invalid(std::string_view parameter, std::string message) {
  return {ErrorCode::QueryInvalid, std::move(message), std::string(parameter)};
}

/// `1,2,3,4`, in any order.
Result<metrology::ZoneRules> parse_rules(std::string_view text) {
  metrology::ZoneRules rules;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_digit = i % 2 == 0;
    const bool fits = is_digit ? text[i] >= '1' && text[i] <= '4' : text[i] == ',';
    if (!fits || text.size() % 2 == 0) {
      return invalid("rules", "rules must contain only 1, 2, 3 and 4, with commas: rules=1,2");
    }
    if (is_digit) rules.add(text[i] - '0');
  }
  return rules;
}

double scaled(const http::Request& request, std::string_view name, double fallback) {
  const auto given = request.integer(name);
  return given ? static_cast<double>(*given) / kMillion : fallback;
}

/// A plan whose kind may still depend on whether the values name subgroups.
struct StoredChartPlan {
  metrology::ChartPlan plan;
  bool has_kind = false;
  bool ignores_subgroups = false;
};

Result<StoredChartPlan> chart_plan(const http::Request& request) {
  StoredChartPlan stored;
  metrology::ChartPlan& plan = stored.plan;
  if (const auto kind = request.text("kind")) {
    plan.kind = *metrology::chart_kind_from_word(*kind);
    stored.has_kind = true;
  }
  stored.ignores_subgroups =
      ignores_subgroups(request) || (stored.has_kind && plan.kind == ChartKind::IMr);
  plan.rules = TRY(parse_rules(request.text("rules").value_or("")));
  plan.lambda = scaled(request, "lambda", plan.lambda);
  plan.reference_value = scaled(request, "reference_value", plan.reference_value);
  plan.decision_interval = scaled(request, "decision_interval", plan.decision_interval);
  const auto from = request.integer("phase1_from");
  const auto to = request.integer("phase1_to");
  if (from && !to) return invalid("phase1_to", "phase1_from needs phase1_to, which is exclusive");
  std::optional<Error> unused;
  refuse_not_applicable(
      chart_members(), "kind", word(plan.kind),
      [&](const Applicable& row) { return request.has(row.member); },
      [&](std::string_view member, std::string message) {
        unused = invalid(member, std::move(message));
      });
  if (unused) return *std::move(unused);
  if (to) plan.phase1 = {static_cast<std::size_t>(from.value_or(0)), static_cast<std::size_t>(*to)};
  return stored;
}

void find_chart(const Services& services, const http::Request& request, http::Responder responder) {
  auto stored = chart_plan(request);
  if (!stored) return responder.fail(stored.error());
  answer_with(services, request, std::move(responder),
              [stored = *std::move(stored)](ValueSelection&& selection,
                                            const std::string& as_of) -> Result<std::string> {
                metrology::ChartPlan plan = stored.plan;
                auto selected = TRY(std::move(selection).selected(stored.ignores_subgroups));
                if (!stored.has_kind && selected.data.size > 1) plan.kind = ChartKind::XbarR;
                auto made = TRY(metrology::make_charts(selected.data, plan));
                selected.data = {};
                std::string out;
                constexpr std::size_t kOfAPoint = 12;  // unused room needs no memory
                out.reserve(2 * kOfAPoint * selected.count);
                JsonWriter json(out);
                write_body(json,
                           Stored<ChartAnswer>{selection_of(selected, as_of),
                                               {plan.kind, std::move(made), name_in(selected)}});
                return out;
              });
}

std::vector<http::Parameter> with_stored_filters(std::vector<http::Parameter> own) {
  auto parameters = measurement_filter_parameters();
  own.push_back(subgroups_parameter());
  constexpr std::int64_t kMostOfLast = 1'000'000;
  own.push_back({.name = "last",
                 .type = http::Integer{.min = 1, .max = kMostOfLast},
                 .description = "Only this number of the newest matches"});
  parameters.insert(parameters.end(), own.begin(), own.end());
  return parameters;
}

/// A number up to `most`, of `least` millionths at least.
http::Parameter number(std::string name, std::int64_t least, std::int64_t most,
                       std::string description) {
  return {.name = std::move(name),
          .type = http::Decimal{.scale = kScale, .min = least, .max = most * 1'000'000},
          .description = std::move(description)};
}

std::vector<http::Parameter> chart_parameters() {
  constexpr std::int64_t kMost = 100'000'000;
  return with_stored_filters({
      {.name = "kind",
       .type = http::Words{{"i_mr", "xbar_r", "xbar_s", "ewma", "cusum"}},
       .description = "Kind of chart (default: xbar_r with subgroups, else i_mr)"},
      {.name = "rules", .description = "Rules of Western Electric 1956: 1,2,3,4 (default: none)"},
      number("lambda", 1'000, 1, "Weight of ewma (default: 0.2)"),
      number("reference_value", 1, 10,
             "Reference value k of cusum, in standard deviations (default: 0.5)"),
      number("decision_interval", 1, 20,
             "Decision interval h of cusum, in standard deviations (default: 5)"),
      {.name = "phase1_from",
       .type = http::Integer{.min = 0, .max = kMost},
       .description = "First point the limits are taken from (default: 0)"},
      {.name = "phase1_to",
       .type = http::Integer{.min = 0, .max = kMost},
       .description = "End of these points, exclusive (default: all)"},
  });
}

}  // namespace

void add_stored_statistics_routes(Routes& add) {
  add("GET /v1/measurements/capability assessStoredCapability viewer", find_capability,
      {.summary = "Capability and performance of stored values",
       .description = "Against the limits in the records, which must be the same in all.",
       .parameters = with_stored_filters(
           {{.name = "target_mm",
             .type = http::LengthIn{},
             .description = "Target of cpm (default: the middle of the limits)"},
            {.name = "confidence",
             .type = http::Decimal{.scale = kScale, .min = 1, .max = 999'999},
             .description = "Confidence of the intervals (default: 0.95)"}}),
       .outcomes = {{.meaning = "Computed figures", .schema = "StoredCapability"}},
       .refusals = {422}});
  add("GET /v1/measurements/chart makeStoredControlChart viewer", find_chart,
      {.summary = "Control chart of stored values",
       .description = "In storage order; a violation names its measurement or subgroup.",
       .parameters = chart_parameters(),
       .outcomes = {{.meaning = "Computed figures", .schema = "StoredControlChart"}},
       .refusals = {422}});
}

}  // namespace fitgauge::api
