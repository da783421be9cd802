#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

#include "plant/lsv2/collector_options.hpp"
#include "service/application.hpp"
#include "service/state/connection_state.hpp"

namespace fitgauge::collector {

/// What is told to the log, from the threads of the machines.
struct CollectorHooks {
  /// A machine cannot be read any more, or its files not stored; said once until it can.
  std::function<void(std::string_view name, std::string_view why)> failed{};
  std::function<void(std::string_view name)> recovered{};
  /// What no reader understood in a file that is new or has changed.
  std::function<void(std::string_view name, std::string_view path, std::string_view why)> unread{};
};

/// Reads measuring logs from a control over LSV-2, with a thread and a connection of its own: one
/// that is slow or away holds up no other. It logs in as INSPECT and FILE, and only lists and
/// reads. A machine that is away is asked again after twice the time, up to ten minutes.
class Collector {
 public:
  /// @param app, clock outlive it.
  Collector(MachineOptions machine, app::Application& app, const Clock& clock,
            CollectorHooks hooks);
  /// Ends all waits and waits for what is being stored.
  ~Collector();
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  /// Begins to end: for many that are to end together. Thread-safe.
  void request_stop();
  /// What it has done, without its name and settings. Thread-safe.
  app::ConnectionState state() const;

 private:
  class Machine;
  std::unique_ptr<Machine> machine_;
};

/// Logs in and lists the watched folders once. Waits.
app::ConnectionTest test_machine(const MachineOptions& machine, const std::stop_token& stop);

}  // namespace fitgauge::collector
