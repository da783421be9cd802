#include "api/service/event_stream.hpp"

#include <utility>

#include "api/wire/event_text.hpp"
#include "app/measurements/record.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kRowsAPiece = 200;
constexpr std::string_view kGap =
    R"({"detail":"the events after the id you named are gone: read the lists again"})";

std::string data_of(const app::Event& event) {
  if (event.measurement == nullptr) return std::string(event.payload);
  std::string data;
  app::append_record(data, *event.measurement);
  return data;
}

}  // namespace

void EventStream::next(http::ChunkSink sink) {
  {
    const std::lock_guard lock(mutex_);
    sink_ = std::move(sink);
    reading_ = true;
    missed_ = false;
  }
  if (!std::exchange(begun_, true)) events_.add(shared_from_this());
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
  auto piece = std::make_shared<std::string>();
  events_.read(
      gap_ ? std::nullopt : position_, source_, kRowsAPiece,
      [piece](const app::Event& event) {
        append_event(*piece, event.type, app::event_id_text(event.id), data_of(event));
      },
      [self = shared_from_this(), piece](Result<app::EventService::Page> page) {
        if (!page) return self->fail();
        self->take(*page, std::move(*piece));
      });
}

/// The reader learns its position with its first piece, and of a gap when there is one.
void EventStream::take(const app::EventService::Page& page, std::string piece) {
  const std::string id = app::event_id_text(page.position);
  if (page.gap || gap_) {
    append_event(piece, "resync", id, kGap);
  } else if (!position_) {
    append_event_id(piece, id);
  }
  gap_ = false;
  position_ = page.position;

  std::optional<http::ChunkSink> sink;
  {
    const std::lock_guard lock(mutex_);
    const bool again = piece.empty() && missed_ && sink_;
    missed_ = false;
    reading_ = again;
    if (!piece.empty()) sink = std::exchange(sink_, std::nullopt);
    if (!again && !sink) return;
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
