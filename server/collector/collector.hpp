#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "app/application.hpp"
#include "app/service/connection_state.hpp"
#include "collector/collector_options.hpp"

namespace fitgauge::collector {

/// What is told to the log, from the threads of the machines.
struct CollectorHooks {
  /// A machine cannot be read any more, or its files not stored; said once until it can.
  std::function<void(std::string_view name, std::string_view why)> failed{};
  std::function<void(std::string_view name)> recovered{};
  /// What no reader understood in a file that is new or has changed.
  std::function<void(std::string_view name, std::string_view path, std::string_view why)> unread{};
};

/// Reads measuring logs from controls over LSV-2, with one thread and one connection a machine; a
/// machine that is slow or away holds up no other. It logs in as INSPECT and FILE, and only lists
/// and reads. A machine that is away is asked again after twice the time, up to ten minutes.
class Collector {
 public:
  /// @param app, clock outlive it.
  Collector(std::vector<MachineOptions> machines, app::Application& app, const Clock& clock,
            CollectorHooks hooks);
  /// Ends all waits and waits for what is being stored.
  ~Collector();
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  /// In the order of the configuration. Thread-safe.
  std::vector<app::ConnectionState> states() const;

 private:
  class Machine;
  std::vector<std::unique_ptr<Machine>> machines_;
};

}  // namespace fitgauge::collector
