#pragma once

#include "base/allowance.hpp"
#include "base/histogram.hpp"
#include "base/thread.hpp"
#include "base/worker_pool.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store {

/// Work on the stores of one connection with the handler of its result. `prepare` and `run` are
/// called at most once, then exactly one of `deliver` and `refuse`.
template <class Stores>
class Job {
 public:
  Job& operator=(Job&&) = delete;  // neither copied nor moved
  virtual ~Job() = default;

  /// Called by a reader before its transaction begins: later commits may be invisible to it.
  virtual void prepare() {}
  /// @returns whether the work succeeded; otherwise its changes are reverted.
  virtual bool run(Stores& stores) = 0;
  virtual void deliver() = 0;
  virtual void refuse(Error error) = 0;
};

/// Delivers the outcome to a job. An exception of its completion is reported and goes no further.
template <class Stores>
void tell(Job<Stores>& job, std::optional<Error> error) noexcept {
  guarded("a storage job's completion", [&] {
    if (error) return job.refuse(*std::move(error));
    job.deliver();
  });
}

/// The result of work on stores, which may also return a value that is no Result, or nothing.
template <class T>
struct AsResult {
  using Type = Result<T>;
};
template <class T>
struct AsResult<Result<T>> {
  using Type = Result<T>;
};
template <class Work, class Stores>
using OutcomeOf = typename AsResult<std::invoke_result_t<Work&, Stores&>>::Type;
template <class Stores, class Work>
OutcomeOf<Work, Stores> outcome_of(Work& work, Stores& stores) {
  if constexpr (std::is_void_v<std::invoke_result_t<Work&, Stores&>>) {
    work(stores);
    return {};
  } else {
    return work(stores);
  }
}

/// A job made of two callables: work(Stores&), which may have a member prepare(), and void done(…)
/// with its outcome.
template <class Stores, class Work, class Done>
class CallableJob final : public Job<Stores> {
 public:
  using Outcome = OutcomeOf<Work, Stores>;

  CallableJob(Work work, Done done) : work_(std::move(work)), done_(std::move(done)) {}

  void prepare() override {
    if constexpr (requires { work_.prepare(); }) work_.prepare();
  }
  bool run(Stores& stores) override {
    outcome_.emplace(outcome_of(work_, stores));
    return outcome_->has_value();
  }
  void deliver() override { done_(*std::move(outcome_)); }
  void refuse(Error error) override { done_(Outcome(std::move(error))); }

 private:
  Work work_;
  Done done_;
  std::optional<Outcome> outcome_;
};

/// Jobs that wait for the threads that run them, each on its own connection. Thread-safe.
template <class Stores>
class WaitingJobs {
 public:
  /// Queues `work`, called with `Stores&` on such a thread: it returns a Result, a value or
  /// nothing. `done`: void(Result<T>) is called exactly once, on that thread, or on the calling
  /// thread if the job is refused at once.
  /// @errors StorageBusy if the queue is full; ShuttingDown; StorageUnavailable; StorageCorrupt;
  ///   Internal if the work throws.
  template <class Work, class Done>
  void submit(Work work, Done done) {
    std::unique_ptr<Job<Stores>> job =
        std::make_unique<CallableJob<Stores, Work, Done>>(std::move(work), std::move(done));
    const auto refusal = queue_.push(std::move(job));
    if (refusal == Queue::Refusal::Closed)
      job->refuse({ErrorCode::ShuttingDown, "the service is shutting down"});
    if (refusal == Queue::Refusal::Full)
      job->refuse({ErrorCode::StorageBusy, "the storage is busy: try again soon"});
  }

  /// Submits and waits for the outcome. Not for I/O threads or the threads that run jobs. The
  /// memory of the outcome counts for the calling thread; the job's memory does not.
  template <class Work>
  auto wait(Work work) {
    using Outcome = OutcomeOf<Work, Stores>;
    const std::int64_t before = thread_memory();
    std::int64_t taken = 0;
    auto outcome = wait_for_result<typename Outcome::value_type>([&](auto done) {
      submit(
          [&work, &taken](Stores& stores) {
            const std::int64_t begun = thread_memory();
            Outcome made = outcome_of(work, stores);
            taken = thread_memory() - begun;
            hand_over_memory(-taken);
            return made;
          },
          std::move(done));
    });
    hand_over_memory(before + taken - thread_memory());
    return outcome;
  }

  std::size_t queued() const { return queue_.size(); }  ///< jobs that wait

 protected:
  using Queue = BoundedQueue<std::unique_ptr<Job<Stores>>>;

  explicit WaitingJobs(std::size_t limit) : queue_(limit) {}

  Queue queue_;
};

/// A few threads that read, each on its own read-only connection. A job sees one consistent state
/// of the database. Long lists are read page by page, one job a page, so that a slow client keeps
/// neither a thread nor an old state of the file. After a failed read the thread opens its
/// connection again.
using ReadPool = WaitingJobs<const Stores>;

/// Counts of the writer since the start, for metrics. Written by the writer's thread, read by
/// any.
struct WriterCounters {
  /// Time from a transaction's begin until it is on disk.
  Histogram<12> commit_seconds{
      {0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5}};
  Histogram<9> batch_jobs{{1, 2, 4, 8, 16, 32, 64, 256, 1024}};
  std::atomic<std::uint64_t> failed_commits{0};
  std::atomic<std::int64_t> own_rows{0};    ///< MeasurementsStore::log_size() after the last commit
  std::atomic<std::uint64_t> log_pages{0};  ///< in the write-ahead log after the last commit
};

/// The one thread that writes. It runs all jobs that arrived during the last commit in one
/// transaction, each of several in a savepoint, commits once (durable when the commit returns) and
/// then delivers the outcomes. There is no timer: a single job is committed at once. If a job's
/// work returns an Error, only its own changes are reverted.
///
/// Thread-safe. After a failed commit every job of its batch is refused with StorageUnavailable;
/// unless the disk was full, the connection is opened again, and nothing is delivered before a
/// commit succeeded.
class Writer : public WaitingJobs<Stores> {
 public:
  /// Queues `work`: Result<StoredAnswer>(Stores&), run at most once for the request's key. A
  /// response with a status 2xx is stored in the transaction of the work, and a repeat returns it
  /// with `replayed` set.
  /// @errors IdempotencyKeyReused, IdempotencyInProgress, and those of submit.
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

  /// As wait(), for submit_once().
  template <class Work>
  Result<StoredAnswer> wait_once(IdempotentRequest request, Work work) {
    return wait_for_result<StoredAnswer>(
        [&](auto done) { submit_once(std::move(request), std::move(work), std::move(done)); });
  }

  const WriterCounters& counters() const { return counters_; }

 protected:
  using WaitingJobs::WaitingJobs;

  WriterCounters counters_;

 private:
  /// @returns whether no request of the same scope and key is under way.
  bool begin(const IdempotentRequest& request);
  void end(const IdempotentRequest& request);
  static Error in_progress();

  std::mutex under_way_mutex_;
  std::set<std::tuple<std::string, std::string, std::string, std::string>> under_way_;
};

}  // namespace fitgauge::store
