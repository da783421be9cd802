#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "base/clock.hpp"
#include "http/server.hpp"
#include "plant/mtconnect/agent_session.hpp"

namespace fitgauge::app {
class EventService;
class MeasurementService;
}  // namespace fitgauge::app

namespace fitgauge::shdr {

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

}  // namespace fitgauge::shdr
