#include "base/clock.hpp"

#include <time.h>

namespace fitgauge {
namespace {

/// Walks over a fixed-form text; once a part did not match, `ok` stays false.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  int digits(int count) {
    int value = 0;
    for (int i = 0; i < count; ++i) {
      if (!at_digit()) return fail();
      value = value * 10 + (take() - '0');
    }
    return value;
  }

  void literal(char expected) {
    if (text_.empty() || text_.front() != expected) {
      fail();
    } else {
      take();
    }
  }

  char one_of(std::string_view choices) {
    if (text_.empty() || choices.find(text_.front()) == std::string_view::npos) {
      fail();
      return '\0';
    }
    return take();
  }

  /// The fraction of a second after its point, in nanoseconds.
  std::int64_t fraction() {
    if (!at_digit()) return fail();
    std::int64_t value = 0;
    std::int64_t unit = kNanosecondsPerSecond / 10;
    while (at_digit()) {
      const int digit = take() - '0';
      if (unit == 0 && digit != 0) return fail();
      value += unit * digit;
      unit /= 10;
    }
    return value;
  }

  int fail() {
    ok_ = false;
    return 0;
  }

  bool at(char c) const { return !text_.empty() && text_.front() == c; }
  bool done() const { return ok_ && text_.empty(); }

 private:
  bool at_digit() const { return !text_.empty() && text_.front() >= '0' && text_.front() <= '9'; }
  char take() {
    const char c = text_.front();
    text_.remove_prefix(1);
    return c;
  }
  std::string_view text_;
  bool ok_ = true;
};

std::chrono::sys_days date_of(int year, int month, int day, bool& valid) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  valid = date.ok() && year >= 1678 && year <= 2261;
  return valid ? std::chrono::sys_days(date) : std::chrono::sys_days();
}

/// `count` digits with zeros before them.
char* write_digits(char* to, int value, int count) {
  for (char* at = to + count; at != to; value /= 10) *--at = static_cast<char>('0' + value % 10);
  return to + count;
}

using std::chrono::nanoseconds;

constexpr nanoseconds kLeastJump = std::chrono::seconds(1);
/// Between two looks the machine may have slept: no more of that time counts as running.
constexpr nanoseconds kLongestRun = std::chrono::seconds(5);

}  // namespace

