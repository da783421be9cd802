#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace fitgauge::app {

/// A few threads that work off one bounded queue, for what may take long. Owns its threads.
/// Thread-safe. A job must not throw.
class WorkerPool {
 public:
  using Job = std::function<void()>;

  WorkerPool(unsigned threads, std::size_t queue);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  /// @returns false when the queue is full or the pool is stopping; the job is then not run.
  bool submit(Job job);

  /// Takes no more jobs, finishes those queued and ends the threads. Not for the pool's own.
  void stop();

 private:
  void run();

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace fitgauge::app
