#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "base/steady_time.hpp"

namespace fitgauge::store {

struct Stores;

/// The time that runs and idempotency keys expire by, and a count of the deletions. A clock may be
/// wrong (a dead battery, the first answer of NTP) and a deletion is for good: the time is never
/// later than the newest record's `received_at`, and it moves only after the clock has held for a
/// day of running time. Until then it is that of the start, or of the last look before a jump.
/// Used by one thread.
class Retention {
 public:
  /// @returns none while nothing may expire: without a record, until the clock has held.
  /// @throws StorageFailure
  std::optional<Timestamp> time(const SteadyTime& clock, const Stores& stores);

  void deleted(std::int64_t keys, std::int64_t runs);
  /// @param now of a clock that nobody sets. @param more whether the next step may delete more.
  /// @returns a sentence on the deletions: the first at once, those that follow once an hour.
  std::optional<std::string> report(std::chrono::nanoseconds now, bool more);

 private:
  bool has_begun_ = false;
  std::optional<Timestamp> time_;
  std::int64_t keys_ = 0;
  std::int64_t runs_ = 0;
  std::optional<std::chrono::nanoseconds> reported_;
};

}  // namespace fitgauge::store
