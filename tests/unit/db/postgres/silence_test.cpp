#include <doctest/doctest.h>
#include <signal.h>

#include "db/postgres/connection.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// The server's process of a connection stands still while this lives; the kernel still
/// acknowledges what it is sent.
class Stopped {
 public:
  explicit Stopped(const postgres::Connection& connection)
      : process_(PQbackendPID(connection.handle())) {
    REQUIRE(::kill(process_, SIGSTOP) == 0);
  }
  Stopped(const Stopped&) = delete;
  Stopped& operator=(const Stopped&) = delete;
  ~Stopped() { ::kill(process_, SIGCONT); }

 private:
  const pid_t process_;
};

constexpr std::array kSteps = {"BEGIN", "UPDATE head SET probes = probes + 1", "COMMIT"};

}  // namespace

TEST_CASE("a server that is silent is given up at each step of a transaction") {
  Fixture fixture;
  for (std::size_t step = 0; step < kSteps.size(); ++step) {
    CAPTURE(step);
    int asked = 0;
    bool is_stopped = false;
    postgres::Connection connection(fixture.options.address, [&](int /*seconds*/) {
      asked += is_stopped ? 1 : 0;
      return is_stopped;
    });
    for (std::size_t i = 0; i < step; ++i) {
      connection.send(kSteps.at(i));
      connection.wait();
    }
    const Stopped stopped(connection);
    is_stopped = true;
    connection.send(kSteps.at(step));
    CHECK_THROWS_AS(connection.wait(), StorageFailure);
    CHECK(asked == 1);
    connection.send("ROLLBACK");
    CHECK_THROWS_AS(connection.wait(), StorageFailure);
    CHECK(asked == 1);  // nobody waits for it again
  }
}
