#include "api/statistics/documents_resource.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "api/handlers.hpp"
#include "api/statistics/exact_reader.hpp"
#include "api/statistics/uncertainty_resource.hpp"
#include "api/wire/json_writer.hpp"
#include "api/wire/request_facts.hpp"
#include "app/measurements/document_service.hpp"
#include "app/runs/run_service.hpp"
#include "base/clock.hpp"

namespace fitgauge::api {
namespace {

using app::DocumentKind;

constexpr std::size_t kLongestDocumentName = 200;  // that of a gauge in a measurement
constexpr std::size_t kLongestGaugeComment = 2000;

/// A body that was read: what its PUT answers, and the budget it needs.
struct Checked {
  std::string answer{};
  std::optional<std::string> uncertainty{};
};

Result<Checked> check_budget(const JsonValue& body) {
  auto computed = compute_uncertainty(body);
  if (!computed) return computed.error();
  return Checked{.answer = *std::move(computed)};
}

/// A date, to its end in UTC, or a time.
bool is_due_date(std::string_view text) {
  return parse_rfc3339(text).has_value() ||
         parse_rfc3339(std::string(text) + "T23:59:59Z").has_value();
}

Result<Checked> check_gauge(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  Checked checked{.answer = {}, .uncertainty = fields.optional_text("uncertainty")};
  if (const auto due = fields.text("calibration_due"); due && !is_due_date(*due)) {
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

/// What differs between the two kinds.
struct KindOfDocument {
  DocumentKind kind;
  std::string_view path;
  std::string_view list;      ///< the member of the list's answer
  std::string_view one;       ///< as a sentence names it
  std::string_view schema;    ///< of what is stored
  std::string_view answered;  ///< of what a PUT answers; empty: nothing
  std::string_view operation;
  std::string_view operations;
  Result<Checked> (*check)(const JsonValue& body);
};

constexpr KindOfDocument kUncertainties{.kind = DocumentKind::Uncertainty,
                                        .path = "/v1/uncertainties",
                                        .list = "uncertainties",
                                        .one = "an uncertainty budget",
                                        .schema = "UncertaintyBudget",
                                        .answered = "Uncertainty",
                                        .operation = "Uncertainty",
                                        .operations = "listUncertainties",
                                        .check = check_budget};
constexpr KindOfDocument kGauges{.kind = DocumentKind::GaugeInUse,
                                 .path = "/v1/gauges-in-use",
                                 .list = "gauges",
                                 .one = "a gauge in use",
                                 .schema = "GaugeInUse",
                                 .answered = "",
                                 .operation = "GaugeInUse",
                                 .operations = "listGaugesInUse",
                                 .check = check_gauge};

Result<std::string> document_name(const http::Request& request) {
  const std::string_view name = *request.text("name");
  const bool printable = std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == '\x7f';
  });
  if (!name.empty() && name.size() <= kLongestDocumentName && printable) return std::string(name);
  return Error{ErrorCode::PathMalformed, "a name has 1 to 200 bytes without control characters"};
}

http::Response written(bool created, std::string answer, std::string_view text) {
  const int status = created ? 201 : 200;
  http::Response response = answer.empty()
                                ? http::Response(status)
                                : http::Response(status, "application/json", std::move(answer));
  return std::move(response).with("ETag", etag_of_text(text));
}

/// A budget may ask for a simulation, which takes long.
template <const KindOfDocument& kKind>
void put_document(const Services& services, const http::Request& request,
                  http::Responder responder) {
  auto name = document_name(request);
  if (!name) return responder.fail(name.error());
  const SharedResponder shared = share(std::move(responder));
  services.runs.prepare(
      [&services, &request, name = *std::move(name), shared] {
        const auto body = parse_json(request.body());
        if (!body) return shared->fail(body.error());
        auto checked = kKind.check(*body);
        if (!checked) return shared->fail(checked.error());
        const auto caller = caller_name(request);
        services.documents.write(
            {.kind = kKind.kind,
             .name = name,
             .text = std::string(request.body()),
             .caller = caller ? std::optional<std::string>(*caller) : std::nullopt,
             .uncertainty = checked->uncertainty,
             .precondition = text_precondition_of(request)},
            [&request, shared, answer = std::move(checked->answer)](Result<bool> created) {
              if (created) return shared->answer(written(*created, answer, request.body()));
              const bool of_budget = created.error().code == ErrorCode::UncertaintyUnknown;
              shared->fail(of_budget ? at_member("uncertainty", created.error()) : created.error());
            });
      },
      [shared](Error error) { shared->fail(std::move(error)); });
}

template <const KindOfDocument& kKind>
void get_document(const Services& services, const http::Request& request,
                  http::Responder responder) {
  services.documents.read(
      kKind.kind, std::string(*request.text("name")),
      [if_match = preconditions_of(request).if_match,
       shared = share(std::move(responder))](Result<app::NamedDocument> document) {
        if (!document) return shared->fail(document.error());
        const std::string tag = etag_of_text(document->text);
        if (!Preconditions{.if_match = if_match}.hold(tag)) return shared->fail(other_state());
        http::Response response(200, "application/json", std::move(document->text));
        response.etag = tag;
        shared->answer(std::move(response));
      });
}

template <const KindOfDocument& kKind>
void remove_document(const Services& services, const http::Request& request,
                     http::Responder responder) {
  services.documents.remove(kKind.kind, std::string(*request.text("name")),
                            text_precondition_of(request),
                            [shared = share(std::move(responder))](const Result<bool>& removed) {
                              if (!removed) return shared->fail(removed.error());
                              shared->answer(http::Response(204));
                            });
}

template <const KindOfDocument& kKind>
void list_documents(const Services& services, const http::Request&, http::Responder responder) {
  services.documents.list(kKind.kind, [shared = share(std::move(responder))](
                                          Result<std::vector<app::NamedDocument>> documents) {
    if (!documents) return shared->fail(documents.error());
    std::string body;
    JsonWriter json(body);
    json.begin_object().key(kKind.list).begin_array();
    for (const app::NamedDocument& document : *documents) {
      json.begin_object()
          .member("name", document.name)
          .member("modified_at", format_rfc3339(document.modified_at))
          .end_object();
    }
    json.end_array().end_object();
    shared->answer({200, "application/json", std::move(body)});
  });
}

template <const KindOfDocument& kKind>
void add_document_routes(std::vector<http::Route>& routes, const Services& services) {
  const http::Parameter name{.name = "name",
                             .place = http::ParameterPlace::Path,
                             .description = "As it is kept, up to 200 bytes"};
  const std::string one(kKind.one);
  const std::string pattern = std::string(kKind.path) + "/{name}";
  const std::string schema(kKind.schema);
  const std::string answered(kKind.answered);
  const std::string operation(kKind.operation);
  routes.push_back({
      .pattern = std::string(kKind.path),
      .handler = with(services, list_documents<kKind>),
      .summary = fmt::format("The names of {} and the like", one),
      .access = "viewer",
      .operation = std::string(kKind.operations),
      .tag = "statistics",
      .outcomes = {{.meaning = "By name", .schema = schema + "Names"}},
  });
  routes.push_back({
      .pattern = pattern,
      .handler = with(services, get_document<kKind>),
      .summary = fmt::format("Read {} as it was stored", one),
      .parameters = {name},
      .access = "viewer",
      .operation = "get" + operation,
      .tag = "statistics",
      .outcomes = {{.meaning = "As it was stored", .schema = schema}},
      .refusals = {404, 412},
  });
  add_precondition_parameters(routes.back().parameters);
  routes.push_back({
      .method = http::Method::Put,
      .pattern = pattern,
      .handler = with(services, put_document<kKind>),
      .summary = fmt::format("Store {} under a name", one),
      .parameters = {name},
      .body = {.use = http::BodyUse::Required,
               .media_types = {"application/json"},
               .schema = schema},
      .access = "admin",
      .operation = "put" + operation,
      .tag = "statistics",
      .outcomes = {{.meaning = "It is replaced", .schema = answered},
                   {.status = 201, .meaning = "It is new", .schema = answered}},
      .refusals = {412},
  });
  add_precondition_parameters(routes.back().parameters);
  routes.push_back({
      .method = http::Method::Delete,
      .pattern = pattern,
      .handler = with(services, remove_document<kKind>),
      .summary = fmt::format("Delete {}", one),
      .parameters = {name},
      .access = "admin",
      .operation = "delete" + operation,
      .tag = "statistics",
      .outcomes = {{.status = 204, .meaning = "It is gone"}},
      .refusals = {404, 412},
  });
  add_precondition_parameters(routes.back().parameters);
}

}  // namespace

void add_documents_routes(std::vector<http::Route>& routes, const Services& services) {
  add_document_routes<kUncertainties>(routes, services);
  add_document_routes<kGauges>(routes, services);
}

}  // namespace fitgauge::api
