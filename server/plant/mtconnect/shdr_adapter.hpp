#pragma once

#include "http/server.hpp"
#include "plant/mtconnect/mtconnect_document.hpp"
#include "service/events/event_service.hpp"

namespace fitgauge::mtconnect {

// SHDR, which an adapter sends to an agent: `time|data item|value|data item|value` and a line end.
// The data items are those of the device Gauge, by their ids.

std::string shdr_availability(Timestamp at);
/// The part and the feature, whose table has one entry.
std::string shdr_line(const app::Measurement& measurement);
std::string shdr_line(const Counts& counts, Timestamp at);

/// A text as a value between `|`: quoted if it has one or begins with a quote, without control
/// characters; UNAVAILABLE if it is absent.
std::string shdr_text(std::string_view text);

struct AdapterOptions {
  http::ListenAddress listen{};
  std::size_t most_agents = 16;  ///< further agents are closed at once
  /// Reports an agent that was sent away: address and reason. On the adapter's thread.
  std::function<void(std::string_view peer, std::string_view why)> sent_away{};
};

/// Sends measurements to MTConnect agents as lines of SHDR. A new agent gets the newest measurement
/// and the counts, and then all stored measurements in order. It reads the log on its own thread
/// while an agent is connected; no writer waits for it.
class ShdrAdapter {
 public:
  /// @param measurements, events, clock outlive it. @errors ListenFailed
  static Result<std::unique_ptr<ShdrAdapter>> start(AdapterOptions options,
                                                    app::MeasurementService& measurements,
                                                    app::EventService& events, const Clock& clock);
  /// Closes every connection.
  ~ShdrAdapter();
  ShdrAdapter& operator=(ShdrAdapter&&) = delete;  // neither copied nor moved

  /// The actual port if 0 was requested.
  std::uint16_t port() const;

 private:
  class Loop;
  explicit ShdrAdapter(std::shared_ptr<Loop> loop);

  const std::shared_ptr<Loop> loop_;
};

}  // namespace fitgauge::mtconnect
