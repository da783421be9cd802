#pragma once

#include "base/thread.hpp"
#include "record/measurement_batch.hpp"

namespace fitgauge::app {
class DocumentService;
}

namespace fitgauge::api {

/// Gauges in use from the stored documents, with the results of their budgets. Thread-safe.
class GaugesInUse {
 public:
  explicit GaugesInUse(app::DocumentService& documents) : documents_(documents) {}

  std::shared_ptr<const GaugeBook> book() const { return book_.get(); }

  /// Reads them again after a change. `done` comes when book() has that change, on a storage
  /// thread.
  /// @errors StorageUnavailable, StorageBusy.
  void reload(std::function<void(Result<void>)> done);
  /// Loads them on a thread that may wait.
  Result<void> load();

 private:
  void show(std::uint64_t number, GaugeBook book);

  app::DocumentService& documents_;
  Snapshot<GaugeBook> book_{std::make_shared<const GaugeBook>()};
  std::mutex mutex_;
  std::uint64_t begun_ = 0;  ///< reloads; later ones include earlier ones
  std::uint64_t shown_ = 0;
};

}  // namespace fitgauge::api
