#pragma once

namespace fitgauge {

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// An instant in UTC: nanoseconds since 1970-01-01T00:00:00Z without leap seconds (1678 to 2261).
struct Timestamp {
  std::int64_t nanoseconds = 0;

  friend auto operator<=>(const Timestamp&, const Timestamp&) = default;
};

/// Reads an RFC 3339 time with its offset; a leap second counts as the second after it.
/// @errors TimeMalformed, also for a non-zero digit beyond the nanosecond.
Result<Timestamp> parse_rfc3339(std::string_view text);

/// `2026-11-20T07:00:00Z`, with as many digits of the second as the value needs.
std::string format_rfc3339(Timestamp time);

inline constexpr std::size_t kRfc3339Room = 32;
/// Writes the text of format_rfc3339 to a buffer with enough room. @returns its end.
char* write_rfc3339(char* to, Timestamp time);

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

/// Source of the time. Implementations are thread-safe.
class Clock {
 public:
  Clock& operator=(Clock&&) = delete;  // neither copied nor moved
  virtual ~Clock() = default;

  virtual Timestamp now() const = 0;
};

/// The machine's clock, to the microsecond.
class SystemClock final : public Clock {
 public:
  Timestamp now() const override;
};

/// The machine's clock, and how far it can be relied on.
struct SteadyTime {
  Timestamp time{};
  /// The running time since the clock last jumped, or since the start. Sleep does not count.
  std::chrono::nanoseconds held = std::chrono::nanoseconds::max();
};

/// The time of another clock that never goes back: a later record has no earlier time. After the
/// other clock was set back, this clock continues from the last time that it gave, at half speed,
/// until the other clock has caught up. Compares the other clock with one that nobody sets and
/// reports each jump of a second or more. Thread-safe; the other clock outlives it.
class ForwardClock final : public Clock {
 public:
  /// The time since the machine's start, sleep included (CLOCK_BOOTTIME): nobody sets it.
  using Running = std::function<std::chrono::nanoseconds()>;
  /// Receives `clock_set_back` or `clock_set_ahead` and a sentence, on the thread that asked for
  /// the time.
  using Report = std::function<void(std::string_view event, const std::string& detail)>;

  ForwardClock(const Clock& other, Running running, Report report);

  Timestamp now() const override;

  /// The other clock's time, which deletions go by.
  SteadyTime steady() const;

  /// Acts as if `time` was the last time returned, for records of earlier starts.
  void begin_after(Timestamp time);

  static std::chrono::nanoseconds running_time();

 private:
  /// The other clock's time and the running time around its reading.
  struct Reading {
    std::chrono::nanoseconds before{};
    std::int64_t ns = 0;
    std::chrono::nanoseconds after{};
  };
  /// The other clock's time when it was set back, and the time that this clock had given.
  struct SetBack {
    std::int64_t to_ns = 0;
    std::int64_t given_ns = 0;
  };
  struct Jump {
    std::string_view event;
    std::string detail;
  };
  using Jumps = std::vector<Jump>;

  Reading read() const;
  SteadyTime look(Jumps& jumps) const;
  void compare(const Reading& reading, Jumps& jumps) const;
  void follow(std::int64_t other_ns, Jumps& jumps) const;
  void report(const Jumps& jumps) const;

  const Clock& other_;
  const Running running_;
  const Report report_;
  mutable std::mutex mutex_;
  mutable Reading last_;
  mutable std::chrono::nanoseconds held_{};  ///< running time since the last jump
  mutable std::int64_t seen_ns_ = 0;         ///< of the other clock
  mutable std::int64_t given_ns_ = 0;        ///< by this one
  mutable std::optional<SetBack> set_back_;
};

}  // namespace fitgauge
