#include "db/sql/session.hpp"

#include <doctest/doctest.h>

#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;
using namespace std::chrono_literals;

namespace {

/// The service with a clock that can be set, from its start on.
struct Retained : Fixture {
  /// The writer of the service stores its state once, before the test begins.
  Retained() {
    reopen([&](OpenOptions& changed) {
      changed.steady_time = [begin = clock.now()] { return SteadyTime{.time = begin, .held = 0s}; };
    });
    const auto is_kept = [this] {
      return see([](const Stores& stores) {
        return stores.log.mark(LogStore::Mark::Retention).has_value();
      });
    };
    while (!is_kept()) std::this_thread::yield();
    change([](Stores& stores) { stores.log.set_mark(LogStore::Mark::Retention, "0 0 0 0"); });
  }
  /// The time that things expire by.
  std::optional<Timestamp> look() {
    return *write([this](Stores& stores) -> Result<std::optional<Timestamp>> {
      const auto time = retention.time({.time = clock.now(), .held = held}, stores);
      retention.keep(stores);
      return time;
    });
  }
  void start_again() {
    retention = {};
    held = 0s;
    look();
  }
  Timestamp record() {
    REQUIRE(append(clock.row()).has_value());
    return clock.now();
  }
  void pass(std::chrono::nanoseconds time) {
    clock.advance(time);
    held += time;
  }
  void set_clock(std::chrono::nanoseconds by) {
    clock.advance(by);
    held = 0s;
  }

  Retention retention;
  std::chrono::nanoseconds held{};
};

}  // namespace

TEST_CASE_FIXTURE(Retained, "nothing expires by a time later than the newest record's") {
  const Timestamp first = record();
  pass(48h);
  CHECK(look() == first);
  const Timestamp second = record();
  CHECK(look() == second);
  pass(1000 * 24h);
  CHECK(look() == second);
}

TEST_CASE_FIXTURE(Retained, "in the first day of a start nothing more expires") {
  pass(48h);
  const Timestamp before = record();
  CHECK(look() == before);
  clock.advance(400 * 24h);  // wrong while the service is off, and with a record of that time
  for (int starts = 0; starts < 2; ++starts) {
    start_again();
    record();
    CHECK(look() == before);
    pass(11h);
    CHECK(look() == before);
  }
  clock.advance(-400 * 24h);  // corrected while it is off: the day begins again
  start_again();
  pass(24h - 1ns);
  CHECK(look() == before);
}

TEST_CASE_FIXTURE(Retained, "a steady day may have several starts") {
  const Timestamp begin = record();
  for (int starts = 0; starts < 2; ++starts) {
    start_again();
    pass(8h);
    record();
    CHECK_FALSE(look().has_value());
  }
  start_again();
  pass(8h - 1ns);
  CHECK_FALSE(look().has_value());
  pass(1ns);
  CHECK(look() == begin);
  clock.advance(400 * 24h);
  start_again();
  record();
  pass(23h);
  CHECK(look() == begin);
}

TEST_CASE_FIXTURE(Retained,
                  "after a jump nothing more expires until the clock has held for a day") {
  pass(48h);
  const Timestamp before = record();
  CHECK(look() == before);
  set_clock(400 * 24h);
  const Timestamp wrong = record();
  CHECK(look() == before);
  pass(1s);
  set_clock(-400 * 24h);
  CHECK(look() == before);
  pass(25h);
  CHECK(look() == clock.now());  // the newest record is of a time that has not come
  CHECK(clock.now() < wrong);
}

TEST_CASE_FIXTURE(Retained, "without a record nothing expires until the clock has held for a day") {
  CHECK_FALSE(look().has_value());
  pass(24h);
  CHECK(look() == clock.now());
}

TEST_CASE("deletions are reported at their end, and then once an hour") {
  Retention retention;
  CHECK_FALSE(retention.report(0s, false).has_value());
  retention.deleted(200, 0);
  CHECK_FALSE(retention.report(0s, true).has_value());
  retention.deleted(3, 2);
  CHECK(retention.report(1s, false)->find("deleted 203 idempotency keys and 2 finished runs") == 0);
  retention.deleted(1, 0);
  CHECK_FALSE(retention.report(3600s, false).has_value());
  CHECK(retention.report(3601s, false)->find("deleted 1 idempotency keys") == 0);
}
