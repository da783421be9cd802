#include <doctest/doctest.h>

#include <future>

#include "base/thread.hpp"
#include "support/comes_true.hpp"
#include "test_server.hpp"
#include "worker.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;
using namespace std::chrono_literals;

namespace {

struct Finished {
  std::mutex mutex;
  std::vector<std::string> lines;
  ServerHooks hooks() {
    ServerHooks hooks;
    hooks.finished = [this](const FinishedRequest& done) {
      const std::lock_guard lock(mutex);
      lines.push_back(fmt::format("{} {} {} {} {} {}", done.method, done.route, done.status,
                                  done.bytes_received, done.bytes_sent > 0,
                                  done.request.peer_address()) +
                      (done.broken_off ? " broken off" : ""));
      CHECK(done.microseconds >= 0);
    };
    return hooks;
  }
};

}  // namespace

TEST_CASE("the guard sees the route before the body is read and may answer itself") {
  ServerHooks hooks;
  hooks.guard = [](Request& request, const Route& route) -> Result<std::optional<Response>> {
    if (route.access.empty()) return std::optional<Response>{};
    const auto key = request.header("Authorization");
    if (!key) return std::optional(Response(401).with("WWW-Authenticate", "Bearer"));
    if (*key == "Bearer weak") return Error{ErrorCode::Forbidden, "no"};
    request.set_caller(std::string(key->substr(7)));
    return std::optional<Response>{};
  };
  Route route = {.method = Method::Post,
                 .pattern = "/w",
                 .handler = [](const Request& request) -> Result<Response> {
                   const auto* const caller = request.caller<std::string>();
                   return Response(200, "text/plain", caller ? *caller : "nobody");
                 },
                 .body = {.use = BodyUse::Optional},
                 .response_types = {"text/plain"},
                 .access = "operator"};
  Route open = route;
  open.pattern = "/open";
  open.access.clear();
  TestServer server({std::move(route), std::move(open)}, {}, hooks);
  Client early = server.connect();
  early.send("POST /w HTTP/1.1\r\nHost: h\r\nContent-Length: 1000\r\n\r\n");
  CHECK(early.read().field("WWW-Authenticate") == "Bearer");
  CHECK(server.ask(post("/w", "a/b", "x", "Authorization: Bearer weak\r\n")).status == 500);
  Client client = server.connect();
  CHECK(client.ask(post("/w", "a/b", "x", "Authorization: Bearer press-3\r\n")).body == "press-3");
  CHECK(client.ask(post("/open", "a/b", "x")).body == "nobody");  // no caller stays behind
}

TEST_CASE("a request knows its peer, and a proxy's field makes it remote") {
  TestServer server({answering("/peer", [](const Request& request) -> Result<Response> {
    return Response(200, "text/plain",
                    fmt::format("{} {}", request.peer_address(), request.is_local()));
  })});
  CHECK(server.ask(get("/peer", "X-Real: 1\r\nVias: 1\r\n")).body == "127.0.0.1 true");
  for (const char* field :
       {"Forwarded", "forwarded", "X-Forwarded-For", "x-forwarded-anything", "Via", "X-Real-IP",
        "X-REAL-IP", "True-Client-IP", "CF-Connecting-IP"}) {
    CAPTURE(field);
    CHECK(server.ask(get("/peer", fmt::format("{}: x\r\n", field))).body == "127.0.0.1 false");
  }
  Client client = server.connect();
  CHECK(client.ask(get("/peer", "Via: x\r\n")).body == "127.0.0.1 false");
  CHECK(client.ask(get("/peer")).body == "127.0.0.1 true");  // of each request by itself
}

TEST_CASE("header lookups are case-insensitive and lists are joined") {
  TestServer server({answering("/h", [](const Request& request) -> Result<Response> {
    return Response(
        200, "text/plain",
        fmt::format("{}|{}|{}", request.header("x-A").value_or("-"),
                    request.header_list("X-a").value_or("-"), request.header("X-B").has_value()));
  })});
  CHECK(server.ask(get("/h", "X-A: 1\r\nx-a: 2\r\n")).body == "1|1, 2|false");
}

