#pragma once

#include "base/clock.hpp"

namespace fitgauge::sheet {

/// A time as a clock on a wall shows it.
struct WallTime {
  std::int64_t seconds = 0;  ///< since 1970-01-01 00:00:00 on that clock
  std::int64_t nanoseconds = 0;

  friend bool operator==(const WallTime&, const WallTime&) = default;
};

/// `2026-11-20 08:00:00`, `2026-11-20T08:00`, `20.11.2026 08:00:00.25`, `20.11.2026/08:00:00`: the
/// year in four digits, a fraction after a point or a comma, leading zeros optional. Nothing for
/// another text, such as one with an offset, or a day that does not exist.
std::optional<WallTime> parse_wall_time(std::string_view text);

/// A zone of the IANA database that this machine has (/usr/share/zoneinfo). Immutable.
class TimeZone {
 public:
  /// @param name as in Europe/Berlin. @errors ConfigInvalid: there is none, or its file is no TZif.
  static Result<TimeZone> load(std::string_view name);
  /// Reads the bytes of a file in the form of RFC 8536. @errors ConfigInvalid
  static Result<TimeZone> parse(std::string_view bytes);

  /// Returns the instant. An hour that occurs twice is the first one, before the clock goes back.
  /// @errors TimeMalformed: the clock has skipped it.
  Result<Timestamp> instant(const WallTime& time) const;
  /// Returns the local time at an instant, as if it were UTC.
  Timestamp shown(Timestamp time) const {
    const std::int64_t utc = time.nanoseconds / kNanosecondsPerSecond -
                             (time.nanoseconds % kNanosecondsPerSecond < 0 ? 1 : 0);
    return {time.nanoseconds + offset_at(utc) * kNanosecondsPerSecond};
  }

 private:
  /// A change of the clock by the rule of a footer: `M3.5.0/2`.
  struct RuleDay {
    int month = 0;
    int week = 0;
    int weekday = 0;
    std::int64_t seconds = 7200;
  };
  struct Rule {
    std::int64_t standard = 0;  ///< seconds east
    std::optional<std::int64_t> daylight{};
    RuleDay begins{};  ///< of daylight
    RuleDay ends{};
  };
  struct Change {
    std::int64_t at = 0;      ///< seconds since 1970 in UTC
    std::int64_t offset = 0;  ///< seconds east from then on
  };

  static std::optional<Rule> parse_rule(std::string_view text);
  static std::int64_t at_in_year(const RuleDay& day, std::int64_t year);
  std::int64_t offset_at(std::int64_t utc) const;

  std::int64_t first_offset_ = 0;
  std::vector<Change> changes_;
  std::optional<Rule> rule_;  ///< after the last change
};

/// Returns a wall time as an instant in UTC; other texts stay unchanged.
/// @param zone none: a wall time is refused. @errors TimeMalformed: `has the time '…' …`.
Result<std::string> instant_text(std::string_view text, const std::optional<TimeZone>& zone);

}  // namespace fitgauge::sheet
