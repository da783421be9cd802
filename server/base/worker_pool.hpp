#pragma once

#include "base/allowance.hpp"
#include "base/thread.hpp"

namespace fitgauge {

/// Bounded FIFO between threads: adding returns at once if it is full, taking waits. Thread-safe.
template <class Item>
class BoundedQueue {
 public:
  using Items = std::deque<Item>;
  enum class Refusal : std::uint8_t { Full, Closed };

  /// @param limit most items that wait.
  explicit BoundedQueue(std::size_t limit) : limit_(limit) {}

  /// @returns why it was refused; `item` is then unchanged.
  [[nodiscard]] std::optional<Refusal> push(Item&& item) {
    const std::lock_guard lock(mutex_);
    if (closed_) return Refusal::Closed;
    if (items_.size() >= limit_) return Refusal::Full;
    items_.push_back(std::move(item));
    wake_.notify_one();
    return std::nullopt;
  }

  /// Waits for items, at most `patience`. Empty if none came, or the queue is closed.
  Items take_all(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, patience, [this] { return !items_.empty() || closed_; });
    return std::exchange(items_, {});
  }

  /// Waits for one item; none once the queue is closed and empty.
  std::optional<Item> take_one() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return !items_.empty() || closed_; });
    if (items_.empty()) return std::nullopt;
    return take(items_.begin());
  }

  /// Removes the first item for which `is_it` is true; none if there is no such item.
  template <class Predicate>
  std::optional<Item> withdraw(Predicate is_it) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(items_.begin(), items_.end(), is_it);
    if (found == items_.end()) return std::nullopt;
    return take(found);
  }

  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }

  /// Refuses new items; queued items can still be taken.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    wake_.notify_all();
  }

  /// Whether the queue is closed and empty.
  bool is_finished() const {
    const std::lock_guard lock(mutex_);
    return closed_ && items_.empty();
  }

 private:
  Item take(typename Items::iterator place) {
    Item item = std::move(*place);
    items_.erase(place);
    return item;
  }

  const std::size_t limit_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Items items_;
  bool closed_ = false;
};

/// A few threads with one bounded queue, for long work. Owns its threads. Thread-safe. An exception
/// of a job is reported as a bug and ends only that job.
class WorkerPool {
 public:
  using Job = std::function<void()>;
  using Ticket = std::uint64_t;

  /// @param place names the threads in reports of bugs: a literal.
  /// @param queue most jobs that wait; those being run do not count.
  WorkerPool(std::string_view place, unsigned threads, std::size_t queue);
  WorkerPool& operator=(WorkerPool&&) = delete;  // neither copied nor moved
  ~WorkerPool();

  /// Queues a job. @returns nothing, and runs nothing, when the queue is full or the pool stops.
  [[nodiscard]] std::optional<Ticket> submit(Job job);

  /// Removes a job that has not begun. @returns false if it has begun or ended.
  [[nodiscard]] bool withdraw(Ticket ticket);

  /// Refuses new jobs, finishes the queued ones and ends the threads. Not for its own threads.
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

/// The time and memory of one job.
struct JobBound {
  std::chrono::duration<double> time{};
  std::size_t memory_bytes = 0;
};

/// The threads for one kind of work that would block an I/O thread. Thread-safe.
class JobPool {
 public:
  /// @param kind of work, a literal: the name of the threads.
  /// @param waiting most jobs that wait; those being run do not count.
  JobPool(std::string_view kind, unsigned threads, std::size_t waiting,
          std::optional<JobBound> bound = std::nullopt)
      : bound_(bound), pool_(kind, threads, waiting) {}

  /// Calls `compute` on a thread of the pool, which may block, and passes its Result to `done`,
  /// which is called exactly once: there, or at once on the caller's thread. Bounded loops check
  /// Allowance::of_thread().
  /// @errors those of `compute`; Overloaded; ShuttingDown; FiguresLimit beyond the bound; Internal
  ///   if `compute` throws.
  template <class Compute, class Done>
  void run(Compute compute, Done done) {
    const bool is_queued = pool_
                               .submit([this, compute = std::move(compute), done]() mutable {
                                 if (is_called_off()) return done(shutting_down());
                                 bounded(compute, done);
                               })
                               .has_value();
    if (!is_queued) done(is_called_off() ? shutting_down() : full());
  }

  /// Refuses waiting and later jobs, and ends bounded jobs that run. Waits for their threads.
  void call_off() {
    stopping_.request_stop();
    pool_.stop();
  }
  bool is_called_off() const { return stopping_.stop_requested(); }
  std::stop_token stop_token() const { return stopping_.get_token(); }

 private:
  static Error full();
  static Error internal(const std::exception& bug);
  static Error beyond_bound(Allowance::Spent spent);

  template <class Compute, class Done>
  void bounded(Compute& compute, Done& done) {
    std::optional<Allowance> allowance;
    if (bound_) allowance.emplace(bound_->time, bound_->memory_bytes, stop_token());
    const Allowance::OfThread of_thread(allowance ? &*allowance : nullptr);
    auto made = caught(compute);
    if (allowance && allowance->is_spent()) return done(beyond_bound(allowance->found()));
    done(std::move(made));
  }

  template <class Compute>
  static auto caught(Compute& compute) -> decltype(compute()) {
    try {
      return compute();
    } catch (const std::exception& bug) {
      return internal(bug);
    }
  }

  const std::optional<JobBound> bound_;
  std::stop_source stopping_;
  WorkerPool pool_;  // last: its threads use all above
};

}  // namespace fitgauge
