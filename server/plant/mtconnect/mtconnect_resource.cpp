#include "plant/mtconnect/mtconnect_document.hpp"

#include "formats/qif/qif.hpp"

namespace fitgauge::api {
namespace {

using mtconnect::Agent;
using mtconnect::Selection;
using mtconnect::Streams;

constexpr std::string_view kXml = "text/xml";
constexpr std::size_t kResultsOfAsset = 100;

using Kept = std::vector<std::unique_ptr<app::KeptMeasurement>>;

/// The input of the document of one request.
struct Gathered {
  SharedResponder responder;
  Agent agent;
  Selection selection = mtconnect::kEverything;
  Kept newest{};  ///< the newest first
  // Only for `current`, which shows the newest measurement now or at an earlier sequence:
  std::uint64_t at = 0;  ///< the last sequence that is seen
  Kept begun{};          ///< the next measurement, of which only the part is seen

  /// Returns the last measurement of which all observations are seen.
  std::int64_t whole() const {
    const std::int64_t last = mtconnect::measurement_at(at);
    return at == mtconnect::feature_sequence(last) ? last : last - 1;
  }
};
using SharedGathered = std::shared_ptr<Gathered>;

/// Reads measurements into `where`, then calls `done`, unless the storage fails.
void gather(const Services& services, const SharedGathered& gathered,
            const app::MeasurementQuery& query, std::int64_t behind, std::size_t count,
            Kept Gathered::*where, std::function<void(const app::ListPage&)> done) {
  services.measurements.list(
      query, behind, count,
      [gathered, where](const app::Measurement& measurement) {
        ((*gathered).*where).push_back(std::make_unique<app::KeptMeasurement>(measurement));
      },
      [gathered, done = std::move(done)](const Result<app::ListPage>& page) {
        if (!page) return gathered->responder->fail(page.error());
        done(*page);
      });
}

/// Reads the newest measurements, then calls `done`.
void gather_newest(const Services& services, const SharedGathered& gathered, std::size_t count,
                   std::function<void()> done) {
  app::MeasurementQuery query;
  query.newest_first = true;
  gather(services, gathered, query, 0, count, &Gathered::newest,
         [gathered, done = std::move(done)](const app::ListPage& page) {
           gathered->agent.newest = page.as_of;
           gathered->agent.has_asset = !gathered->newest.empty();
           done();
         });
}

SharedGathered gathered_for(const Services& services, http::Responder responder) {
  return std::make_shared<Gathered>(
      Gathered{.responder = share(std::move(responder)), .agent = mtconnect_agent(services)});
}

void probe(const Services& services, const http::Request&, http::Responder responder) {
  const auto gathered = gathered_for(services, std::move(responder));
  gather_newest(services, gathered, 1, [gathered] {
    gathered->responder->answer(
        mtconnect_response(200, mtconnect::devices_document(gathered->agent)));
  });
}

void answer_current(const Gathered& current, const std::vector<app::MeasurementGroup>& groups) {
  Streams streams(current.agent, current.selection);
  streams.add_availability();
  const app::Measurement* const newest =
      current.newest.empty() ? nullptr : &**current.newest.front();
  const Timestamp at = newest == nullptr ? current.agent.began : newest->received_at;
  const std::int64_t seen = newest == nullptr ? 0 : current.whole();
  streams.add_assets(seen, at);
  if (const auto* const part = current.begun.empty() ? newest : &**current.begun.front()) {
    streams.add(*part, mtconnect::part_sequence(part->row));
  } else {
    streams.add_unavailable_part();
  }
  if (newest != nullptr) {
    streams.add(*newest, mtconnect::feature_sequence(newest->row));
  } else {
    streams.add_unavailable_feature();
  }
  streams.add_counts(mtconnect::counts_of(groups), seen, at);
  const std::uint64_t next = mtconnect::feature_sequence(current.agent.newest) + 1;
  current.responder->answer(mtconnect_response(200, streams.document(next)));
}

void count_and_answer(const Services& services, const SharedGathered& current) {
  app::MeasurementQuery counted;
  counted.as_of_id = current->whole();
  services.measurements.summary(
      counted, "tolerance_class",
      [current](const Result<std::vector<app::MeasurementGroup>>& groups) {
        if (!groups) return current->responder->fail(groups.error());
        answer_current(*current, *groups);
      });
}

void read_current(const Services& services, const SharedGathered& current) {
  app::MeasurementQuery whole;
  whole.newest_first = true;
  whole.as_of_id = current->whole();
  current->newest.clear();
  gather(services, current, whole, 0, 1, &Gathered::newest, [current, &services](const auto&) {
    const std::int64_t last = mtconnect::measurement_at(current->at);
    if (last == current->whole()) return count_and_answer(services, current);
    app::MeasurementQuery part;
    part.history = true;
    part.as_of_id = last;
    gather(services, current, part, last - 1, 1, &Gathered::begun,
           [current, &services](const auto&) { count_and_answer(services, current); });
  });
}

void current(const Services& services, const http::Request& request, http::Responder responder) {
  Selection selection = mtconnect::kEverything;
  if (const auto path = request.text("path")) {
    const auto chosen = mtconnect::select(*path);
    if (!chosen) return responder.fail(chosen.error());
    selection = *chosen;
  }
  const auto current = gathered_for(services, std::move(responder));
  current->selection = selection;
  const auto wanted = request.integer("at");
  gather_newest(services, current, 1, [current, wanted, &services] {
    const std::uint64_t last = mtconnect::feature_sequence(current->agent.newest);
    current->at = wanted ? static_cast<std::uint64_t>(*wanted) : last;
    if (current->at <= last) return read_current(services, current);
    current->responder->fail(
        {ErrorCode::NotFound, fmt::format("at must be from 1 to {}", last), "at"});
  });
}

void answer_assets(const Gathered& gathered) {
  qif::QifWriter writer;
  std::for_each(gathered.newest.rbegin(), gathered.newest.rend(), [&writer](const auto& kept) {
    // Characters that XML does not allow are left out, because nobody could correct them.
    [[maybe_unused]] const auto added = writer.add(**kept);
  });
  const Timestamp at =
      gathered.newest.empty() ? gathered.agent.began : (*gathered.newest.front())->received_at;
  gathered.responder->answer(mtconnect_response(
      200, mtconnect::assets_document(gathered.agent,
                                      writer.is_empty() ? std::string() : writer.element(), at)));
}

void assets(const Services& services, const http::Request& request, http::Responder responder) {
  const auto type = request.text("type");
  const bool is_wanted = !type || *type == "QIFDocumentWrapper";
  const auto gathered = gathered_for(services, std::move(responder));
  gather_newest(services, gathered, is_wanted ? kResultsOfAsset : 1, [gathered, is_wanted] {
    if (!is_wanted) gathered->newest.clear();
    answer_assets(*gathered);
  });
}

void asset(const Services& services, const http::Request& request, http::Responder responder) {
  const std::string wanted(*request.text("id"));
  const auto gathered = gathered_for(services, std::move(responder));
  gather_newest(services, gathered, kResultsOfAsset, [gathered, wanted] {
    const bool is_there =
        gathered->agent.has_asset && wanted == mtconnect::asset_id(gathered->agent);
    if (is_there) return answer_assets(*gathered);
    gathered->responder->fail(
        {ErrorCode::NotFound, "asset not found: see /mtconnect/assets", "id"});
  });
}

/// Returns the error code of the standard.
std::string_view code_of(const Error& error, int status) {
  if (status == 401 || status == 403) return "UNAUTHORIZED";
  if (error.code == ErrorCode::Overloaded) return "TOO_MANY";
  if (http::is_server_error(status)) return "INTERNAL_ERROR";
  if (error.where == "path") return "INVALID_PATH";
  if (error.where == "id") return "ASSET_NOT_FOUND";
  for (const std::string_view name : {"at", "from", "count", "interval", "heartbeat"}) {
    if (error.where == name) return "OUT_OF_RANGE";
  }
  if (status == 404) return "INVALID_URI";
  return status == 405 || status == 406 ? "UNSUPPORTED" : "INVALID_REQUEST";
}

/// @param head the path after /mtconnect/, and the name of the operation
void add_route(Routes& add, std::string_view head, const auto& handler, std::string_view summary,
               std::vector<http::Parameter> parameters = {}) {
  add(fmt::format("GET /mtconnect/{} viewer", head), handler,
      {.summary = std::string(summary),
       .parameters = std::move(parameters),
       .response_types = {std::string(kXml), "application/xml"},
       .outcomes = {{.meaning = "An MTConnect document", .media_types = {std::string(kXml)}}}});
}

void add_refusal(Routes& add, std::string_view meaning) {
  add.all.back().outcomes.push_back({.status = 404,
                                     .meaning = fmt::format("MTConnectError: {}", meaning),
                                     .media_types = {std::string(kXml)}});
}

}  // namespace

void add_mtconnect_routes(Routes& add) {
  add_route(add, "probe probeMtconnect", probe,
            "MTConnectDevices 2.4: the device Gauge and what it observes");
  add_route(add, "current currentMtconnect", current,
            "MTConnectStreams 2.4: the newest measurement, and counts by verdict",
            {{.name = "at",
              .type = http::Integer{.min = 1, .max = kMostSequence},
              .description = "The state when this sequence was the last"},
             {.name = "path",
              .description = "XPath of the data items: `//DataItem[@type=\"PART_COUNT\"]`"}});
  add_refusal(add, "`at` is beyond the log");
  const auto open = std::make_shared<std::atomic<int>>(0);
  add_route(
      add, "sample sampleMtconnect",
      [&services = add.services, open](const http::Request& request, http::Responder responder) {
        sample_mtconnect(services, open, request, std::move(responder));
      },
      "MTConnectStreams 2.4: measurements of the log, from a sequence on", sample_parameters());
  http::Route& sample = add.all.back();
  sample.response_types.push_back("multipart/x-mixed-replace");
  sample.outcomes.front().media_types.push_back("multipart/x-mixed-replace");
  sample.description =
      "Measurement n has the sequences 2n (its part) and 2n + 1. With `interval` the answer is a "
      "stream of documents; 32 may be open. Errors are MTConnectError documents.";
  add_refusal(add, "`from` is beyond the log");
  for (const std::string_view head : {"assets listMtconnectAssets", "asset listMtconnectAsset"}) {
    add_route(add, head, assets, "MTConnectAssets 2.4: QIF results of the newest 100 measurements",
              {{.name = "type", .description = "Type of the assets: only QIFDocumentWrapper"}});
  }
  add_route(add, "asset/{id} getMtconnectAsset", asset, "MTConnectAssets 2.4: the asset of that id",
            {{.name = "id",
              .place = http::ParameterPlace::Path,
              .description = "Asset id, as in `AssetChanged` of /mtconnect/current"}});
  add_refusal(add, "asset not found");
}

bool is_of_mtconnect(const http::Request& request) {
  return request.path().starts_with("/mtconnect/");
}

http::Response mtconnect_error(const Services& services, const Error& error,
                               http::Response problem) {
  const std::string_view said = error.code == ErrorCode::Internal
                                    ? "the request failed: see the log"
                                    : std::string_view(error.message);
  problem.content_type = kXml;
  problem.body =
      mtconnect::error_document(mtconnect_agent(services), code_of(error, problem.status), said);
  return problem;
}

}  // namespace fitgauge::api
