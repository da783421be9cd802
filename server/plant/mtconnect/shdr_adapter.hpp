#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "base/clock.hpp"
#include "http/server.hpp"
#include "plant/mtconnect/agent_session.hpp"
#include "plant/mtconnect/mtconnect_document.hpp"

// SHDR, which an adapter tells an agent: `time|data item|value|data item|value` and a line end. The
// data items are those of the device Gauge, by their ids.

namespace fitgauge::app {
class EventService;
class MeasurementService;
}  // namespace fitgauge::app

namespace fitgauge::mtconnect {

std::string shdr_availability(Timestamp at);
/// The part and the feature, whose table has one entry.
std::string shdr_line(const app::Measurement& measurement);
std::string shdr_line(const Counts& counts, Timestamp at);

/// A text as a value between `|`: in quotes where it has one or begins with a quote, without
/// control characters, and UNAVAILABLE where there is none.
std::string shdr_text(std::string_view text);

struct AdapterOptions {
  http::ListenAddress listen{};
  std::size_t most_agents = 16;  ///< beyond it one is closed at once
  SessionOptions session{};
  /// An agent was refused or sent away: its address and why. On the adapter's thread.
  std::function<void(std::string_view peer, std::string_view why)> sent_away{};
};

/// Tells agents of MTConnect what is measured, as lines of SHDR. An agent that connects gets the
/// newest measurement and the counts, and from then on what is stored, in order. It reads the log
/// while an agent is there, on a thread of its own; no writer waits for it.
class ShdrAdapter {
 public:
  /// @param measurements, events, clock outlive it. @errors ListenFailed
  static Result<std::unique_ptr<ShdrAdapter>> start(AdapterOptions options,
                                                    app::MeasurementService& measurements,
                                                    app::EventService& events, const Clock& clock);
  /// Closes every connection.
  ~ShdrAdapter();
  ShdrAdapter(const ShdrAdapter&) = delete;
  ShdrAdapter& operator=(const ShdrAdapter&) = delete;

  /// The actual one where 0 was asked for.
  std::uint16_t port() const;

 private:
  class Loop;
  explicit ShdrAdapter(std::shared_ptr<Loop> loop);

  const std::shared_ptr<Loop> loop_;
};

}  // namespace fitgauge::mtconnect
