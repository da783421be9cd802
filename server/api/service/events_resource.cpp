#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "api/resources.hpp"
#include "api/wire/event_text.hpp"
#include "http/response.hpp"
#include "record/record.hpp"
#include "service/events/event_service.hpp"

namespace fitgauge::api {
namespace {

/// The events that follow a position, for one reader, until it goes: reads a page when the one
/// before has left, and waits for a commit where there is none. Owns no more than one page, so a
/// slow reader costs nothing and falls behind; the connection drops one that takes nothing.
class EventStream final : public http::BodyStream,
                          public app::CommitListener,
                          public std::enable_shared_from_this<EventStream> {
 public:
  struct Start {
    std::optional<app::EventPosition> after{};  ///< none: from now on
    bool gap = false;                           ///< the reader named a position that is none
  };

  EventStream(app::EventService& events, Start start, std::optional<app::Source> source)
      : events_(events), place_{start.after, source}, gap_(start.gap) {}

  void next(http::ChunkSink sink) override;
  void cancelled() override;
  void committed() override;

 private:
  void read();
  void take(const app::EventService::Page& page);
  void fail();

  app::EventService& events_;

  // Of the one thread that reads at a time.
  app::EventService::Place place_;
  bool begun_ = false;
  bool gap_ = false;

  std::mutex mutex_;
  std::optional<http::ChunkSink> sink_;  ///< where the next piece goes; none while one is sent
  bool reading_ = false;
  bool missed_ = true;  ///< there may be more than was read: a commit came during the read
};

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

void EventStream::next(http::ChunkSink sink) {
  if (!std::exchange(begun_, true)) events_.add(shared_from_this());
  {
    const std::lock_guard lock(mutex_);
    sink_ = std::move(sink);
    reading_ = std::exchange(missed_, false);
    if (!reading_) return;
  }
  read();
}

void EventStream::committed() {
  {
    const std::lock_guard lock(mutex_);
    if (reading_ || !sink_) {
      missed_ = true;
      return;
    }
    reading_ = true;
  }
  read();
}

void EventStream::cancelled() {
  events_.remove(shared_from_this());
  const std::lock_guard lock(mutex_);
  sink_.reset();
}

void EventStream::read() {
  app::EventService::Place place = place_;
  if (gap_) place.after.reset();
  events_.read(place, write_event,
               [self = shared_from_this()](const Result<app::EventService::Page>& page) {
                 if (!page) return self->fail();
                 self->take(*page);
               });
}

/// The reader learns its position with its first piece, and of a gap when there is one.
void EventStream::take(const app::EventService::Page& page) {
  std::string piece = page.text;
  const std::string id = events_.id_text(page.position);
  if (page.gap || gap_) {
    append_event(piece, "resync", id, kGap);
  } else if (!place_.after) {
    append_event_id(piece, id);
  }
  gap_ = false;
  place_.after = page.position;

  std::optional<http::ChunkSink> sink;
  {
    const std::lock_guard lock(mutex_);
    missed_ = missed_ || page.more;
    reading_ = piece.empty() && missed_ && sink_;
    if (reading_) missed_ = false;
    if (!piece.empty()) sink = std::exchange(sink_, std::nullopt);
    if (!reading_ && !sink) return;
  }
  if (sink) {
    sink->put(std::move(piece));
  } else {
    read();
  }
}

void EventStream::fail() {
  std::optional<http::ChunkSink> sink;
  {
    const std::lock_guard lock(mutex_);
    sink = std::exchange(sink_, std::nullopt);
    reading_ = false;
  }
  if (sink) sink->fail();
}

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
