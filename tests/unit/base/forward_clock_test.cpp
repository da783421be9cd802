#include "base/forward_clock.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <vector>

using namespace fitgauge;
using namespace std::chrono_literals;

namespace {

class ManualClock final : public Clock {
 public:
  Timestamp now() const override { return {now_ns}; }
  void advance(std::chrono::nanoseconds by) { now_ns += by.count(); }

  std::int64_t now_ns = 1'795'000'000'000'000'000;
};

struct Fixture {
  std::int64_t now() const { return clock.now().nanoseconds; }
  /// How far the clock is ahead of the machine's.
  std::chrono::nanoseconds ahead() const {
    return std::chrono::nanoseconds(now() - machine.now_ns);
  }

  ManualClock machine;
  std::vector<std::string> reports;
  ForwardClock clock{machine, [this](const std::string& what) { reports.push_back(what); }};
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
  machine.advance(-1h);
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
  machine.advance(-1h);
  now();
  machine.advance(30min);
  const std::int64_t before = now();
  machine.advance(-1h);
  CHECK(now() == before);
  CHECK(reports.size() == 2);
  machine.advance(3h + 30min);
  CHECK(ahead() == 0ns);
}

TEST_CASE_FIXTURE(Fixture,
                  "a clock that was wrong by more than a day is believed when it is set right") {
  machine.advance(24h * 365);
  now();
  machine.advance(-24h * 365);
  CHECK(ahead() == 0ns);
  REQUIRE(reports.size() == 1);
  CHECK(reports[0].find("taken as it is") != std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "less than a second is no news") {
  const std::int64_t before = now();
  machine.advance(-999ms);
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
