#include <doctest/doctest.h>

#include "db/postgres/connection.hpp"
#include "db/postgres/session.hpp"
#include "fixture.hpp"
#include "support/comes_true.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// The sessions that have notified, of each as often as it did.
std::multiset<int> heard(const postgres::Connection& connection) {
  std::multiset<int> sessions;
  REQUIRE(PQconsumeInput(connection.handle()) == 1);
  while (PGnotify* const notify = PQnotifies(connection.handle())) {
    sessions.insert(notify->be_pid);
    PQfreemem(notify);
  }
  return sessions;
}

void listen(postgres::Connection& connection) {
  connection.send("LISTEN fitgauge");
  connection.wait();
}

}  // namespace

TEST_CASE("one notification is for all commits within 20 ms") {
  using postgres::Notifications;
  constexpr int kCommits = 200;
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  postgres::Connection other(fixture.options.address);
  listen(other);
  const auto begun = Notifications::Clock::now();
  for (int i = 0; i < kCommits; ++i) REQUIRE(fixture.append(sample_row()).has_value());
  std::size_t notified = 0;
  CHECK(comes_true([&] { return (notified += heard(other).size()) > 0; }));
  const auto times = (Notifications::Clock::now() - begun) / Notifications::kInterval;
  CHECK(notified <= 3 + 2 * static_cast<std::size_t>(times));
}

TEST_CASE("a commit that was not notified is a little later") {
  constexpr int kTries = 100;
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  postgres::Connection other(fixture.options.address);
  listen(other);
  std::set<int> sessions;
  for (int i = 0; i < kTries && sessions.size() < 2; ++i) {
    for (int row = 0; row < 2; ++row) REQUIRE(fixture.append(sample_row()).has_value());
    std::this_thread::sleep_for(3 * postgres::Notifications::kInterval);
    const auto notified = heard(other);
    sessions.insert(notified.begin(), notified.end());
  }
  CHECK(sessions.size() == 2);  // the writer's, and the listener's
}