TEST_CASE("every answered request is reported once") {
  Finished finished;
  TestServer server(
      {echo(Method::Get, "/a/{x}"), echo(Method::Post, "/p", {.use = BodyUse::Optional})}, {},
      finished.hooks());
  Client client = server.connect();
  const std::string request = get("/a/1");
  client.ask(request);
  client.ask(get("/nothing"));
  client.ask(post("/p", "a/b", std::string(50'000, 'x')));
  client.ask("garbage\r\n\r\n");
  const std::lock_guard lock(finished.mutex);
  REQUIRE(finished.lines.size() == 4);
  CHECK(finished.lines[0] == fmt::format("GET /a/{{x}} 200 {} true 127.0.0.1", request.size()));
  CHECK(finished.lines[1].starts_with("GET  404 "));
  CHECK(finished.lines[2].starts_with("POST /p 200 500"));
  CHECK(finished.lines[3].starts_with("  400 "));
  CHECK(server.server().counters().requests == 4);
}

TEST_CASE("a request whose connection ends early is reported once, as broken off") {
  class Endless final : public BodyStream {
   public:
    void next(ChunkSink sink) override { sink_.emplace(std::move(sink)); }
    void cancelled() override {}

   private:
    std::optional<ChunkSink> sink_;
  };
  Finished finished;
  TestServer server({{.pattern = "/events",
                      .handler = [](const Request&) -> Result<Response> {
                        return Response(200, "text/event-stream",
                                        StreamedBody{.source = std::make_shared<Endless>(),
                                                     .heartbeat = ":\n\n",
                                                     .heartbeat_interval = 20ms});
                      },
                      .response_types = {"text/event-stream"}},
                     echo(Method::Post, "/p", {.use = BodyUse::Optional})},
                    {}, finished.hooks());
  const auto leave = [&](const std::string& request, bool is_answered) {
    Client client = server.connect();
    client.send(request);
    if (is_answered) client.read_some();
  };
  const auto reported = [&](std::size_t count) {
    return comes_true([&] {
      const std::lock_guard lock(finished.mutex);
      return finished.lines.size() >= count;
    });
  };
  leave(get("/events"), true);
  REQUIRE(reported(1));
  leave("POST /p HTTP/1.1\r\nHost: h\r\nContent-Type: a/b\r\nContent-Length: 9\r\n\r\nhalf", false);
  REQUIRE(reported(2));
  leave("GET /ev", false);  // no request
  server.ask(post("/p", "a/b", "x"));
  const std::lock_guard lock(finished.mutex);
  REQUIRE(finished.lines.size() == 3);
  CHECK(finished.lines[0].starts_with("GET /events 200 "));
  CHECK(finished.lines[0].ends_with("true 127.0.0.1 broken off"));
  CHECK(finished.lines[1].starts_with("POST /p 0 "));
  CHECK(finished.lines[1].ends_with("false 127.0.0.1 broken off"));
  CHECK(finished.lines[2].starts_with("POST /p 200 "));
}

TEST_CASE("what a hook throws ends its connection alone, and is reported") {
  static std::mutex mutex;
  static std::string reported;
  report_bugs_to([](std::string_view place, std::string_view what) {
    const std::lock_guard lock(mutex);
    reported += fmt::format("{}: {}\n", place, what);
  });
  ServerHooks hooks;
  hooks.finished = [](const FinishedRequest& done) {
    if (done.route != "/fine") throw std::runtime_error("a bug of the " + std::string(done.route));
  };
  Worker worker;
  TestServer server({echo(Method::Get, "/fine"), echo(Method::Get, "/now"),
                     answering_on(worker, "/late", [](const Request&) { return plain("late"); })},
                    {}, hooks);
  Client other = server.connect();
  CHECK(other.ask(get("/fine")).status == 200);
  CHECK(server.ask(get("/now")).status == 0);
  CHECK(server.ask(get("/late")).status == 0);
  CHECK(other.ask(get("/fine")).status == 200);
  const std::lock_guard lock(mutex);
  CHECK(reported == "a connection: a bug of the /now\na connection: a bug of the /late\n");
}

TEST_CASE("a client that sends its last request and its end at once is answered and closed") {
  std::promise<void> entered;
  std::promise<void> go_on;
  TestServer server({answering("/busy",
                               [&](const Request&) -> Result<Response> {
                                 entered.set_value();
                                 go_on.get_future().wait();
                                 return plain("busy");
                               }),
                     echo(Method::Get, "/a")});
  Client last = server.connect();
  CHECK(last.ask(get("/a")).status == 200);
  Client busy = server.connect();
  busy.send(get("/busy"));
  entered.get_future().wait();  // the I/O thread meets what follows in one piece
  last.send(get("/a"));
  last.shut_down_send();
  busy.send(get("/a"));
  busy.shut_down_send();
  go_on.set_value();
  for (Client* const client : {&last, &busy}) {
    CHECK(client->read().status == 200);
    if (client == &busy) CHECK(client->read().status == 200);
    CHECK(client->is_closed_by_server());
  }
}

TEST_CASE("stop finishes the request in flight, closes idle connections and accepts no more") {
  Worker worker;
  std::promise<void> entered, goes_on;
  TestServer server({answering_on(worker, "/slow",
                                  [&](const Request&) {
                                    entered.set_value();
                                    goes_on.get_future().wait();
                                    return plain("done");
                                  }),
                     echo(Method::Get, "/a")});
  Client idle = server.connect();
  CHECK(idle.ask(get("/a")).status == 200);
  Client busy = server.connect();
  busy.send(get("/slow"));
  entered.get_future().wait();
  std::thread stop([&] { server.server().stop(); });
  CHECK(idle.is_closed_by_server());
  goes_on.set_value();
  stop.join();
  CHECK(server.server().counters().connections_open == 0);
  const auto answer = busy.read();
  CHECK(answer.body == "done");
  CHECK(answer.field("Connection") == "close");
  CHECK(busy.is_closed_by_server());
  CHECK_THROWS(server.connect());
}

TEST_CASE("stop does not wait for ever, and a late answer is dropped") {
  std::optional<Responder> kept;
  std::promise<void> entered;
  TestServer server({answering("/never",
                               [&](const Request&, Responder responder) {
                                 kept.emplace(std::move(responder));
                                 entered.set_value();
                               })},
                    {.drain_timeout = 50ms});
  Client client = server.connect();
  client.send(get("/never"));
  entered.get_future().wait();
  server.server().stop();
  kept->answer(Response(204));
  CHECK(client.is_closed_by_server());
}

TEST_CASE("a handler has its request's body until it answers, also when the server stops") {
  const Request* kept_request = nullptr;
  std::optional<Responder> kept;
  std::promise<void> entered;
  TestServer server({{.method = Method::Post,
                      .pattern = "/never",
                      .handler =
                          [&](const Request& request, Responder responder) {
                            kept_request = &request;
                            kept.emplace(std::move(responder));
                            entered.set_value();
                          },
                      .body = {.use = BodyUse::Required, .media_types = {"text/plain"}}}},
                    {.drain_timeout = 50ms});
  Client client = server.connect();
  const std::string body(50'000, 'x');
  client.send("POST /never HTTP/1.1\r\nHost: h\r\nContent-Type: text/plain\r\nContent-Length: " +
              std::to_string(body.size()) + "\r\n\r\n" + body);
  entered.get_future().wait();
  server.server().stop();
  CHECK(kept_request->body() == body);
  kept->answer(Response(204));
}

TEST_CASE("a client that goes away while its answer is made harms nobody") {
  std::promise<void> left;
  const std::shared_future<void> all_left(left.get_future());
  Worker worker;
  TestServer server({answering_on(worker, "/slow",
                                  [&](const Request& request) {
                                    all_left.wait();
                                    return plain(std::string(request.path()));
                                  }),
                     echo(Method::Get, "/a")});
  for (int i = 0; i < 5; ++i) server.connect().send(get("/slow"));
  CHECK(server.ask(get("/a")).status == 200);
  left.set_value();
  CHECK(comes_true([&] { return server.server().counters().connections_open == 0; }));
}

TEST_CASE("several I/O threads and addresses serve side by side") {
  TestServer server({echo(Method::Get, "/a")},
                    {.listen = {{.host = "127.0.0.1", .port = 0}, {.host = "127.0.0.1", .port = 0}},
                     .io_threads = 3});
  REQUIRE(server.server().ports().size() == 2);
  std::array<std::thread, 8> clients;
  std::atomic<int> good = 0;
  for (std::size_t i = 0; i < clients.size(); ++i) {
    clients.at(i) = std::thread([&, i] {
      Client client(server.server().ports()[i % 2]);
      for (int n = 0; n < 50; ++n) {
        good += client.ask(get("/a")).body == "fixed";
      }
    });
  }
  for (std::thread& client : clients) client.join();
  CHECK(good == 400);
  CHECK(server.server().counters().requests == 400);
}

TEST_CASE("a port in use and an address that is not ours are refused with the reason") {
  TestServer server({echo(Method::Get, "/a")});
  const auto second =
      Server::start({.listen = {{.host = "127.0.0.1", .port = server.port()}}}, RouteTable({}), {});
  CHECK(second.error().code == ErrorCode::ListenFailed);
  CHECK(second.error().message.find(std::to_string(server.port())) != std::string::npos);
  CHECK(Server::start({.listen = {{.host = "203.0.113.1", .port = 1}}}, RouteTable({}), {})
            .has_error());
  CHECK(Server::start({.listen = {{.host = "no address"}}}, RouteTable({}), {}).has_error());
}
