#include "api/certificates/certificate_draft.hpp"
#include "api/measurements/measurements.hpp"
#include "service/jobs.hpp"
#include "service/log/log_service.hpp"

namespace fitgauge::api {
namespace {

/// On paper some hundred pages.
constexpr std::size_t kMostMeasurements = 10'000;
/// Maximum of record bytes, because the report is made in memory.
constexpr std::size_t kMostBytes = std::size_t{16} << 20;
constexpr std::string_view kPdf = "application/pdf";
constexpr std::string_view kJson = "application/json";

Result<CertificateOrder> order_of(const Request& request) {
  CertificateOrder order;
  for (const std::string_view name : {"order", "part_id"}) {
    if (const auto value = request.text(name)) order.of.emplace_back(name, *value);
  }
  if (order.of.empty())
    return Error{ErrorCode::QueryMissing, "give order, part_id or both", "order"};
  order.title = request.text("title").value_or("Inspection report");
  order.company = request.text("company").value_or("");
  order.customer = request.text("customer").value_or("");
  order.paper =
      request.text("paper") == "letter" ? certificate::Paper::Letter : certificate::Paper::A4;
  order.as_json = request.response_type() == kJson;
  order.own_origin = request.own_origin();
  return order;
}

Response written(CertificateDraft& draft, Timestamp now, const std::string& checkpoint,
                 const certificate::Letterhead& letterhead) {
  if (draft.order().as_json) return {200, std::string(kJson), draft.json(now, checkpoint)};
  Response response(200, std::string(kPdf), draft.pdf(now, checkpoint, letterhead));
  return std::move(response).with("Content-Disposition", "inline; filename=\"certificate.pdf\"");
}

/// Requests a head that covers the measurements, then writes the report, which may be slow.
void finish(const Services& services, const std::shared_ptr<CertificateDraft>& draft,
            const SharedResponder& shared) {
  const auto last = TRY_OR_FAIL(*shared, services.measurements.parse_id(draft->last_id()));
  services.log.prove(last, [&services, draft, shared](const Result<app::LogService::Proof>& proof) {
    if (!proof) return shared->fail(proof.error());
    services.jobs.figures.run(
        [&services, now = services.clock.now(), head = proof->head, draft]() -> Result<Response> {
          return written(*draft, now, head->note, services.letterhead).with("Vary", "Accept");
        },
        answer_by(shared));
  });
}

void make_certificate(const Services& services, const Request& request, Responder responder) {
  auto order = TRY_OR_FAIL(responder, order_of(request));
  const auto query = TRY_OR_FAIL(responder, measurement_query(services, request));
  const auto draft = std::make_shared<CertificateDraft>(std::move(order));
  const SharedResponder shared = share(std::move(responder));
  const auto simulated = std::make_shared<std::string>();  // the first id
  services.measurements.list(
      query, 0, kMostMeasurements,
      [draft, simulated](const app::Measurement& m) {
        if (draft->bytes() <= kMostBytes) draft->add(m);
        if (m.source == app::Source::Gauge || !simulated->empty()) return;
        *simulated = app::measurement_id_text(m.id, m.origin);
      },
      [&services, draft, shared, simulated](const Result<app::ListPage>& page) {
        if (!page) return shared->fail(page.error());
        if (!simulated->empty()) {
          return shared->fail({ErrorCode::QueryInvalid,
                               fmt::format("a report cannot contain {}: it is simulated, not the "
                                           "result of an inspection; exclude it by source=gauge",
                                           *simulated),
                               "source"});
        }
        if (draft->count() == 0) {
          return shared->fail(
              {ErrorCode::MeasurementUnknown,
               "no measurement has this order and part_id: check them in GET /v1/measurements"});
        }
        if (page->next || draft->bytes() > kMostBytes) {
          return shared->fail({ErrorCode::StatisticsTooMany,
                               fmt::format("a report must have at most {} measurements with {} MiB "
                                           "of records: select fewer, for example by from and to",
                                           kMostMeasurements, kMostBytes >> 20)});
        }
        const auto go_on = [&services, draft, shared] { finish(services, draft, shared); };
        const auto& [name, value] = draft->order().of.back();
        if (name != "part_id") return go_on();
        find_plan_of(services, value, [draft, go_on, shared](const auto& found) {
          if (!found) return shared->fail(found.error());
          draft->hold_against(*found);
          go_on();
        });
      });
}

std::vector<Parameter> parameters() {
  return measurement_filter_parameters() +
         std::vector<Parameter>{
             query("title", http::Text{200},
                   "First line of the report (default: Inspection report)"),
             query("company", http::Text{200}, "Company that issues the report"),
             query("customer", http::Text{200}, "Customer on the report"),
             query("paper", http::Words{{"a4", "letter"}}, "Size of the sheets (default: a4)"),
         };
}

}  // namespace

void add_certificates_routes(Routes& add) {
  add("GET /v1/certificates getCertificate viewer 404 422", make_certificate,
      {.summary = "Inspection report of an order or a part",
       .description =
           "Every value of the order, the part or both, in storage order, with limits, verdict, "
           "rule, uncertainty, gauge, machine, operator and the signed head of the log that has "
           "them; before them the verdict of all and the worst value, of a part also its plan and "
           "what is missing of it, or that no plan was used. A tagged PDF, or JSON by "
           "Accept; at most 10,000 values, whose records have at most 16 MiB. Simulated values are "
           "refused.",
       .parameters = parameters(),
       .response_types = {std::string(kPdf), std::string(kJson)},
       .outcomes = {{.meaning = "The certificate",
                     .schema = "Certificate",
                     .media_types = {std::string(kPdf), std::string(kJson)}}}});
}

}  // namespace fitgauge::api
