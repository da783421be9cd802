#pragma once

#include <memory>
#include <utility>

#include "db/store/job.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store {

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
