#include "api/runs/run_codec.hpp"
#include "api/runs/run_posting.hpp"
#include "api/wire/event_text.hpp"
#include "api/wire/request_facts.hpp"

namespace fitgauge::api {
namespace {

constexpr std::int64_t kRunsOfAPage = 100;

Result<std::int64_t> id_of(const Services& services, const Request& request) {
  return services.runs.parse_id(*request.text("id"));
}

void answer(Responder& responder, Result<Response> response) {
  if (!response) return responder.fail(std::move(response).error());
  responder.answer(*std::move(response));
}

/// Responds with `answer_of(run object as JSON)`, a Result<Response>, for a run in any state.
template <class Answer>
void with_run_json(const Services& services, const Request& request, Responder responder,
                   const Answer& answer_of) {
  const auto id = TRY_OR_FAIL(responder, id_of(services, request));
  if (const auto active = services.runs.active(id)) {
    const std::string json = unfinished_run_json(*active);
    if (!active->is_being_stored()) return answer(responder, answer_of(json));
  }
  services.runs.find(
      id, answer_with(std::move(responder), [answer_of](app::StoredRun run) {
        return answer_of(run.result.empty() ? unfinished_run_json(run) : std::move(run.result));
      }));
}

void get_run(const Services& services, const Request& request, Responder responder) {
  with_run_json(services, request, std::move(responder),
                [](std::string run) { return json_response(std::move(run)); });
}

void get_parameters(const Services& services, const Request& request, Responder responder) {
  with_run_json(services, request, std::move(responder),
                [](const std::string& report) -> Result<Response> {
                  auto parameters = TRY(stored_member(report, "parameters", "report of a run"));
                  return json_response(parameters.empty() ? "{}" : std::move(parameters));
                });
}

void get_request(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, id_of(services, request));
  services.runs.find(id, answer_with(std::move(responder), [](app::StoredRun run) {
                       return json_response(std::move(run.request));
                     }));
}

/// Media types that a browser may show; everything else is text.
std::string media_type_of(const std::string& path) {
  const std::string name = ascii_lower(path);
  const bool html = name.ends_with(".html") || name.ends_with(".htm");
  return html ? "text/html; charset=utf-8" : "text/plain; charset=utf-8";
}

void get_run_file(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, id_of(services, request));
  services.runs.file(id, std::string(*request.text("name")),
                     answer_with(std::move(responder), [](store::RunFile file) {
                       return foreign_bytes(media_type_of(file.path), std::move(file.content));
                     }));
}

/// A trace, unpacked while it is sent: the text of a long one is 50 MB.
class TraceStream final : public http::BodyStream {
 public:
  TraceStream(app::TraceReader trace, bool csv) : trace_(std::move(trace)) {
    if (csv) csv_.emplace();
  }

  void next(http::ChunkSink sink) override {
    auto piece = trace_.next();
    if (piece && piece->empty()) return sink.finish(csv_ ? csv_->end() : "");
    if (piece && csv_) piece = csv_->rows(*piece);
    if (!piece) return sink.fail();
    sink.put(*std::move(piece));
  }

 private:
  app::TraceReader trace_;
  std::optional<TraceCsv> csv_;
};

void get_trace(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, id_of(services, request));
  const bool csv = wants_csv(request);
  const bool packed = !csv && request.prefers_gzip();
  services.runs.trace(
      id, answer_with(std::move(responder), [csv, packed](app::TraceReader trace) {
        const char* const type =
            csv ? "text/csv; charset=utf-8; header=present" : "application/json";
        if (auto bytes = packed ? trace.take_packed() : std::nullopt) {
          return Response(200, type, *std::move(bytes))
              .with("Content-Encoding", "gzip")
              .with("Vary", "Accept");
        }
        const http::StreamedBody body{std::make_shared<TraceStream>(std::move(trace), csv)};
        return Response(200, type, body).with("Vary", "Accept");
      }));
}

void get_events(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, id_of(services, request));
  const auto last = last_event_id(request);
  services.runs.follow(id, answer_with(std::move(responder), [last](app::RunService::Followed run) {
                         return run.active ? run_events(std::move(run.active), last)
                                           : finished_run_events(run.stored.result, last);
                       }));
}

/// Responds when the run has ended, so that its status shows whether the cancellation was in time.
void cancel_run(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, id_of(services, request));
  services.runs.cancel(id, [shared = share(std::move(responder))](const Result<void>& cancelled) {
    if (!cancelled) return shared->fail(cancelled.error());
    shared->answer(Response(204));
  });
}

