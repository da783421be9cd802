#pragma once

#include <filesystem>

#include "base/clock.hpp"

namespace fitgauge::connections {

/// A measurement that the other side refused finally.
struct DeadLetter {
  std::string measurement{};  ///< its id
  std::string reason{};
  Timestamp at{};
};

/// A connection to another system, and its activity since the start.
struct ConnectionState {
  std::string name{};
  std::string kind{};
  std::string settings{};     ///< JSON object: all but its secrets
  bool is_outgoing = false;   ///< follows the log; otherwise it brings measurements
  bool is_read_only = false;  ///< belongs to the configuration file

  bool is_failing = false;   ///< its last attempt failed
  bool is_stopped = false;   ///< for good: the other side ended the connection
  std::string last_error{};  ///< of the last failed attempt; empty: none failed
  std::optional<Timestamp> last_attempt_at{};
  std::optional<Timestamp> last_success_at{};
  std::optional<Timestamp> attempt_began_at{};  ///< of the attempt that is under way
  std::chrono::steady_clock::time_point attempt_began{};

  // Only for outgoing connections:
  std::optional<std::int64_t> position{};  ///< how many measurements of the log are dealt with
  std::int64_t behind = 0;                 ///< how many are not
  std::optional<Timestamp> waits_since{};  ///< time of receipt of the next one to send
  std::vector<DeadLetter> dead_letters{};  ///< the newest first; a bounded number

  std::uint64_t attempts = 0;
  std::uint64_t failures = 0;      ///< of those
  std::uint64_t files = 0;         ///< read or written
  std::uint64_t bytes = 0;         ///< of those
  std::uint64_t logs = 0;          ///< read in them, whether new or not
  std::uint64_t measurements = 0;  ///< stored, or sent to the other side
  std::uint64_t values_kept = 0;   ///< angles and figures of axes, which stay in their file
  std::uint64_t unreadable = 0;    ///< places that no reader understood, files that were refused
  std::uint64_t refused = 0;       ///< dead letters, with those that are not listed any longer
};

/// Nanoseconds since the last progress; none before the first success. Outgoing: age of the next
/// measurement to send, none if it was not started; incoming: time since the last success.
inline std::optional<std::int64_t> lag(const ConnectionState& state, Timestamp now) {
  const auto since = [&](Timestamp then) {
    return std::max<std::int64_t>(now.nanoseconds - then.nanoseconds, 0);
  };
  if (!state.is_outgoing || (state.is_failing && !state.position)) {
    return state.last_success_at ? std::optional(since(*state.last_success_at)) : std::nullopt;
  }
  return state.waits_since ? since(*state.waits_since) : 0;
}

/// Maximum duration of a step, unless the other side or a file blocks it.
inline constexpr std::chrono::seconds kLongestStep{60};

/// Whether the current attempt makes no progress.
inline bool hangs(const ConnectionState& state, std::chrono::steady_clock::time_point now) {
  return state.attempt_began_at && now - state.attempt_began > kLongestStep;
}

/// A counter of all connections, by the name it has in JSON.
struct ConnectionCounter {
  std::string_view name;
  std::uint64_t ConnectionState::*value;
  std::string_view meaning;
};
inline constexpr std::array<ConnectionCounter, 9> kConnectionCounters = {{
    {"attempts", &ConnectionState::attempts,
     "Attempts since the start; so are all following counts"},
    {"failures", &ConnectionState::failures, "Attempts that failed"},
    {"files", &ConnectionState::files, "Files read because they were new, or files written"},
    {"bytes", &ConnectionState::bytes, "Bytes of these files"},
    {"logs", &ConnectionState::logs, "Measuring logs read in files, new or not"},
    {"measurements", &ConnectionState::measurements, "Measurements stored, or delivered"},
    {"values_kept", &ConnectionState::values_kept,
     "Angles and figures of axes, which are not stored"},
    {"unreadable", &ConnectionState::unreadable,
     "Places that no reader understood, files that were refused"},
    {"refused", &ConnectionState::refused, "Measurements that the other side refused finally"},
}};

/// The result of a test of a connection.
struct ConnectionTest {
  bool ok = false;
  std::string detail{};
};
/// How a kind of connection gives it: with an error, the other side was not reached.
using TestResult = Result<std::string>;

}  // namespace fitgauge::connections

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
  app::DocumentService& documents;  ///< store of connections and their positions
  app::FileService& files;
  const app::TableCatalog& tables;
  const api::GaugesInUse& gauges;
  const Clock& clock;
  std::string origin{};                          ///< of the data folder: 16 hexadecimal digits
  bool is_branch = false;                        ///< it has had another origin before
  std::vector<std::filesystem::path> folders{};  ///< that connections made over HTTP may name
  bool may_reach_private = false;                ///< addresses of this machine and its networks
  bool is_shared = false;  ///< with one database, each daemon would repeat the work of a connection
  /// The event's name and a sentence, for the log of the service; called on any thread.
  std::function<void(std::string_view event, const std::string& detail)> tell{};
};

/// A running connection, on a thread that ends with it.
class Worker {
 public:
  /// @param name of the connection. @param plant outlives it.
  Worker(std::string name, const Plant& plant) : plant_(plant), name_(std::move(name)) {}
  Worker& operator=(Worker&&) = delete;  // neither copied nor moved
  virtual ~Worker() = default;

  /// Requests a stop. To end many workers, call this for all before you wait. Thread-safe.
  virtual void request_stop() = 0;
  /// The counts of the connection, without its definition. Thread-safe.
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
  /// Reports the begin of an attempt, or of its next step, which may wait for the other side.
  void begin_attempt() {
    change([&](ConnectionState& state) {
      state.attempt_began_at = plant_.clock.now();
      state.attempt_began = std::chrono::steady_clock::now();
    });
  }
  /// Counts an ended attempt. Logs the first failure and the first success after it.
  /// @param why reason of the failure; none: success. @param delivered something before it failed
  /// @param repeats_at_once the failure is repeated at once: the connection is not failing yet
  void finish_attempt(const std::optional<std::string>& why, bool delivered = false,
                      bool repeats_at_once = false) {
    bool has_changed = false;
    change([&](ConnectionState& state) {
      const bool fails = repeats_at_once ? state.is_failing : why.has_value();
      has_changed = std::exchange(state.is_failing, fails) != fails;
      state.attempt_began_at.reset();
      state.last_attempt_at = plant_.clock.now();
      ++state.attempts;
      if (why) {
        ++state.failures;
        state.last_error = as_utf8(*why);
      }
      if (!why || delivered) state.last_success_at = state.last_attempt_at;
    });
    if (!has_changed) return;
    why ? plant_.tell("connection_failing", name_ + ": " + *why)
        : plant_.tell("connection_recovered", name_);
  }

  const Plant& plant_;

 private:
  const std::string name_;
  mutable std::mutex mutex_;
  ConnectionState state_;
};

}  // namespace fitgauge::connections
