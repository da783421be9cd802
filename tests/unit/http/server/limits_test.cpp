// Time, memory and connections: what a slow, greedy or numerous client can take.

#include <doctest/doctest.h>

#include <latch>

#include "support/comes_true.hpp"
#include "test_server.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t kBodyLimit = 1'000'000;
constexpr std::size_t kWholeLimit = 4'000'000;

std::vector<Route> limited_routes() {
  return {echo(Method::Get, "/a"),
          echo(Method::Post, "/p", {.use = BodyUse::Optional, .limit = kBodyLimit}),
          echo(Method::Post, "/whole", {.use = BodyUse::Optional, .limit = kWholeLimit}),
          answering("/large", [](const Request&) -> Result<Response> {
            // More than sockets take. NOLINTNEXTLINE(bugprone-string-constructor)
            return Response(200, "text/plain", std::string(20'000'000, 'x'));
          })};
}

ServerOptions quick() {
  // Longer than a busy machine lets a client stand still that is to be served.
  return {
      .header_timeout = 1s, .request_timeout = 2s, .idle_timeout = 1500ms, .write_timeout = 1500ms};
}

std::string post_head(std::size_t length) {
  return fmt::format("POST /p HTTP/1.1\r\nHost: h\r\nContent-Length: {}\r\n\r\n", length);
}

}  // namespace

TEST_CASE("an idle connection is closed without a word") {
  TestServer server(limited_routes(), quick());
  Client fresh = server.connect();
  Client used = server.connect();
  CHECK(used.ask(get("/a")).status == 200);
  CHECK(fresh.is_closed_by_server());
  CHECK(used.is_closed_by_server());
}

TEST_CASE("a head that does not end is 408, also when it drips") {
  TestServer server(limited_routes(), quick());
  Client silent = server.connect();
  silent.send("GET /a HTT");
  Client dripping = server.connect();
  const std::string request = get("/a", std::string("X: ") + std::string(200, 'y') + "\r\n");
  std::size_t sent = 0;
  while (sent < request.size() && dripping.send(request.substr(sent, 1))) {
    ++sent;
    std::this_thread::sleep_for(20ms);
  }
  CHECK(sent < request.size());
  for (Client* const client : {&silent, &dripping}) {
    const auto answer = client->read();
    CHECK(answer.status == 408);
    CHECK(answer.body.starts_with("request.timeout"));
    CHECK(client->is_closed_by_server());
  }
}

