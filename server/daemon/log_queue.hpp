#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "base/thread.hpp"

namespace fitgauge::daemon {

/// A bounded queue of lines with one thread that writes them to a file descriptor. Whoever logs
/// never waits for whoever reads: a line that finds no room is lost, counted, and the count is
/// written as an event of its own once there is room again. Thread-safe.
class LogQueue {
 public:
  /// @param descriptor stays open as long as the process: a reader that has stalled may still hold
  /// the
  ///   thread in a write when the queue is gone.
  /// @param room bytes of lines that may wait.
  explicit LogQueue(int descriptor, std::size_t room = std::size_t{1} << 20);
  /// Writes what is queued for as long as `kPatience`, then gives up.
  ~LogQueue();
  LogQueue(const LogQueue&) = delete;
  LogQueue& operator=(const LogQueue&) = delete;

  static constexpr std::chrono::milliseconds kPatience{1000};

  /// A request line is one of many; other lines have the last quarter of the room for themselves.
  enum class Kind { Request, Other };
  /// Queues `line`, which ends with a line feed, or counts it as lost.
  void push(std::string_view line, Kind kind);

  /// Lines lost since the start: there was no room, or the write failed.
  std::uint64_t lost() const;

 private:
  struct State;

  std::shared_ptr<State> state_;  ///< the thread's, too: it may have to be left behind
  Thread thread_;
};

}  // namespace fitgauge::daemon
