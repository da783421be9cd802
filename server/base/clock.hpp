#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge {

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// An instant in UTC, in nanoseconds since 1970-01-01T00:00:00Z without leap seconds (1678 to
/// 2261).
struct Timestamp {
  std::int64_t nanoseconds = 0;

  friend auto operator<=>(const Timestamp&, const Timestamp&) = default;
};

/// Reads an RFC 3339 time with its offset; a leap second counts as the second after it.
/// @errors TimeMalformed, also for a non-zero digit beyond the nanosecond.
Result<Timestamp> parse_rfc3339(std::string_view text);

/// `2026-11-20T07:00:00Z`, with as many digits of the second as the value needs.
std::string format_rfc3339(Timestamp time);

/// The calendar date and time of day in UTC.
struct CivilTime {
  int year = 1970;
  int month = 1;  ///< 1 to 12
  int day = 1;
  int hour = 0;
  int minute = 0;
  int second = 0;
  int nanosecond = 0;
  int weekday = 4;  ///< 0 is Sunday
};

CivilTime civil_time(Timestamp time);

/// Where the time comes from. Implementations are thread-safe.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  virtual Timestamp now() const = 0;
};

/// The machine's clock, to the microsecond.
class SystemClock final : public Clock {
 public:
  Timestamp now() const override;
};

}  // namespace fitgauge