Result<Timestamp> parse_rfc3339(std::string_view text) {
  Reader reader(text);
  const int year = reader.digits(4);
  reader.literal('-');
  const int month = reader.digits(2);
  reader.literal('-');
  const int day = reader.digits(2);
  reader.one_of("Tt ");
  const int hour = reader.digits(2);
  reader.literal(':');
  const int minute = reader.digits(2);
  reader.literal(':');
  const int second = reader.digits(2);
  std::int64_t fraction = 0;
  if (reader.at('.')) {
    reader.literal('.');
    fraction = reader.fraction();
  }
  std::int64_t offset_minutes = 0;
  const char zone = reader.one_of("Zz+-");
  if (zone == '+' || zone == '-') {
    const int offset_hour = reader.digits(2);
    reader.literal(':');
    const int offset_minute = reader.digits(2);
    if (offset_hour > 23 || offset_minute > 59) reader.fail();
    offset_minutes = std::int64_t{zone == '-' ? -1 : 1} * (offset_hour * 60 + offset_minute);
  }

  bool valid_date = false;
  const auto days = date_of(year, month, day, valid_date);
  const bool leap_second = second == 60;
  const std::int64_t minute_of_day = hour * 60 + minute - offset_minutes;
  const bool ends_utc_day = (minute_of_day % 1440 + 1440) % 1440 == 1439;
  if (!reader.done() || !valid_date || hour > 23 || minute > 59 || second > 60 ||
      (leap_second && !ends_utc_day)) {
    return Error{ErrorCode::TimeMalformed,
                 "'" + std::string(text.substr(0, 40)) +
                     "' is not an RFC 3339 time such as 2026-11-20T08:00:00+01:00, with at most 9 "
                     "digits of the second, between 1678 and 2261"};
  }
  const std::int64_t seconds =
      days.time_since_epoch().count() * std::int64_t{86'400} + minute_of_day * 60 + second;
  return Timestamp{seconds * kNanosecondsPerSecond + fraction};
}

CivilTime civil_time(Timestamp time) {
  using namespace std::chrono;
  const sys_time<nanoseconds> instant{nanoseconds(time.nanoseconds)};
  const sys_days day = floor<days>(instant);
  const year_month_day date(day);
  const hh_mm_ss clock(instant - day);
  return {.year = static_cast<int>(date.year()),
          .month = static_cast<int>(static_cast<unsigned>(date.month())),
          .day = static_cast<int>(static_cast<unsigned>(date.day())),
          .hour = static_cast<int>(clock.hours().count()),
          .minute = static_cast<int>(clock.minutes().count()),
          .second = static_cast<int>(clock.seconds().count()),
          .nanosecond = static_cast<int>(clock.subseconds().count()),
          .weekday = static_cast<int>(weekday(day).c_encoding())};
}

char* write_rfc3339(char* to, Timestamp time) {
  const CivilTime civil = civil_time(time);
  to = write_digits(to, civil.year, 4);
  for (const auto& [mark, value] :
       {std::pair('-', civil.month), std::pair('-', civil.day), std::pair('T', civil.hour),
        std::pair(':', civil.minute), std::pair(':', civil.second)}) {
    *to++ = mark;
    to = write_digits(to, value, 2);
  }
  if (civil.nanosecond != 0) {
    *to++ = '.';
    to = write_digits(to, civil.nanosecond, 9);
    while (to[-1] == '0') --to;
  }
  *to++ = 'Z';
  return to;
}

std::string format_rfc3339(Timestamp time) {
  char text[kRfc3339Room];
  return {text, write_rfc3339(text, time)};
}

Timestamp SystemClock::now() const {
  using namespace std::chrono;
  const auto now = time_point_cast<microseconds>(system_clock::now());
  return {duration_cast<nanoseconds>(now.time_since_epoch()).count()};
}

ForwardClock::ForwardClock(const Clock& other, Running running, Report report)
    : other_(other), running_(std::move(running)), report_(std::move(report)), last_(read()) {}

Timestamp ForwardClock::now() const {
  Jumps jumps;
  Timestamp time;
  {
    const std::lock_guard lock(mutex_);
    look(jumps);
    time.nanoseconds = given_ns_;
  }
  report(jumps);
  return time;
}

SteadyTime ForwardClock::steady() const {
  Jumps jumps;
  SteadyTime time;
  {
    const std::lock_guard lock(mutex_);
    time = look(jumps);
  }
  report(jumps);
  return time;
}

void ForwardClock::begin_after(Timestamp time) {
  const std::lock_guard lock(mutex_);
  seen_ns_ = given_ns_ = time.nanoseconds;
}

nanoseconds ForwardClock::running_time() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

ForwardClock::Reading ForwardClock::read() const {
  Reading reading;
  reading.before = running_();
  reading.ns = other_.now().nanoseconds;
  reading.after = running_();
  return reading;
}

SteadyTime ForwardClock::look(Jumps& jumps) const {
  const Reading reading = read();
  compare(reading, jumps);
  follow(reading.ns, jumps);
  return {.time = {reading.ns}, .held = held_};
}

/// A thread that was paused between two clock readings sees no jump: use the longest possible
/// running time against a clock ahead, the shortest against a clock that was set back.
void ForwardClock::compare(const Reading& reading, Jumps& jumps) const {
  const nanoseconds passed(reading.ns - last_.ns);
  const nanoseconds longest = reading.after - last_.before;
  const nanoseconds shortest = reading.before - last_.after;
  held_ += std::clamp(shortest, nanoseconds(0), kLongestRun);
  last_ = reading;
  const bool ahead = passed - longest >= kLeastJump;
  if (ahead || shortest - passed >= kLeastJump) held_ = nanoseconds(0);
  if (!ahead) return;
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(passed - longest).count();
  jumps.push_back(
      {"clock_set_ahead", fmt::format("the clock of the machine jumped ahead by {} s, to {}: "
                                      "nothing expires until the clock is steady for a day",
                                      seconds, format_rfc3339({reading.ns}))});
}

/// Sets given_ns_.
void ForwardClock::follow(std::int64_t other_ns, Jumps& jumps) const {
  if (other_ns < std::exchange(seen_ns_, other_ns)) {
    set_back_ = SetBack{other_ns, given_ns_};
    const nanoseconds behind(given_ns_ - other_ns);
    if (behind >= kLeastJump) {
      jumps.push_back(
          {"clock_set_back",
           fmt::format("the clock of the machine shows {}, {} s before a stored time: times run at "
                       "half speed until the clock reaches them",
                       format_rfc3339({other_ns}),
                       std::chrono::duration_cast<std::chrono::seconds>(behind).count())});
    }
  }
  if (set_back_) {
    given_ns_ = set_back_->given_ns + (other_ns - set_back_->to_ns) / 2;
    if (other_ns >= given_ns_) set_back_.reset();
  }
  if (!set_back_) given_ns_ = other_ns;
}

void ForwardClock::report(const Jumps& jumps) const {
  for (const auto& [event, detail] : jumps) report_(event, detail);
}

}  // namespace fitgauge
