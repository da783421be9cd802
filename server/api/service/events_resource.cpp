#include "api/resources.hpp"

#include "api/service/event_stream.hpp"
#include "api/wire/event_text.hpp"

namespace fitgauge::api {
namespace {

EventStream::Start start_of(const Services& services, const http::Request& request) {
  const auto named = last_event_id(request);
  if (!named) return {};
  const auto position = services.events.position_of(*named);
  return {.after = position, .gap = !position};
}

http::Response stream_events(const Services& services, const http::Request& request) {
  const auto source = request.text("source");
  // `all` is no source, so that the filter is off.
  return event_response(std::make_shared<EventStream>(
      services.events, start_of(services, request),
      source ? app::source_from_word(*source) : std::optional(app::Source::Gauge)));
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
          "measurement.recorded and verdict.reject carry the record, run.finished the run, "
          "table.changed the column and the revision in force from then on, note.added the note. A "
          "reader that names "
          "the id of the last event it had goes on with the next; `resync` says "
          "that some are gone.",
      .parameters = {{.name = "source",
                      .type = http::Words{{"gauge", "simulation", "all"}},
                      .description = "Of the measurements; gauge when absent"}},
      .response_types = {std::string(kEventStreamType)},
      .access = "viewer",
      .operation = "followEvents",
      .tag = "service",
      .outcomes = {{.meaning = "Events without an end", .schema = "Event"}},
  });
  add_last_event_id(routes.back().parameters);
}

}  // namespace fitgauge::api
