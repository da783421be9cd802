// When a busy I/O thread reads the next requests of the connections that it has answered.

#include <doctest/doctest.h>

#include <future>

#include "support/comes_true.hpp"
#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;
using namespace std::chrono_literals;

namespace {

/// A route whose handler holds its I/O thread until it is let go; what is sent meanwhile meets the
/// thread in one piece.
class Hold {
 public:
  Route route(std::string pattern) {
    return answering(std::move(pattern), [this](const Request&) -> Result<Response> {
      entered_.set_value();
      let_go_.get_future().wait();
      return plain("held");
    });
  }
  void wait_until_entered() { entered_.get_future().wait(); }
  void let_go() { let_go_.set_value(); }

 private:
  std::promise<void> entered_;
  std::promise<void> let_go_;
};

/// Two that hold one turn of a server: in `first` the requests of the turn come together; `second`
/// is answered behind them, so that their clients can act before the turn is over.
struct Turn {
  Hold first;
  Hold second;
  TestServer server;
  Client holder;
  Client other;

  explicit Turn(ServerOptions options = {})
      : server({first.route("/first"), second.route("/second"), echo(Method::Get, "/a")},
               std::move(options)),
        holder(server.connect()),
        other(server.connect()) {}

  /// Calls `send`, and returns when what it has sent is answered and the turn is not over.
  template <class Function>
  void begin(Function send) {
    REQUIRE(other.ask(get("/a")).status == 200);
    holder.send(get("/first"));
    first.wait_until_entered();
    send();
    other.send(get("/second"));
    first.let_go();
    second.wait_until_entered();
  }
  void end() {
    second.let_go();
    CHECK(holder.read().body == "held");
    CHECK(other.read().body == "held");
  }
};

}  // namespace

TEST_CASE("requests that come before the turn is over are answered, and those that come after") {
  Turn turn;
  std::vector<Client> clients = turn.server.connect(8);
  for (Client& client : clients) REQUIRE(client.ask(get("/a")).status == 200);
  turn.begin([&] {
    for (const Client& client : clients) client.send(get("/a"));
  });
  for (std::size_t i = 0; i < clients.size(); ++i) {
    CHECK(clients[i].read().status == 200);
    // One sends a whole request, one a part of it, one several, one nothing.
    if (i % 4 == 0) clients[i].send(get("/a"));
    if (i % 4 == 1) clients[i].send(get("/a").substr(0, 9));
    if (i % 4 == 2) clients[i].send(get("/a") + get("/a") + get("/a"));
  }
  turn.end();
  for (std::size_t i = 0; i < clients.size(); ++i) {
    if (i % 4 == 1) clients[i].send(get("/a").substr(9));
    if (i % 4 == 3) clients[i].send(get("/a"));
    for (std::size_t answers = i % 4 == 2 ? 3 : 1; answers > 0; --answers) {
      CHECK(clients[i].read().status == 200);
    }
    CHECK(clients[i].ask(get("/a")).status == 200);
  }
}

TEST_CASE("a client that leaves before the turn is over is seen to have left") {
  Turn turn;
  std::vector<Client> clients = turn.server.connect(2);
  turn.begin([&] {
    for (const Client& client : clients) client.send(get("/a"));
  });
  for (Client& client : clients) CHECK(client.read().status == 200);
  clients.front().shut_down_send();
  clients.pop_back();
  turn.end();
  CHECK(clients.front().is_closed_by_server());
  CHECK(comes_true([&] { return turn.server.server().counters().connections_open == 2; }));
}

TEST_CASE("stop closes a connection that waits for its turn") {
  Turn turn;
  Client waiting = turn.server.connect();
  REQUIRE(waiting.ask(get("/a")).status == 200);
  turn.begin([&] { waiting.send(get("/a")); });
  CHECK(waiting.read().status == 200);
  std::thread stop([&] { turn.server.server().stop(); });
  turn.end();
  CHECK(waiting.is_closed_by_server());
  stop.join();
  CHECK(turn.server.server().counters().connections_open == 0);
}

TEST_CASE("the idle time of a connection begins when it waits for its turn") {
  Turn turn({.header_timeout = 100ms, .request_timeout = 100ms, .idle_timeout = 3s});
  Client waiting = turn.server.connect();
  turn.begin([&] { waiting.send(get("/a")); });
  CHECK(waiting.read().status == 200);
  std::this_thread::sleep_for(200ms);  // the deadlines of its request have passed
  turn.end();
  CHECK(waiting.ask(get("/a")).status == 200);
  CHECK(waiting.is_closed_by_server());
}

TEST_CASE("who sends without end does not keep the others waiting") {
  constexpr int kFlood = 2'000;
  Hold hold;
  std::atomic<int> flooded = 0;
  std::atomic<int> flooded_before = -1;
  const auto counts = [&](const Request&) -> Result<Response> {
    ++flooded;
    return plain("one of many");
  };
  const auto looks = [&](const Request&) -> Result<Response> {
    flooded_before = flooded.load();
    return plain("one");
  };
  TestServer server({hold.route("/hold"), answering("/flood", counts), answering("/one", looks)});
  Client holder = server.connect();
  Client flood = server.connect();
  Client one = server.connect();
  for (Client* each : {&flood, &one}) REQUIRE(each->ask(get("/one")).status == 200);
  holder.send(get("/hold"));
  hold.wait_until_entered();
  std::string many;
  for (int i = 0; i < kFlood; ++i) many += get("/flood");
  std::thread sender([&] { flood.send(many); });
  one.send(get("/one"));
  hold.let_go();
  CHECK(one.read().body == "one");
  for (int i = 0; i < kFlood; ++i) REQUIRE(flood.read().status == 200);
  sender.join();
  CHECK(flooded_before < kFlood / 2);
}
