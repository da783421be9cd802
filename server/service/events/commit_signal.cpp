#include "service/events/commit_signal.hpp"

#include <chrono>
#include <vector>

#include "base/thread.hpp"

namespace fitgauge::app {
namespace {

/// Between two rounds, so that a busy writer does not keep the readers busy for each of its
/// commits.
constexpr std::chrono::milliseconds kRest{5};

}  // namespace

CommitSignal::CommitSignal()
    : thread_("commit signal", [this](const std::stop_token& stop) { run(stop); }) {}
CommitSignal::~CommitSignal() = default;

void CommitSignal::stop() { thread_.stop(); }

void CommitSignal::raise() {
  const std::lock_guard lock(mutex_);
  if (raised_ || listeners_.empty()) return;
  raised_ = true;
  wake_.notify_one();
}

void CommitSignal::add(std::shared_ptr<CommitListener> listener) {
  const std::lock_guard lock(mutex_);
  listeners_.insert(std::move(listener));
}

void CommitSignal::remove(const std::shared_ptr<CommitListener>& listener) {
  const std::lock_guard lock(mutex_);
  listeners_.erase(listener);
}

std::size_t CommitSignal::listeners() const {
  const std::lock_guard lock(mutex_);
  return listeners_.size();
}

void CommitSignal::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return raised_; })) {
    raised_ = false;
    std::vector<std::shared_ptr<CommitListener>> listeners(listeners_.begin(), listeners_.end());
    lock.unlock();
    for (const auto& listener : listeners) {
      guarded("a listener of commits", [&] { listener->committed(); });
    }
    listeners.clear();
    lock.lock();
    wake_.wait_for(lock, stop, kRest, [] { return false; });
  }
}

}  // namespace fitgauge::app
