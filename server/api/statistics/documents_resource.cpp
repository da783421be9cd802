#include "api/resources.hpp"

#include <fmt/format.h>

#include "api/service/document_routes.hpp"
#include "api/statistics/exact_reader.hpp"
#include "api/statistics/uncertainty_resource.hpp"
#include "record/gauge_book.hpp"
#include "service/measurements/gauges_in_use.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kLongestGaugeComment = 2000;

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

Result<CheckedDocument> check_gauge(const Services&, const std::string&, std::string_view text) {
  const auto body = parse_json(text);
  if (!body) return body.error();
  FieldErrors errors;
  FieldReader fields(*body, "", errors);
  CheckedDocument checked{.text = std::string(text),
                          .uncertainty = fields.optional_text("uncertainty")};
  if (const auto due = fields.text("calibration_due"); due && !parse_due(*due)) {
    fields.report(ErrorCode::TimeMalformed, "calibration_due",
                  "calibration_due is a date, 2027-03-31, or an RFC 3339 time");
  }
  if (const auto comment = fields.optional_text("comment");
      comment && comment->size() > kLongestGaugeComment) {
    fields.report(ErrorCode::FieldTooLong, "comment",
                  fmt::format("comment takes at most {} bytes", kLongestGaugeComment));
  }
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  return checked;
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

void add_documents_routes(std::vector<http::Route>& routes, const Services& services) {
  add_document_routes(routes, services, kUncertainties);
  add_document_routes(routes, services, kGauges);
}

}  // namespace fitgauge::api
