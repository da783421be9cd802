#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "http/response.hpp"
#include "service/events/event_service.hpp"

namespace fitgauge::api {

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

}  // namespace fitgauge::api
