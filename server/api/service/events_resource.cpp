#include "api/service/events_resource.hpp"

#include "api/service/event_stream.hpp"
#include "api/wire/event_text.hpp"

namespace fitgauge::api {
namespace {

/// The header a browser sends when it connects again goes before the query it first sent.
EventStream::Start start_of(const http::Request& request) {
  auto named = request.text("Last-Event-ID");
  if (!named) named = request.text("last_event_id");
  if (!named || named->empty()) return {};
  const auto position = app::parse_event_id(*named);
  return {.after = position, .gap = !position};
}

http::Response stream_events(const Services& services, const http::Request& request) {
  const auto source = request.text("source");
  // `all` is no source, so that the filter is off.
  auto stream = std::make_shared<EventStream>(
      services.events, start_of(request),
      source ? app::source_from_word(*source) : std::optional(app::Source::Gauge));
  http::Response response(
      200, std::string(kEventStreamType),
      http::StreamedBody{.source = std::move(stream), .heartbeat = std::string(kEventHeartbeat)});
  response.with("Cache-Control", "no-store").with("X-Accel-Buffering", "no");
  return response;
}

}  // namespace

void add_events_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/v1/events",
      .handler = http::SyncHandler([&services](const http::Request& request) {
        return Result<http::Response>(stream_events(services, request));
      }),
      .summary = "What happens, as Server-Sent Events",
      .description =
          "measurement.recorded and verdict.reject carry the record, run.finished the run. A "
          "reader that names the id of the last event it had goes on with the next; `resync` says "
          "that some are gone.",
      .parameters = {{.name = "source",
                      .type = http::Words{{"gauge", "simulation", "all"}},
                      .description = "Of the measurements; gauge when absent"},
                     {.name = "last_event_id",
                      .description = "The id of the last event, where the header cannot be set"},
                     {.name = "Last-Event-ID",
                      .place = http::ParameterPlace::Header,
                      .description = "The id of the last event that was read"}},
      .response_types = {std::string(kEventStreamType)},
      .access = "viewer",
      .operation = "followEvents",
      .tag = "service",
      .outcomes = {{.meaning = "Events without an end", .schema = "Event"}},
  });
}

}  // namespace fitgauge::api