void list_runs(const Services& services, const Request& request, Responder responder) {
  store::RunFilter query;
  if (const auto status = request.text("status")) query.status = app::run_state_from_word(*status);
  if (const auto program = request.text("program")) {
    const auto path = TRY_OR_FAIL(responder, app::parse_file_path(*program));
    query.program = path.text();
  }
  std::optional<std::int64_t> after;
  if (const auto cursor = request.text("after")) {
    const auto id = services.runs.parse_id(*cursor);
    if (!id) {
      return responder.fail(
          {ErrorCode::CursorInvalid, "after must be the `next` of an earlier page"});
    }
    after = *id;
  }
  services.runs.list(std::move(query), after,
                     static_cast<std::size_t>(request.integer("limit").value_or(kRunsOfAPage)),
                     answer_with(std::move(responder), [&services, &request](const auto& page) {
                       const std::string next = page.next ? services.runs.cursor(*page.next) : "";
                       auto response = json_response(run_page_json(page, next));
                       if (page.next) response->with("Link", next_link(request, next));
                       return response;
                     }));
}

const Parameter kId = path_parameter("id", "Name in the run");

void add_reading_routes(Routes& add) {
  add("GET /v1/runs listRuns viewer", list_runs,
      {.summary = "The runs, the newest first",
       .parameters = {query("status",
                            http::Words{{"queued", "running", "completed", "stopped", "failed",
                                         "limit_exceeded", "cancelled"}},
                            "Only this status"),
                      query("program",
                            "Only this program: TNC:\\nc_prog\\8255.h, or nc_prog/8255.h"),
                      query("limit", http::Integer{.min = 1, .max = 1000},
                            "Maximum number of runs of a page (default: 100)"),
                      query("after", "The cursor `next` of the page before")},
       .outcomes = {{.meaning = "A page", .schema = "RunList"}}});
  add("GET /v1/runs/{id} getRun viewer 404", get_run,
      {.summary = "One run with all its results",
       .parameters = {kId},
       .outcomes = {{.meaning = "The run", .schema = "Run"}}});
  add("GET /v1/runs/{id}/parameters getRunParameters viewer 404", get_parameters,
      {.summary = "The parameters that are defined at the end",
       .parameters = {kId},
       .outcomes = {{.meaning = "Sorted by name", .schema = "RunParameters"}}});
  add("GET /v1/runs/{id}/request getRunRequest viewer 404", get_request,
      {.summary = "Request of the run with its setup in full; it can be posted again",
       .parameters = {kId},
       .outcomes = {{.meaning = "The order", .schema = "RunOrder"}}});
  add("GET /v1/runs/{id}/trace getRunTrace viewer 404 409", get_trace,
      {.summary = "Every move with the block that commanded it",
       .parameters = {kId, csv_or_json()},
       .response_types = {"application/json", "text/csv"},
       .outcomes = {{.meaning = "The moves", .schema = "Trace"}}});
  add("GET /v1/runs/{id}/files/{name} getRunFile viewer 404 409", get_run_file,
      {.summary = "A file the run has written, by its name or path",
       .parameters = {kId,
                      path_parameter("name",
                                     "TCHPR421.TXT or, of several files of that name, the path "
                                     "(b%2FTCHPR421.TXT), without regard to case")},
       .response_types = {},
       .outcomes = {{.meaning = "Bytes of the file", .media_types = {"text/plain", "text/html"}}}});
  add("GET /v1/runs/{id}/events followRun viewer 404", get_events,
      {.summary = "Server-Sent Events: progress, output, end",
       .description = "The id of an event is the number of lines told so far, or `end`: a reader "
                      "that comes back gets what follows, and 204 after `end`.",
       .parameters = {kId},
       .response_types = {std::string(kEventStreamType)},
       .outcomes = {
           {.meaning = "output, progress, end", .schema = "RunEvent"},
           {.status = 204, .meaning = "The run has ended, and all its events were read"}}});
  add_last_event_id(add.all.back().parameters);
}

}  // namespace

void add_runs_routes(Routes& add) {
  add_reading_routes(add);
  add("POST /v1/runs postRun operator 409", post_run,
      {.summary = "Run a program on a simulated machine",
       .description = "201 with the run when it is over, or 202 at once with "
                      "`Prefer: respond-async`. A program with errors is refused with all of them.",
       .parameters = {idempotency_parameter(),
                      {.name = "Prefer",
                       .place = http::ParameterPlace::Header,
                       .type =
                           http::Text{.schema = R"({"type":"string","enum":["respond-async"]})"},
                       .description = "The response does not wait for the end"}},
       .body = json_body("RunOrder"),
       .outcomes = {{.status = 201, .meaning = "The finished run", .schema = "Run"},
                    {.status = 202, .meaning = "Run queued", .schema = "Run"}}});
  add("DELETE /v1/runs/{id} cancelRun operator 404 409", cancel_run,
      {.summary = "Cancel a run that is queued or under way",
       .parameters = {kId},
       .outcomes = {{.status = 204, .meaning = "Run cancelled"}}});
}

}  // namespace fitgauge::api
