#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/log/leaf.hpp"
#include "app/measurements/measurement_service.hpp"

namespace fitgauge::app {

/// Where small requests wait for the writer. All that come before its job begins are stored by that
/// one job: their rows fill the same statements, and one savepoint serves them all. Thread-safe.
/// Each job owns a reference to the queue, so the queue outlives them; the database drains its jobs
/// when it closes.
class MeasurementQueue : public std::enable_shared_from_this<MeasurementQueue> {
 public:
  /// @param origin of the data folder.
  /// @param most_waiting requests; one more is StorageBusy.
  /// @param each_apart every request is a job, and so a commit, of its own.
  MeasurementQueue(store::Database& database, std::string_view origin, std::size_t most_waiting,
                   bool each_apart)
      : database_(database),
        origin_(origin),
        most_waiting_(most_waiting),
        each_apart_(each_apart) {}

  struct Request {
    std::vector<Measurement> measurements;
    MeasurementService::Render render;
    MeasurementService::Done<Answer> done;
    Answer answer{};
  };

  /// As MeasurementService::record, of measurements that correct none.
  void record(Request request);

 private:
  /// What one job stores.
  using Load = std::vector<Request>;

  void submit(const std::shared_ptr<Load>& load);
  void close(const std::shared_ptr<Load>& load);
  void finish(Load& load, const Result<bool>& stored);

  store::Database& database_;
  const std::string_view origin_;
  const std::size_t most_waiting_;
  const bool each_apart_;
  LeafMaker leaves_;  ///< of the writer thread
  std::mutex mutex_;
  std::shared_ptr<Load> open_;  ///< of the job that has not begun; null when there is none
};

}  // namespace fitgauge::app
