#include "base/clock.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace std::chrono_literals;

namespace {
class ManualClock final : public Clock {
 public:
  Timestamp now() const override { return {now_ns}; }
  /// Sets the clock: no time passes.
  void set_by(std::chrono::nanoseconds by) { now_ns += by.count(); }
  void advance(std::chrono::nanoseconds by) {
    set_by(by);
    running += by;
  }

  std::chrono::nanoseconds running{};
  std::int64_t now_ns = 1'795'000'000'000'000'000;
};

struct Fixture {
  std::int64_t now() const { return clock.now().nanoseconds; }
  /// How far the clock is ahead of the machine's.
  std::chrono::nanoseconds ahead() const {
    return std::chrono::nanoseconds(now() - machine.now_ns);
  }

  /// Advances second by second, looking each time, as the service does.
  void run_for(std::chrono::seconds time) {
    for (; time > 0s; time -= 1s) {
      machine.advance(1s);
      now();
    }
  }

  ManualClock machine;
  std::vector<std::string> reports;
  ForwardClock clock{machine, [this] { return machine.running; },
                     [this](std::string_view event, const std::string& detail) {
                       reports.push_back(std::string(event) + ": " + detail);
                     }};
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a clock that goes on is followed to the nanosecond") {
  for (const auto step : {0ns, 1ns, 3'600'000'000'000ns, 1ns}) {
    machine.advance(step);
    CHECK(ahead() == 0ns);
  }
  CHECK(reports.empty());
}

TEST_CASE_FIXTURE(Fixture,
                  "set back an hour, the time goes on at half speed until it is caught up") {
  const std::int64_t before = now();
  machine.set_by(-1h);
  CHECK(now() == before);
  REQUIRE(reports.size() == 1);
  CHECK(reports[0].find("3600 s before") != std::string::npos);
  CHECK(reports[0].find(format_rfc3339(machine.now())) != std::string::npos);

  std::int64_t last = before;
  for (int minute = 1; minute < 120; ++minute) {
    machine.advance(1min);
    CHECK(now() > last);
    CHECK(ahead() == 1h - minute * 30s);
    last = now();
  }
  machine.advance(1min);
  CHECK(ahead() == 0ns);
  machine.advance(1min);
  CHECK(ahead() == 0ns);
  CHECK(reports.size() == 1);
}

TEST_CASE_FIXTURE(Fixture, "set back again while it catches up, the time still goes on") {
  now();
  machine.set_by(-1h);
  now();
  machine.advance(30min);
  const std::int64_t before = now();
  machine.set_by(-1h);
  CHECK(now() == before);
  CHECK(reports.size() == 2);
  machine.advance(3h + 30min);
  CHECK(ahead() == 0ns);
}

TEST_CASE_FIXTURE(Fixture,
                  "a clock that was a year ahead for a second never makes the time go back") {
  now();
  machine.set_by(24h * 365);
  const std::int64_t wrong = now();
  REQUIRE(reports.size() == 1);
  CHECK(reports[0].find(
            "clock_set_ahead: the clock of the machine jumped ahead by 31536000 s, to ") == 0);
  machine.set_by(-24h * 365);
  CHECK(now() == wrong);
  machine.advance(1min);
  CHECK(now() == wrong + std::chrono::nanoseconds(30s).count());
  REQUIRE(reports.size() == 2);
  CHECK(reports[1].find("clock_set_back: ") == 0);
  CHECK(clock.steady().time == machine.now());
}

TEST_CASE_FIXTURE(Fixture, "the time that the clock has held counts from its last jump") {
  run_for(60s);
  CHECK(clock.steady().held == 60s);
  machine.set_by(24h * 400);
  now();
  CHECK(clock.steady().held == 0s);
  run_for(2s);
  machine.set_by(-24h * 400);
  CHECK(clock.steady().held == 0s);
  run_for(3s);
  CHECK(clock.steady().held == 3s);
}

TEST_CASE_FIXTURE(Fixture, "a machine that slept has not run, and its clock has not jumped") {
  run_for(60s);
  machine.advance(8h);
  CHECK(clock.steady().held < 66s);
  CHECK(reports.empty());
}

TEST_CASE_FIXTURE(Fixture, "less than a second is no news") {
  const std::int64_t before = now();
  machine.set_by(-999ms);
  CHECK(now() == before);
  CHECK(reports.empty());
}

TEST_CASE_FIXTURE(Fixture, "it begins after what was recorded before the start") {
  clock.begin_after({machine.now_ns + std::chrono::nanoseconds(1h).count()});
  CHECK(ahead() == 1h);
  CHECK(reports.size() == 1);
}

TEST_CASE_FIXTURE(Fixture, "what was recorded long before the start changes nothing") {
  clock.begin_after({0});
  CHECK(ahead() == 0ns);
  CHECK(reports.empty());
}

namespace {
std::string normalised(std::string_view text) {
  return format_rfc3339(parse_rfc3339(text).value());
}
}  // namespace

TEST_CASE("times are normalised to UTC") {
  CHECK(normalised("2026-11-20T08:00:00+01:00") == "2026-11-20T07:00:00Z");
  CHECK(normalised("2026-11-20t23:30:00.250-02:30") == "2026-11-21T02:00:00.25Z");
  CHECK(normalised("2024-02-29T00:00:00Z") == "2024-02-29T00:00:00Z");
  CHECK(normalised("1969-12-31T23:59:59.5Z") == "1969-12-31T23:59:59.5Z");
  CHECK(normalised("2026-01-01T00:00:00.123456789Z") == "2026-01-01T00:00:00.123456789Z");
  CHECK(normalised("2016-12-31T23:59:60Z") == "2017-01-01T00:00:00Z");
  CHECK(normalised("2017-01-01T00:59:60+01:00") == "2017-01-01T00:00:00Z");
}

TEST_CASE("what is not an RFC 3339 time is refused") {
  for (const char* text :
       {"", "2026-11-20", "2026-11-20T08:00:00", "2026-13-01T00:00:00Z", "2026-02-29T00:00:00Z",
        "2026-11-20T24:00:00Z", "2026-11-20T08:60:00Z", "2026-11-20T08:00:60Z",
        "2026-11-20T08:00:00.Z", "2026-11-20T08:00:00.1234567891Z", "2026-11-20T08:00:00+24:00",
        "1500-01-01T00:00:00Z", "2026-11-20T08:00:00Z ", "20261120T080000Z"}) {
    CHECK_MESSAGE(parse_rfc3339(text).has_error(), text);
  }
  using namespace std::string_view_literals;
  CHECK(parse_rfc3339("2026-11-20T08:00:00+99:00\0"sv).has_error());
}

TEST_CASE("civil time knows the weekday") {
  const CivilTime civil = civil_time(parse_rfc3339("2026-11-20T08:00:00.5Z").value());
  CHECK(civil.weekday == 5);
  CHECK(civil.nanosecond == 500'000'000);
}
