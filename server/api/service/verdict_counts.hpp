#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "api/service/exposition.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// Counts what was recorded since the start by source and verdict, for metrics: reads the rows that
/// are new when somebody asks, so that recording costs nothing more. Thread-safe.
class VerdictCounts : public std::enable_shared_from_this<VerdictCounts> {
 public:
  explicit VerdictCounts(app::MeasurementService& measurements) : measurements_(measurements) {}

  /// Reads what is new, the first time only where the log ends, and calls `done`, on a storage
  /// thread or at once; also when the storage cannot be read. One that comes while another reads
  /// does not wait.
  void refresh(std::function<void()> done);

  void write(Exposition& out) const;

 private:
  static constexpr std::size_t kSources = 2;
  using Counts = std::array<std::array<std::uint64_t, gauging::kVerdicts>, kSources>;

  void take(const Result<app::ListPage>& page, const Counts& counts, std::int64_t last);

  app::MeasurementService& measurements_;
  mutable std::mutex mutex_;
  bool reading_ = false;
  std::optional<std::int64_t> position_;  ///< the last id that was counted
  Counts counts_{};
};

}  // namespace fitgauge::api
