#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/guarded.hpp"
#include "base/result.hpp"
#include "base/thread_memory.hpp"

namespace fitgauge::store {

/// Work on the stores of one connection together with what is to happen with its result. `prepare`
/// and `run` are called at most once, then exactly one of `deliver` and `refuse`.
template <class Stores>
class Job {
 public:
  Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  virtual ~Job() = default;

  /// Called by a reader before its transaction begins: what is committed from now on may be unseen.
  virtual void prepare() {}
  /// @returns whether the work succeeded; its changes are kept only then.
  virtual bool run(Stores& stores) = 0;
  virtual void deliver() = 0;
  virtual void refuse(Error error) = 0;
};

/// Tells a job its outcome. What its completion throws is a bug in that completion alone.
template <class Stores>
void tell(Job<Stores>& job, std::optional<Error> error) noexcept {
  guarded("a storage job's completion", [&] {
    if (error) return job.refuse(*std::move(error));
    job.deliver();
  });
}

/// A job made of two callables: Result<T> work(Stores&), which may have a member prepare(), and
/// void done(Result<T>).
template <class Stores, class Work, class Done>
class CallableJob final : public Job<Stores> {
 public:
  using Outcome = std::invoke_result_t<Work&, Stores&>;

  CallableJob(Work work, Done done) : work_(std::move(work)), done_(std::move(done)) {}

  void prepare() override {
    if constexpr (requires { work_.prepare(); }) work_.prepare();
  }
  bool run(Stores& stores) override {
    outcome_.emplace(work_(stores));
    return outcome_->has_value();
  }
  void deliver() override { done_(*std::move(outcome_)); }
  void refuse(Error error) override { done_(Outcome(std::move(error))); }

 private:
  Work work_;
  Done done_;
  std::optional<Outcome> outcome_;
};

/// Submits `work` to `queue` and waits for its outcome. Not for I/O threads, nor for the queue's
/// own. What the outcome holds is counted as the calling thread's memory, the job itself is not.
template <class Queue, class Stores, class Work>
auto wait_for(Queue& queue, Work work) {
  using Outcome = std::invoke_result_t<Work&, Stores&>;
  const std::int64_t before = thread_memory();
  std::int64_t taken = 0;
  auto outcome = [&] {
    std::promise<Outcome> promise;
    auto future = promise.get_future();
    queue.submit(
        [&work, &taken](Stores& stores) {
          const std::int64_t begun = thread_memory();
          Outcome made = work(stores);
          taken = thread_memory() - begun;
          hand_over_memory(-taken);
          return made;
        },
        [&promise](Outcome made) { promise.set_value(std::move(made)); });
    return future.get();
  }();
  hand_over_memory(before + taken - thread_memory());
  return outcome;
}

}  // namespace fitgauge::store
