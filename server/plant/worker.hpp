#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"
#include "service/application.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "service/state/connection_state.hpp"

namespace fitgauge::connections {

/// What all connections work with; outlives them.
struct Surroundings {
  app::Application& app;
  const Clock& clock;
  const api::GaugesInUse& gauges;
  std::vector<std::filesystem::path> folders{};  ///< that connections made over HTTP may name
  bool may_reach_private = false;                ///< addresses of this machine and its networks
  /// The event's name and a sentence, for the log of the service; called on any thread.
  std::function<void(std::string_view event, const std::string& detail)> tell{};

  /// Tells what an attempt of the connection of that name has changed. @param why it failed.
  void tell_turn(app::AttemptTurn turn, const std::string& name,
                 const std::optional<std::string>& why) const {
    if (turn == app::AttemptTurn::Failing) tell("connection_failing", name + ": " + *why);
    if (turn == app::AttemptTurn::Recovered) tell("connection_recovered", name);
  }
};

/// A connection at work, on a thread of its own that ends with it.
class Worker {
 public:
  Worker() = default;
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  virtual ~Worker() = default;

  /// Begins to end: for many that are to end together. Thread-safe.
  virtual void request_stop() = 0;
  /// What it has done, without what its definition says. Thread-safe.
  virtual app::ConnectionState state() const = 0;
};

}  // namespace fitgauge::connections
