#include "api/measurements/measurements.hpp"
#include "api/statistics/statistics_answers.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

using metrology::ChartKind;

constexpr int kScale = 6;
constexpr double kMillion = 1e6;

/// A computation over a selection.
using Figure = std::function<Result<std::string>(ValueSelection&&)>;

/// Reads the values of the filters and computes from them; both may be slow.
void answer_with(const Services& services, const Request& request, Responder responder,
                 Figure figure) {
  auto query = TRY_OR_FAIL(responder, measurement_query(services, request));
  if (const auto last = request.integer("last")) query.last = static_cast<std::size_t>(*last);
  services.jobs.figures.run(
      [&services, query = std::move(query), figure = std::move(figure)]() -> Result<Response> {
        ValueSelection selection;
        TRY(selection.read(services.measurements, query));
        return json_response(figure(std::move(selection)));
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

void find_capability(const Services& services, const Request& request, Responder responder) {
  const auto target = request.length("target_mm");
  constexpr std::int64_t kUsual = 950'000;
  const long double confidence =
      static_cast<long double>(request.integer("confidence").value_or(kUsual)) / kMillion;
  answer_with(services, request, std::move(responder),
              [target, confidence, ignore = ignores_subgroups(request)](
                  ValueSelection&& selection) -> Result<std::string> {
                auto selected = TRY(std::move(selection).selected(ignore));
                if (target) selected.limits.target = exact_mm(*target);
                auto made =
                    metrology::assess_capability(selected.data, selected.limits, confidence);
                if (!made && made.error().where == "target")
                  return Error{made.error().code, made.error().message, "target_mm"};
                if (!made) return made.error();
                return body_json(Stored<CapabilityAnswer>{
                    selected, {*std::move(made), selected.limits, confidence, name_in(selected)}});
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
    if (!fits || text.size() % 2 == 0)
      return invalid("rules", "rules must contain only 1, 2, 3 and 4, with commas: rules=1,2");
    if (is_digit) rules.add(text[i] - '0');
  }
  return rules;
}

double scaled(const Request& request, std::string_view name, double fallback) {
  const auto given = request.integer(name);
  return given ? static_cast<double>(*given) / kMillion : fallback;
}

/// A plan whose kind may still depend on whether the values name subgroups.
struct StoredChartPlan {
  metrology::ChartPlan plan;
  bool has_kind = false;
  bool ignores_subgroups = false;
};

Result<StoredChartPlan> chart_plan(const Request& request) {
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
      kChartMembers, "kind", word(plan.kind),
      [&](const Applicable& row) { return request.has(row.member); },
      [&](std::string_view member, std::string message) {
        unused = invalid(member, std::move(message));
      });
  if (unused) return *std::move(unused);
  if (to) plan.phase1 = {static_cast<std::size_t>(from.value_or(0)), static_cast<std::size_t>(*to)};
  return stored;
}

void find_chart(const Services& services, const Request& request, Responder responder) {
  auto stored = TRY_OR_FAIL(responder, chart_plan(request));
  answer_with(services, request, std::move(responder),
              [stored = std::move(stored)](ValueSelection&& selection) -> Result<std::string> {
                metrology::ChartPlan plan = stored.plan;
                auto selected = TRY(std::move(selection).selected(stored.ignores_subgroups));
                if (!stored.has_kind && selected.data.size > 1) plan.kind = ChartKind::XbarR;
                auto made = TRY(metrology::make_charts(selected.data, plan));
                selected.data = {};
                std::string out;
                constexpr std::size_t kOfAPoint = 12;  // unused room needs no memory
                out.reserve(2 * kOfAPoint * selected.count);
                JsonWriter json(out);
                write_body(json, Stored<ChartAnswer>{
                                     selected, {plan.kind, std::move(made), name_in(selected)}});
                return out;
              });
}

std::vector<Parameter> with_stored_filters(std::vector<Parameter> own) {
  own.push_back(subgroups_parameter());
  constexpr std::int64_t kMostOfLast = 1'000'000;
  own.push_back(query("last", http::Integer{.min = 1, .max = kMostOfLast},
                      "Only this number of the newest matches"));
  return measurement_filter_parameters() + own;
}

/// A number up to `most`, of `least` millionths at least.
Parameter number(std::string name, std::int64_t least, std::int64_t most, std::string description) {
  return query(std::move(name),
               http::Decimal{.scale = kScale, .min = least, .max = most * 1'000'000},
               std::move(description));
}

std::vector<Parameter> chart_parameters() {
  constexpr std::int64_t kMost = 100'000'000;
  return with_stored_filters({
      query("kind", http::Words{{"i_mr", "xbar_r", "xbar_s", "ewma", "cusum"}},
            "Kind of chart (default: xbar_r with subgroups, else i_mr)"),
      query("rules", "Rules of Western Electric 1956: 1,2,3,4 (default: none)"),
      number("lambda", 1'000, 1, "Weight of ewma (default: 0.2)"),
      number("reference_value", 1, 10,
             "Reference value k of cusum, in standard deviations (default: 0.5)"),
      number("decision_interval", 1, 20,
             "Decision interval h of cusum, in standard deviations (default: 5)"),
      query("phase1_from", http::Integer{.min = 0, .max = kMost},
            "First point the limits are taken from (default: 0)"),
      query("phase1_to", http::Integer{.min = 0, .max = kMost},
            "End of these points, exclusive (default: all)"),
  });
}

constexpr std::size_t kPointRoom = 32;  ///< for any double, and the comma before it

/// Writes a point of a measured value, a decimal of nanometres. Up to 15 digits that decimal is the
/// shortest text that reads back as the same double, and is found faster. @returns its end
char* write_point(char* to, double point) {
  constexpr double kNanometresOfOne = 1e6;
  constexpr double kMost = 1e15;
  constexpr int kDecimalPlaces = 6;
  const double nanometres = std::nearbyint(point * kNanometresOfOne);
  if (std::abs(nanometres) < kMost && nanometres / kNanometresOfOne == point)
    return write_decimal(to, static_cast<std::int64_t>(nanometres), kDecimalPlaces);
  if (!std::isfinite(point)) return std::copy_n("null", 4, to);
  return std::to_chars(to, to + kPointRoom, point).ptr;
}

}  // namespace

/// Some hundred points at a time.
void Points::write(JsonWriter& json, const std::vector<double>& points) const {
  json.begin_array();
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

void add_stored_statistics_routes(Routes& add) {
  add("GET /v1/measurements/capability assessStoredCapability viewer 422", find_capability,
      {.summary = "Capability and performance of stored values",
       .description = "Against the limits in the records, which must be the same in all.",
       .parameters = with_stored_filters(
           {query("target_mm", http::LengthIn{},
                  "Target of cpm (default: the middle of the limits)"),
            query("confidence", http::Decimal{.scale = kScale, .min = 1, .max = 999'999},
                  "Confidence of the intervals (default: 0.95)")}),
       .outcomes = {{.meaning = "Computed figures", .schema = "StoredCapability"}}});
  add("GET /v1/measurements/chart makeStoredControlChart viewer 422", find_chart,
      {.summary = "Control chart of stored values",
       .description = "In storage order; a violation names its measurement or subgroup.",
       .parameters = chart_parameters(),
       .outcomes = {{.meaning = "Computed figures", .schema = "StoredControlChart"}}});
}

}  // namespace fitgauge::api
