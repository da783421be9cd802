#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>

#include "run/nc_error.hpp"
#include "run/run_limits.hpp"

namespace fitgauge::interpreter {

/// Blocks, wall-clock time, memory and cancellation of a run. The executor takes blocks in portions
/// and counts them down itself; time and cancellation are looked at with each portion, and with
/// each block that is more than arithmetic.
class RunBudget {
 public:
  RunBudget(const RunLimits& limits, std::stop_token stop);

  /// Takes back what is left of a portion and grants a new one of at least `needed` blocks.
  /// @errors limit (blocks, time), cancelled.
  NcResult<std::int64_t> refuel(std::int64_t left, std::int64_t needed);
  /// To be called for each block that is more than arithmetic. @errors limit (time), cancelled.
  NcResult<void> check();
  /// @errors limit.
  NcResult<void> use_memory(std::size_t bytes);

  /// @param left of the last portion.
  std::uint64_t executed(std::int64_t left) const {
    return granted_ - static_cast<std::uint64_t>(left);
  }

 private:
  static constexpr std::int64_t kPortion = 8192;

  const RunLimits limits_;
  const std::stop_token stop_;
  const std::chrono::steady_clock::time_point deadline_;
  std::uint64_t granted_ = 0;
  std::size_t memory_ = 0;
};

}  // namespace fitgauge::interpreter
