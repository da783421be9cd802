#pragma once

#include <memory>
#include <utility>

#include "db/store/job.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store {

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

}  // namespace fitgauge::store
