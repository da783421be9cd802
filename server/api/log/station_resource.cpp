#include "api/resources.hpp"
#include "base/json/json_writer.hpp"
#include "service/jobs.hpp"
#include "service/log/station_texts.hpp"

namespace fitgauge::api {
namespace {

constexpr int kConflict = 409;
constexpr std::size_t kBatchLimit = std::size_t{32} << 20;

void write_head(JsonWriter& json, const app::LogIntake::Head& head) {
  json.begin_object()
      .member("size", head.size)
      .member("root", tlog::to_base64(head.root))
      .end_object();
}

Error refusal(const app::LogIntake::Answer& answer, std::string_view origin) {
  if (answer.outcome == app::LogIntake::Outcome::Forked) {
    return Error::of(ErrorCode::LogForked,
                     "the origin {} has two histories: its folder was copied and started twice, "
                     "or an older copy was restored. Start one of them with an empty folder",
                     origin);
  }
  return Error::of(ErrorCode::LogPosition,
                   "{} rows of the origin {} are stored: continue after them", answer.head.size,
                   origin);
}

Response response_of(const Request& request, const app::LogIntake::Answer& answer,
                     std::string_view origin) {
  std::string body;
  if (answer.outcome == app::LogIntake::Outcome::Taken) {
    JsonWriter json(body);
    write_head(json, answer.head);
    return {200, "application/json", std::move(body)};
  }
  Response response = problem(refusal(answer, origin), kConflict, request);
  auto& text = std::get<std::string>(response.body);
  text.pop_back();
  text += ",\"head\":";
  JsonWriter json(text);
  write_head(json, answer.head);
  text += '}';
  return response;
}

void put_batch(const Services& services, const Request& request, Responder responder) {
  services.jobs.intake.run(
      [&services, &request]() -> Result<Response> {
        const auto batch =
            TRY(read_batch(*request.text("origin"), *request.integer("from"), request.body()));
        const auto answer = services.intake.take(batch->batch);
        // At the station, an error with this name is 503; here it is a conflict.
        if (!answer && answer.error().code == ErrorCode::LogForked)
          return problem(answer.error(), kConflict, request);
        if (!answer) return answer.error();
        return response_of(request, *answer, batch->batch.origin);
      },
      answer_by(share(std::move(responder))));
}

void get_revisions(const Services& services, const Request& request, Responder responder) {
  services.revisions.read(request.text("station").value_or(""),
                          std::string(request.text("after").value_or("")),
                          answer_with(std::move(responder), [](const auto& page) {
                            return Response(200, "application/json", revisions_text(page))
                                .with("Cache-Control", "no-store");
                          }));
}

}  // namespace

void add_intake_routes(Routes& add) {
  add("PUT /v1/log/{origin}/{from} putLogBatch station 403 409 422", put_batch,
      {.summary = "Take what a station forwards",
       .description =
           "NDJSON: a line with `checkpoint`, `key`, `hand_overs` and, of a branch, its `base`; up "
           "to 10,000 records as they "
           "were first answered; a line for each answer kept under an idempotency key; a line for "
           "each note that is new. Taken whole "
           "where the first record continues the log of the origin and the root fits the signed "
           "checkpoint; else 409 with the head that is here.",
       .parameters = {path_parameter("origin",
                                     "Ending of the station's ids: 16 hexadecimal digits"),
                      {.name = "from",
                       .place = http::ParameterPlace::Path,
                       .type = http::Integer{.min = 1},
                       .description = "The place of the first record in its log, from 1"}},
       .body = {.use = http::BodyUse::Required,
                .media_types = {"application/x-ndjson"},
                .limit = kBatchLimit},
       .outcomes = {
           {.meaning =
                "All records are stored durably; the head of the station's log at this service",
            .schema = "LogHead"}}});
}

void add_revisions_routes(Routes& add) {
  add("GET /v1/log/revisions getRevisions station 403", get_revisions,
      {.summary = "Revisions that a centre sends to its stations",
       .description =
           "Tables with custom tolerance classes, keys of viewers and operators (as hashes), "
           "setups, plans, catalogues, and corrections of the station's records that were made "
           "here: the last revision of each, sorted by number. A station asks every few seconds "
           "with its last `position`; an unknown position returns everything.",
       .parameters = {query("station",
                            "Ending of the station's ids; its corrections are in the response"),
                      query("after", "`position` of the last response")},
       .outcomes = {{.meaning = "Changed documents", .schema = "Revisions"}}});
}

}  // namespace fitgauge::api
