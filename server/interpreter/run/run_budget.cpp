#include "run/run_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace fitgauge::interpreter {

RunBudget::RunBudget(const RunLimits& limits, std::stop_token stop)
    : limits_(limits),
      stop_(std::move(stop)),
      deadline_(std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(limits.time)) {}

NcResult<std::int64_t> RunBudget::refuel(std::int64_t left, std::int64_t needed) {
  granted_ -= static_cast<std::uint64_t>(left);
  if (auto checked = check(); !checked) return checked.error();
  const auto remaining = static_cast<std::int64_t>(limits_.blocks - granted_);
  if (needed > remaining) {
    return limit_error(fmt::format("the run has executed its limit of {} blocks", limits_.blocks));
  }
  const std::int64_t portion = std::min(remaining, std::max(needed, kPortion));
  granted_ += static_cast<std::uint64_t>(portion);
  return portion;
}

NcResult<void> RunBudget::check() {
  if (stop_.stop_requested()) {
    return NcError{NcErrorKind::Cancelled, 0, "the run was cancelled"};
  }
  if (std::chrono::steady_clock::now() > deadline_) {
    return limit_error(
        fmt::format("the run has taken its limit of {} seconds", limits_.time.count()));
  }
  return {};
}

NcResult<void> RunBudget::use_memory(std::size_t bytes) {
  memory_ += bytes;
  if (memory_ > limits_.memory_bytes) {
    return limit_error(
        fmt::format("the run has loaded more than {} bytes of files", limits_.memory_bytes));
  }
  return {};
}

}  // namespace fitgauge::interpreter
