#include "api/wire/event_text.hpp"
#include "record/record.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kGap =
    R"({"detail":"the events after the id you named are gone: read the lists again"})";

void write_event(std::string& text, const app::Event& event) {
  if (event.measurement == nullptr) {
    return append_event(text, event.type, app::event_id_text(event.id, event.history),
                        event.payload);
  }
  std::string data;
  app::append_record(data, *event.measurement);
  append_event(text, event.type, app::event_id_text(event.id, event.history), data);
}

/// The events that follow a position, in pages.
class EventStream final : public CommitStream {
 public:
  struct Start {
    std::optional<app::EventPosition> after{};  ///< none: from now on
    bool gap = false;                           ///< the reader named an invalid position
  };

  EventStream(app::EventService& events, Start start, std::optional<app::Source> source)
      : CommitStream(events), place_{start.after, source}, gap_(start.gap) {}

 private:
  void read() override {
    app::EventService::Place place = place_;
    if (gap_) place.after.reset();
    events_.read(place, write_event,
                 [self = std::static_pointer_cast<EventStream>(shared_from_this())](
                     const Result<app::EventService::Page>& page) {
                   if (!page) return self->fail();
                   self->take(*page);
                 });
  }
  /// The reader learns its position with its first piece, and of a gap when there is one.
  void take(const app::EventService::Page& page) {
    std::string piece = page.text;
    const std::string id = events_.id_text(page.position);
    if (page.gap || gap_) {
      append_event(piece, "resync", id, kGap);
    } else if (!place_.after) {
      append_event_id(piece, id);
    }
    gap_ = false;
    place_.after = page.position;
    took(std::move(piece), page.more);
  }

  // Only the one thread that reads uses these.
  app::EventService::Place place_;
  bool gap_ = false;
};

EventStream::Start start_of(const Services& services, const Request& request) {
  const auto named = last_event_id(request);
  if (!named) return {};
  const auto position = services.events.position_of(*named);
  return {.after = position, .gap = !position};
}

Response stream_events(const Services& services, const Request& request) {
  const auto source = request.text("source");
  // `all` is no source, so that the filter is off.
  return event_response(std::make_shared<EventStream>(
      services.events, start_of(services, request),
      source ? app::source_from_word(*source) : std::optional(app::Source::Gauge)));
}

}  // namespace

void add_events_routes(Routes& add) {
  add("GET /v1/events followEvents viewer",
      [&services = add.services](const Request& request) {
        return Result<Response>(stream_events(services, request));
      },
      {.summary = "Events as Server-Sent Events",
       .description =
           "measurement.recorded and verdict.reject carry the record, run.finished the run, "
           "table.changed the column and the revision in force from then on, note.added the note. "
           "A reader that names the id of the last event it had goes on with the next; `resync` "
           "says that some are gone.",
       .parameters = {query("source", http::Words{{"gauge", "simulation", "all"}},
                            "Source of the measurements (default: gauge)")},
       .response_types = {std::string(kEventStreamType)},
       .outcomes = {{.meaning = "Events without an end", .schema = "Event"}}});
  add_last_event_id(add.all.back().parameters);
}

}  // namespace fitgauge::api
