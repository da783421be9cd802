#include "base/thread.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "base/guarded.hpp"

namespace fitgauge {
namespace {

/// So that a bug that comes again at once fills neither the log nor a processor.
constexpr std::chrono::milliseconds kRest{100};

void rest(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any over;
  std::unique_lock lock(mutex);
  over.wait_for(lock, stop, kRest, [] { return false; });
}

}  // namespace

Thread::Thread(std::string_view place, Body body)
    : thread_([place, body = std::move(body)](const std::stop_token& stop) {
        while (!guarded(place, [&] { body(stop); }) && !stop.stop_requested()) rest(stop);
      }) {}

void Thread::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

}  // namespace fitgauge
