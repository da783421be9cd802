#pragma once

#include "base/thread.hpp"
#include "http/server.hpp"

namespace fitgauge::daemon {

/// Levels in rising order; `Off` is the highest.
enum class LogLevel { Debug, Info, Warning, Error, Off };

/// `warning` as the configuration names it. @pre one of its words.
LogLevel log_level_named(std::string_view word);

/// Each appends one line of JSON with its line feed: time (UTC, microseconds), level and event.
void append_event_line(std::string& out, LogLevel level, std::string_view event,
                       std::string_view detail);
/// Logs it with the caller's name if the request had a key, and with the client of a proxy.
void append_request_line(std::string& out, LogLevel level, const http::FinishedRequest& finished);

// JSON lines on stderr, one an event; docs/reference/log.md lists them. Thread-safe and never
// blocks: the lines go through a bounded queue, and lines that its reader is too slow for are
// counted and reported. Without an open log nothing is written.

void open_log(const std::string& level);

/// An answer of 5xx is an error; the others are information.
void log_request(const http::FinishedRequest& finished);
void log_info(std::string_view event, std::string_view detail);
void log_warning(std::string_view event, std::string_view detail);
void log_error(std::string_view event, std::string_view detail);

/// Lines lost since the start.
std::uint64_t log_lines_lost();

/// Writes queued lines before the process ends, at most for a second. Then no thread may log.
void close_log();

/// A bounded queue of lines with one thread that writes them to a file descriptor. Logging never
/// waits for the reader: a line without room is lost, and counted in the log later. Thread-safe.
class LogQueue {
 public:
  /// @param descriptor stays open as long as the process: a reader that has stalled may still block
  /// the thread in a write when the queue is gone.
  /// @param room bytes of waiting lines.
  explicit LogQueue(int descriptor, std::size_t room = std::size_t{1} << 20);
  /// Writes queued lines for at most `kPatience`.
  ~LogQueue();
  LogQueue& operator=(LogQueue&&) = delete;  // neither copied nor moved

  static constexpr std::chrono::milliseconds kPatience{1000};

  /// Only lines other than request lines may use the last quarter of the room.
  enum class Kind { Request, Other };
  /// Queues `line`, which ends with a line feed, or counts it as lost.
  void push(std::string_view line, Kind kind);

  /// Lines lost since the start: there was no room, or the write failed.
  std::uint64_t lost() const;

 private:
  struct State;

  std::shared_ptr<State> state_;  ///< shared with the thread, which may outlive the queue
  Thread thread_;
};

}  // namespace fitgauge::daemon
