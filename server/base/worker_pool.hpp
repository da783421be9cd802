#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "base/bounded_queue.hpp"
#include "base/thread.hpp"

namespace fitgauge {

/// A few threads that work off one bounded queue, for what may take long. Owns its threads.
/// Thread-safe. What a job throws is a bug: it is reported and ends that job alone.
class WorkerPool {
 public:
  using Job = std::function<void()>;
  using Ticket = std::uint64_t;

  /// @param place names the threads in reports of bugs: a literal.
  /// @param queue most jobs that wait; those being run do not count.
  WorkerPool(std::string_view place, unsigned threads, std::size_t queue);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  /// Queues a job. @returns nothing when the queue is full or the pool is stopping; the job is then
  /// not run.
  [[nodiscard]] std::optional<Ticket> submit(Job job);

  /// Takes a job back that no thread has begun. @returns false when it has begun, or is over.
  [[nodiscard]] bool withdraw(Ticket ticket);

  /// Takes no more jobs, finishes those queued and ends the threads. Not for the pool's own.
  void stop();

 private:
  struct Queued {
    Ticket ticket;
    Job job;
  };

  void run();

  const std::string_view place_;
  std::atomic<Ticket> last_ticket_{0};
  BoundedQueue<Queued> queue_;
  std::vector<Thread> threads_;
};

}  // namespace fitgauge
