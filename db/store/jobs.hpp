#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/allowance.hpp"
#include "base/result.hpp"
#include "base/thread.hpp"
#include "base/worker_pool.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store {

/// Work on the stores of one connection together with what is to happen with its result. `prepare`
/// and `run` are called at most once, then exactly one of `deliver` and `refuse`.
template <class Stores>
class Job {
 public:
  Job& operator=(Job&&) = delete;  // neither copied nor moved
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

template <class Job>
using JobQueue = BoundedQueue<std::unique_ptr<Job>>;

/// Queues a job, or refuses it on this thread when it finds no place.
template <class Job>
void enqueue_or_refuse(JobQueue<Job>& queue, std::unique_ptr<Job> job) {
  using Refusal = typename JobQueue<Job>::Refusal;
  const auto refusal = queue.push(std::move(job));
  if (refusal == Refusal::Closed)
    job->refuse({ErrorCode::ShuttingDown, "the service is shutting down"});
  if (refusal == Refusal::Full)
    job->refuse({ErrorCode::StorageBusy, "the storage is busy: try again soon"});
}

/// A few threads that read, each on a read-only connection of its own. A job sees one consistent
/// state of the database. Long lists are read page by page, one job a page, so that a slow client
/// holds neither a thread nor an old state of the file.
///
/// Thread-safe. After a failed read the thread opens its connection again.
class ReadPool {
 public:
  class Engine;
  explicit ReadPool(Engine& engine) : engine_(engine) {}

  /// Queues `work`: Result<T>(const Stores&), called on a reader thread. `done`: void(Result<T>) is
  /// called exactly once, on the reader thread, or on the calling thread when refused at once.
  /// @errors StorageBusy, ShuttingDown, StorageUnavailable, StorageCorrupt; Internal when it threw.
  template <class Work, class Done>
  void submit(Work work, Done done) {
    enqueue(
        std::make_unique<CallableJob<const Stores, Work, Done>>(std::move(work), std::move(done)));
  }

  /// Submits and waits. Not for I/O threads, nor for a reader thread itself.
  template <class Work>
  auto wait(Work work) {
    return wait_for<ReadPool, const Stores>(*this, std::move(work));
  }

 private:
  void enqueue(std::unique_ptr<Job<const Stores>> job);

  Engine& engine_;
};

/// The one thread that writes. It takes all jobs that arrived during the last commit, runs them in
/// one transaction, each of several in a savepoint, commits once (durable when the commit returns)
/// and then delivers the outcomes. There is no timer: a lone job is committed at once.
///
/// Thread-safe. After a failed commit every job of its batch is refused with StorageUnavailable;
/// the connection is opened again, and nothing is delivered before a commit succeeded.
class Writer {
 public:
  class Engine;
  explicit Writer(Engine& engine) : engine_(engine) {}

  /// Queues `work`: Result<T>(Stores&), called on the writer thread. An Error it returns undoes its
  /// own changes and no other job's. `done`: void(Result<T>) is called exactly once: on the writer
  /// thread after the commit, or on the calling thread when the job is refused at once.
  /// @errors StorageBusy when the queue is full; ShuttingDown; StorageUnavailable; StorageCorrupt;
  ///   Internal when the work threw.
  template <class Work, class Done>
  void submit(Work work, Done done) {
    enqueue(std::make_unique<CallableJob<Stores, Work, Done>>(std::move(work), std::move(done)));
  }

  /// The same with `work`: Result<StoredAnswer>(Stores&), made at most once for the request's key:
  /// the answer is kept in the work's own transaction when its status is 2xx, and a repeat gets it
  /// back with `replayed` set.
  /// @errors IdempotencyKeyReused, IdempotencyInProgress, and those above.
  template <class Work, class Done>
  void submit_once(IdempotentRequest request, Work work, Done done) {
    if (!begin(request)) {
      done(Result<StoredAnswer>(in_progress()));
      return;
    }
    auto once = [request, work = std::move(work)](Stores& stores) mutable {
      return stores.idempotency.once(request, [&] { return work(stores); });
    };
    submit(std::move(once),
           [this, request, done = std::move(done)](Result<StoredAnswer> answer) mutable {
             end(request);
             done(std::move(answer));
           });
  }

  /// Submits and waits. Not for I/O threads, nor for the writer thread itself.
  template <class Work>
  auto wait(Work work) {
    return wait_for<Writer, Stores>(*this, std::move(work));
  }
  template <class Work>
  Result<StoredAnswer> wait_once(IdempotentRequest request, Work work) {
    std::promise<Result<StoredAnswer>> promise;
    auto future = promise.get_future();
    submit_once(std::move(request), std::move(work),
                [&promise](Result<StoredAnswer> answer) { promise.set_value(std::move(answer)); });
    return future.get();
  }

 private:
  void enqueue(std::unique_ptr<Job<Stores>> job);
  bool begin(const IdempotentRequest& request);
  void end(const IdempotentRequest& request);
  static Error in_progress();

  Engine& engine_;
};

}  // namespace fitgauge::store
