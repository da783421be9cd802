#include "base/thread.hpp"

#include <pthread.h>

#include <cstdio>

namespace fitgauge {
namespace {

void to_stderr(std::string_view place, std::string_view what) {
  std::fprintf(stderr, "fitgauge: bug: %.*s: %.*s\n", static_cast<int>(place.size()), place.data(),
               static_cast<int>(what.size()), what.data());
}

std::atomic<BugReport> report_in_use{to_stderr};

/// Pause, so that a repeated bug fills neither the log nor a processor.
constexpr std::chrono::milliseconds kRest{100};

/// Gives a thread a name that `top -H` shows.
void show_as(pthread_t thread, std::string_view place) {
  constexpr std::size_t kLongestName = 15;  // of the kernel
  for (const std::string_view article : {"a ", "an ", "the "}) {
    if (!place.starts_with(article)) continue;
    place.remove_prefix(article.size());
    break;
  }
  pthread_setname_np(thread, std::string(place.substr(0, kLongestName)).c_str());
}

}  // namespace

void report_bugs_to(BugReport report) { report_in_use = report; }

void report_bug(std::string_view place, std::string_view what) noexcept {
  report_in_use.load()(place, what);
}

Error shutting_down() { return {ErrorCode::ShuttingDown, "the service is shutting down"}; }

Thread::Thread(std::string_view place, Body body)
    : thread_([place, body = std::move(body)](const std::stop_token& stop) {
        while (!guarded(place, [&] { body(stop); }) && wait_unless_stopped(stop, kRest)) {
        }
      }) {
  show_as(thread_.native_handle(), place);
}

bool wait_unless_stopped(const std::stop_token& stop, std::chrono::nanoseconds time) {
  std::mutex mutex;
  std::condition_variable_any over;
  std::unique_lock lock(mutex);
  over.wait_for(lock, stop, time, [] { return false; });
  return !stop.stop_requested();
}

void Thread::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

}  // namespace fitgauge
