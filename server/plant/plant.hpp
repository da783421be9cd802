#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"
#include "plant/connection_state.hpp"

namespace fitgauge::app {
class DocumentService;
class EventService;
class FileService;
class MeasurementService;
class TableCatalog;
}  // namespace fitgauge::app
namespace fitgauge::api {
class GaugesInUse;
}

namespace fitgauge::connections {

/// The service as its connections see it; outlives them.
struct Plant {
  app::MeasurementService& measurements;  ///< the log that is followed and recorded into
  app::EventService& events;
  app::DocumentService& documents;  ///< where connections and their progress are kept
  app::FileService& files;
  const app::TableCatalog& tables;
  const api::GaugesInUse& gauges;
  const Clock& clock;
  std::string origin{};                          ///< of the data folder: 16 hexadecimal digits
  std::vector<std::filesystem::path> folders{};  ///< that connections made over HTTP may name
  bool may_reach_private = false;                ///< addresses of this machine and its networks
  bool is_shared = false;  ///< daemons with one database would each do what a connection does
  /// The event's name and a sentence, for the log of the service; called on any thread.
  std::function<void(std::string_view event, const std::string& detail)> tell{};
};

/// A connection at work, on a thread of its own that ends with it.
class Worker {
 public:
  /// @param name of the connection. @param plant outlives it.
  Worker(std::string name, const Plant& plant) : plant_(plant), name_(std::move(name)) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  virtual ~Worker() = default;

  /// Begins to end: for many that are to end together. Thread-safe.
  virtual void request_stop() = 0;
  /// What it has done, without what its definition says. Thread-safe.
  ConnectionState state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }

 protected:
  template <class Change>
  void change(const Change& what) {
    const std::lock_guard lock(mutex_);
    what(state_);
  }
  /// An attempt begins, or its next step, which may wait for the other side.
  void begin_attempt();
  /// Counts an ended attempt, and logs the first that fails and the first that succeeds again.
  /// @param why it failed; none: it did not. @param delivered something before it failed
  void finish_attempt(const std::optional<std::string>& why, bool delivered = false);
  /// Counts a refusal that is repeated at once: the connection is not failing yet.
  /// @param delivered whether something went out before it
  void pass_refusal(const std::string& why, bool delivered);

  const Plant& plant_;

 private:
  const std::string name_;
  mutable std::mutex mutex_;
  ConnectionState state_;
};

}  // namespace fitgauge::connections
