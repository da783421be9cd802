#include "api/resources.hpp"

#include <fmt/format.h>

#include "api/schemas.hpp"
#include "api/service/document_routes.hpp"
#include "api/statistics/uncertainty_resource.hpp"
#include "base/json/body_forms.hpp"
#include "record/gauge_book.hpp"
#include "service/measurements/gauges_in_use.hpp"

namespace fitgauge::api {
namespace {

Result<CheckedDocument> check_budget(const Services&, const std::string&, std::string_view text) {
  const auto body = parse_json(text);
  if (!body) return body.error();
  auto computed = compute_uncertainty(*body);
  if (!computed) return computed.error();
  return CheckedDocument{.text = std::string(text), .answer = *std::move(computed)};
}

/// Measurements are judged by what is stored from its answer on.
void reload_gauges(const Services& services, std::function<void(Result<void>)> done) {
  services.gauges.reload(std::move(done));
}

/// The form of the time to which a calibration holds.
struct Due {
  std::string schema(Side) const { return schema::text(); }
  bool read(FieldReader& fields, std::string_view name, std::string& to) const {
    const auto given = fields.text(name);
    if (!given) return false;
    to = *given;
    const bool is_due = parse_due(to).has_value();
    if (!is_due) {
      fields.report(ErrorCode::TimeMalformed, name,
                    fmt::format("{} is a date, 2027-03-31, or an RFC 3339 time", name));
    }
    return is_due;
  }
};

struct GaugeOrder {
  std::optional<std::string> uncertainty{};
  std::string calibration_due{};
  std::optional<std::string> comment{};
};
void members(auto& v, GaugeOrder& gauge) {
  v.optional("uncertainty", gauge.uncertainty, "The name of its budget, in µm");
  v.member("calibration_due", gauge.calibration_due, Due{},
           "A date, to its end in UTC, or an RFC 3339 time");
  v.optional("comment", gauge.comment, Text{.longest = 2000});
}

Result<CheckedDocument> check_gauge(const Services&, const std::string&, std::string_view text) {
  const auto body = parse_json(text);
  if (!body) return body.error();
  auto gauge = read_whole<GaugeOrder>(*body);
  if (!gauge) return gauge.error();
  return CheckedDocument{.text = std::string(text), .uncertainty = std::move(gauge->uncertainty)};
}

constexpr KindOfDocument kUncertainties{.kind = app::DocumentKind::Uncertainty,
                                        .path = "/v1/uncertainties",
                                        .parameter = "name",
                                        .one = "an uncertainty budget",
                                        .contents = "what contributes to it",
                                        .many = "uncertainty budgets",
                                        .member = "uncertainties",
                                        .tag = "statistics",
                                        .operation = "Uncertainty",
                                        .operations = "Uncertainties",
                                        .schema = "UncertaintyBudget",
                                        .body_schema = "UncertaintyBudget",
                                        .list_schema = "UncertaintyBudgetNames",
                                        .answered = "Uncertainty",
                                        .is_figure = true,
                                        .check = check_budget,
                                        .changed = reload_gauges};
constexpr KindOfDocument kGauges{.kind = app::DocumentKind::GaugeInUse,
                                 .path = "/v1/gauges-in-use",
                                 .parameter = "name",
                                 .one = "a gauge in use",
                                 .contents = "its uncertainty and when its calibration is due",
                                 .many = "gauges in use",
                                 .member = "gauges",
                                 .tag = "statistics",
                                 .operation = "GaugeInUse",
                                 .operations = "GaugesInUse",
                                 .schema = "GaugeInUse",
                                 .body_schema = "GaugeInUse",
                                 .list_schema = "GaugeInUseNames",
                                 .check = check_gauge,
                                 .changed = reload_gauges};

}  // namespace

void add_documents_schemas(Schemas& schemas) {
  schemas.push_back(order_schema<GaugeOrder>("GaugeInUse"));
  schemas.push_back(names_schema("UncertaintyBudgetNames", "uncertainties"));
  schemas.push_back(names_schema("GaugeInUseNames", "gauges"));
}

void add_documents_routes(std::vector<http::Route>& routes, const Services& services) {
  add_document_routes(routes, services, kUncertainties);
  add_document_routes(routes, services, kGauges);
}

}  // namespace fitgauge::api
