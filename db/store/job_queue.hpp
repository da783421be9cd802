#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/error.hpp"

namespace fitgauge::store {

/// A bounded queue of jobs for one or more threads. Thread-safe. A job that finds no place is
/// refused on the thread that brings it.
template <class Job>
class JobQueue {
 public:
  using Jobs = std::deque<std::unique_ptr<Job>>;

  explicit JobQueue(std::size_t limit) : limit_(limit) {}

  void push(std::unique_ptr<Job> job) {
    if (std::optional<Error> refused = try_push(job)) job->refuse(*std::move(refused));
  }

  /// Waits for work, at most `patience`. Empty when there was none, or nothing comes any more.
  Jobs take_all(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, patience, [this] { return !jobs_.empty() || closed_; });
    return std::exchange(jobs_, {});
  }

  /// Waits for one job; none once the queue is closed and empty.
  std::unique_ptr<Job> take_one() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return !jobs_.empty() || closed_; });
    if (jobs_.empty()) return nullptr;
    std::unique_ptr<Job> job = std::move(jobs_.front());
    jobs_.pop_front();
    return job;
  }

  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return jobs_.size();
  }

  /// What is queued still runs, what comes from now on is refused.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    wake_.notify_all();
  }

  /// Whether nothing is left and nothing comes any more.
  bool is_finished() const {
    const std::lock_guard lock(mutex_);
    return closed_ && jobs_.empty();
  }

 private:
  std::optional<Error> try_push(std::unique_ptr<Job>& job) {
    const std::lock_guard lock(mutex_);
    if (closed_) return Error{ErrorCode::ShuttingDown, "the service is shutting down"};
    if (jobs_.size() >= limit_) {
      return Error{ErrorCode::StorageBusy, "the storage has all the work it takes; try again soon"};
    }
    jobs_.push_back(std::move(job));
    wake_.notify_one();
    return std::nullopt;
  }

  const std::size_t limit_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Jobs jobs_;
  bool closed_ = false;
};

}  // namespace fitgauge::store
