#include "api/service/event_stream.hpp"

#include <utility>

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

}  // namespace

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

}  // namespace fitgauge::api
