#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/thread.hpp"
#include "http/server.hpp"

namespace fitgauge::daemon {

/// In rising order; `Off` is above all.
enum class LogLevel { Debug, Info, Warning, Error, Off };

/// `warning` as the configuration names it. @pre one of its words.
LogLevel log_level_named(std::string_view word);

/// Each appends one line of JSON with its line feed: time (UTC, microseconds), level and what
/// happened.
void append_event_line(std::string& out, LogLevel level, std::string_view event,
                       std::string_view detail);
/// With the caller's name where the request had a key, and what a proxy says it asks for.
void append_request_line(std::string& out, LogLevel level, const http::FinishedRequest& finished);

// JSON lines on stderr, one an event; docs/reference/log.md lists them. Thread-safe, and nobody
// waits: the lines go through a bounded queue, and what its reader is too slow for is counted and
// said. Without an open log nothing is written.

void open_log(const std::string& level);

/// An answer of 5xx is an error; the others are information.
void log_request(const http::FinishedRequest& finished);
void log_info(std::string_view event, std::string_view detail);
void log_warning(std::string_view event, std::string_view detail);
void log_error(std::string_view event, std::string_view detail);

/// Lines lost since the start.
std::uint64_t log_lines_lost();

/// Writes what is queued, for a second at most; before the process ends. No thread may log any
/// more.
void close_log();

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
  LogQueue& operator=(LogQueue&&) = delete;  // neither copied nor moved

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
