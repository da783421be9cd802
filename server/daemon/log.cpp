#include "daemon/log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <memory>

#include "daemon/log_line.hpp"
#include "daemon/log_queue.hpp"

namespace fitgauge::daemon {
namespace {

std::unique_ptr<LogQueue> queue;
LogLevel least = LogLevel::Off;

/// Where a standard descriptor is closed, the next file opened would become the log's.
void occupy_standard_descriptors() {
  int descriptor = 0;
  while ((descriptor = ::open("/dev/null", O_RDWR | O_CLOEXEC)) >= 0 &&
         descriptor <= STDERR_FILENO) {
  }
  if (descriptor >= 0) close(descriptor);
}

template <class Append>
void write(LogLevel level, LogQueue::Kind kind, Append append) {
  if (queue == nullptr || level < least) return;
  thread_local std::string line;
  line.clear();
  append(line);
  queue->push(line, kind);
}

void log_event(LogLevel level, std::string_view event, std::string_view detail) {
  write(level, LogQueue::Kind::Other,
        [&](std::string& line) { append_event_line(line, level, event, detail); });
}

}  // namespace

void open_log(const std::string& level) {
  occupy_standard_descriptors();
  least = log_level_named(level);
  queue = std::make_unique<LogQueue>(STDERR_FILENO);
}

void log_request(const http::FinishedRequest& finished) {
  const LogLevel level = finished.status >= 500 ? LogLevel::Error : LogLevel::Info;
  write(level, LogQueue::Kind::Request,
        [&](std::string& line) { append_request_line(line, level, finished); });
}

void log_info(std::string_view event, std::string_view detail) {
  log_event(LogLevel::Info, event, detail);
}

void log_warning(std::string_view event, std::string_view detail) {
  log_event(LogLevel::Warning, event, detail);
}

void log_error(std::string_view event, std::string_view detail) {
  log_event(LogLevel::Error, event, detail);
}

std::uint64_t log_lines_lost() { return queue == nullptr ? 0 : queue->lost(); }

void close_log() { queue.reset(); }

}  // namespace fitgauge::daemon