TEST_CASE(
    "the deadline of a request holds for the whole of it: dripping a body does not renew it") {
  TestServer server(limited_routes(), quick());
  for (const bool chunked : {false, true}) {
    Client client = server.connect();
    client.send(chunked ? kChunkedPost : post_head(50'000));
    int sent = 0;
    while (sent < 200 && client.send(chunked ? "1\r\nx\r\n" : "x")) {
      ++sent;
      std::this_thread::sleep_for(20ms);
    }
    CHECK(sent < 200);
    const auto answer = client.read();
    CHECK(answer.status == 408);
  }
}

TEST_CASE("a reader that takes nothing is dropped") {
  TestServer server(limited_routes(), quick());
  Client client = server.connect();
  client.send(get("/large"));
  const auto is_dropped = [&] {
    const ServerCounters counters = server.server().counters();
    return counters.requests == 1 && counters.connections_open == 0;
  };
  CHECK(comes_true(is_dropped));
  CHECK(client.read_to_end().size() < 20'000'000);
}

TEST_CASE("connections beyond the cap are answered 503 and closed") {
  ServerHooks hooks;
  hooks.format_error = [](const Error& error, std::optional<int> status, const Request& request) {
    return Response(*status, "application/problem+json",
                    error.message + std::string(request.id_text()))
        .with("Retry-After", "1");
  };
  TestServer server(limited_routes(), {.max_connections = 2}, hooks);
  Client first = server.connect();
  Client second = server.connect();
  CHECK(first.ask(get("/a")).status == 200);
  CHECK(second.ask(get("/a")).status == 200);
  Client third = server.connect();
  const auto answer = third.read();
  CHECK(answer.status == 503);
  CHECK(answer.field("Retry-After") == "1");
  CHECK(answer.field("Connection") == "close");
  CHECK(answer.field("Content-Type") == "application/problem+json");
  CHECK(answer.body.starts_with("too many connections are open"));
  CHECK(third.is_closed_by_server());
  CHECK(server.server().counters().connections_refused == 1);
  CHECK(first.ask(get("/a")).status == 200);
}

TEST_CASE("a connection counts from its acceptance on, however late its I/O thread comes to it") {
  std::latch is_held(1);
  std::latch goes_on(1);
  std::vector<Route> routes = limited_routes();
  routes.push_back(answering("/hold", [&](const Request&) -> Result<Response> {
    is_held.count_down();
    goes_on.wait();
    return plain("held");
  }));
  // The I/O threads get the connections in turn.
  TestServer server(std::move(routes), {.io_threads = 2, .max_connections = 4});
  Client first = server.connect();
  CHECK(first.ask(get("/a")).status == 200);
  Client second = server.connect();
  second.send(get("/hold"));
  is_held.wait();
  std::vector<Client> more = server.connect(4);
  CHECK(comes_true([&] { return server.server().counters().connections_refused == 2; }));
  goes_on.count_down();
  CHECK(second.read().body == "held");
  for (std::size_t i = 0; i < more.size(); ++i) {
    const Answer answer = i < 2 ? more[i].ask(get("/a")) : more[i].read();
    CHECK(answer.status == (i < 2 ? 200 : 503));
  }
}

TEST_CASE("a sender who was refused reads the answer at its own pace, as long as it sends") {
  TestServer server(limited_routes());
  // A machine that stands still makes it silent by chance.
  const auto is_heard_out = [&] {
    Client client = server.connect();
    bool goes_on = client.send(post_head(kBodyLimit + 1));
    for (int i = 0; i < 40 && goes_on; ++i) {
      std::this_thread::sleep_for(100ms);
      goes_on = client.send("x");
    }
    return client.read().status == 413 && goes_on;
  };
  CHECK(comes_true(is_heard_out));
}

TEST_CASE("half-sent large bodies hold no more than the budget, and others are served meanwhile") {
  // Two bodies and a half.
  TestServer server(limited_routes(), {.body_budget = 2'500'000});
  const std::vector<Client> stalled = server.connect(20);
  for (const Client& client : stalled) {
    client.send(post_head(kBodyLimit) + std::string(30'000, 'x'));
  }
  const auto in_flight = [&] { return server.server().counters().body_bytes_in_flight; };
  CHECK(comes_true([&] { return in_flight() == 2'000'000; }));
  std::this_thread::sleep_for(50ms);
  CHECK(in_flight() == 2'000'000);  // and no more

  CHECK(server.ask(get("/a")).status == 200);
  CHECK(server.ask(post("/p", "text/plain", std::string(16'000, 's'))).body.size() == 16'000);
  // A large one waits until one of the senders that have stopped gives way.
  CHECK(server.ask(post("/p", "text/plain", std::string(kBodyLimit, 'l'))).body.size() ==
        kBodyLimit);
  CHECK(server.server().counters().body_bytes_in_flight <= 2'500'000);
}

TEST_CASE("a body that waits too long for memory is 503") {
  ServerOptions options = quick();
  options.body_budget = 500'000;
  TestServer server(limited_routes(), options);
  const Answer answer = server.ask(post("/p", "text/plain", std::string(600'000, 'x')));
  CHECK(answer.status == 503);
  CHECK(answer.body.starts_with("service.overloaded"));
  CHECK(server.server().counters().body_bytes_in_flight == 0);
}

TEST_CASE("chunked bodies take their budget and give it back") {
  TestServer server(limited_routes(), {.body_budget = kBodyLimit});
  const std::string body(kBodyLimit, 'c');
  const std::string request = kChunkedPost + chunk(body) + kLastChunk;
  for (int i = 0; i < 3; ++i) CHECK(server.ask(request).body == body);
  CHECK(server.server().counters().body_bytes_in_flight == 0);
}

TEST_CASE("bodies of unknown length wait without holding what another waits for") {
  // The times are enough whatever the machine's speed.
  TestServer server(limited_routes(),
                    {.body_budget = 2 * kWholeLimit, .stall_time = 120s, .request_timeout = 120s});
  const std::string head = "POST /whole HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n";
  const auto in_flight = [&] { return server.server().counters().body_bytes_in_flight; };
  const auto holds = [&](std::size_t wholes, std::size_t parts) {
    return comes_true([&] { return in_flight() == wholes * kWholeLimit + (parts << 20U); });
  };
  // A machine that stands still makes a sender silent by chance, and it has to give way.
  const auto is_served_in_turn = [&] {
    std::vector<Client> clients = server.connect(5);
    const auto send = [&](std::size_t i) {
      clients[i].send(head + chunk(std::string(1'500'000, 'c')));
    };
    const auto status = [&](std::size_t i) { return clients[i].read().status; };
    send(0);
    send(1);
    bool right = holds(2, 0);
    send(2);
    right = right && holds(2, 1);
    send(3);
    right = right && holds(2, 2);
    send(4);  // one more than may wait
    right = right && status(4) == 503;
    // A small one needs only a part.
    right = right &&
            server.ask(kChunkedPost + chunk(std::string(200'000, 'c')) + kLastChunk).status == 200;
    for (const std::size_t i : {0U, 1U, 2U, 3U}) {
      clients[i].send(kLastChunk);
      right = right && status(i) == 200;
    }
    return right;
  };
  CHECK(comes_true(is_served_in_turn));
  CHECK(comes_true([&] { return in_flight() == 0; }));
}

namespace {

/// Six clients that ask for 20 MB and read little of it.
std::vector<Client> ask_and_read_not(TestServer& server, std::string& begun) {
  std::vector<Client> stuck = server.connect(6);
  for (Client& client : stuck) {
    client.send(get("/large", "Connection: close\r\n"));
    begun = client.read_some();  // its answer is on its way
    std::this_thread::sleep_for(100ms);
  }
  return stuck;
}

}  // namespace

TEST_CASE(
    "answers that nobody takes are bounded in bytes, and the newest is not the one that ends") {
  // The budget is of two answers, and what sockets take of others.
  TestServer server(limited_routes(), {.unsent_budget = 50'000'000, .unsent_time = 0ms});
  std::string begun;
  std::vector<Client> stuck = ask_and_read_not(server, begun);
  CHECK(comes_true([&] { return server.server().counters().connections_open == 2; }));
  CHECK(stuck.front().read_to_end().size() < 20'000'000);
  CHECK(begun.size() + stuck.back().read_to_end().size() > 20'000'000);
}

TEST_CASE("many who read at once get all of it, as long as they take no longer than they may") {
  TestServer server(limited_routes(), {.unsent_budget = 50'000'000, .unsent_time = 60s});
  std::string begun;
  std::vector<Client> readers = ask_and_read_not(server, begun);
  std::this_thread::sleep_for(2s);
  CHECK(server.server().counters().connections_open == 6);
  for (Client& reader : readers) CHECK(reader.read_to_end().size() > 19'900'000);
}
