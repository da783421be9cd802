#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>
#include <utility>

#include "base/allowance.hpp"
#include "base/result.hpp"
#include "base/worker_pool.hpp"

namespace fitgauge {

/// The time and memory of one job.
struct JobBound {
  std::chrono::duration<double> time{};
  std::size_t memory_bytes = 0;
};

/// The threads for one kind of work that would hold up an I/O thread. Thread-safe.
class JobPool {
 public:
  /// @param kind of work, a literal: the name of the threads.
  /// @param waiting most jobs that wait; those being run do not count.
  JobPool(std::string_view kind, unsigned threads, std::size_t waiting,
          std::optional<JobBound> bound = std::nullopt)
      : bound_(bound), pool_(kind, threads, waiting) {}

  /// Calls `compute` on a thread of the pool, which it may block, and hands what it returns, a
  /// Result, to `done`, which is called exactly once: there, or at once on the caller's thread.
  /// Loops of bounded work look at Allowance::of_thread().
  /// @errors those of `compute`; Overloaded; ShuttingDown; FiguresLimit beyond the bound; Internal
  ///   for what `compute` throws.
  template <class Compute, class Done>
  void run(Compute compute, Done done) {
    const bool is_queued = pool_
                               .submit([this, compute = std::move(compute), done]() mutable {
                                 if (is_called_off()) return done(ended());
                                 bounded(compute, done);
                               })
                               .has_value();
    if (!is_queued) done(is_called_off() ? ended() : full());
  }

  /// Refuses the jobs that wait and those to come, and ends bounded ones that are under way. Waits
  /// for their threads.
  void call_off() {
    stopping_.request_stop();
    pool_.stop();
  }
  bool is_called_off() const { return stopping_.stop_requested(); }
  std::stop_token stop_token() const { return stopping_.get_token(); }

 private:
  static Error full();
  static Error ended();
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
