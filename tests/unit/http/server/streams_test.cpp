#include <doctest/doctest.h>

#include "http/response.hpp"
#include "support/comes_true.hpp"
#include "test_server.hpp"
#include "worker.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;
using namespace std::chrono_literals;

namespace {

/// `count` numbered lines, produced on a worker.
class Lines final : public BodyStream {
 public:
  Lines(Worker& worker, int count, std::atomic<int>& produced)
      : worker_(worker), count_(count), produced_(produced) {}

  void next(ChunkSink sink) override {
    worker_.run([sink = std::move(sink), piece = make(), last = line_ >= count_]() mutable {
      if (last) {
        sink.finish(std::move(piece));
      } else {
        sink.put(std::move(piece));
      }
    });
  }

 private:
  std::string make() {
    std::string piece;
    while (line_ < count_ && piece.size() < 16'000) piece += fmt::format("line {}\n", line_++);
    produced_ = line_;
    return piece;
  }

  Worker& worker_;
  const int count_;
  std::atomic<int>& produced_;
  int line_ = 0;
};

/// Events that a test sends when it likes.
class Events final : public BodyStream {
 public:
  void next(ChunkSink sink) override {
    const std::lock_guard lock(mutex_);
    sink_.emplace(std::move(sink));
  }
  void cancelled() override {
    const std::lock_guard lock(mutex_);
    sink_.reset();
    is_cancelled = true;
  }
  bool send(std::string text, bool last = false) {
    return comes_true([&] {
      const std::lock_guard lock(mutex_);
      auto sink = std::exchange(sink_, std::nullopt);
      if (!sink) return false;
      if (last) {
        sink->finish(std::move(text));
      } else {
        sink->put(std::move(text));
      }
      return true;
    });
  }
  bool fail() {
    return comes_true([&] {
      const std::lock_guard lock(mutex_);
      auto sink = std::exchange(sink_, std::nullopt);
      if (sink) sink->fail();
      return sink.has_value();
    });
  }

  std::atomic<bool> is_cancelled = false;

 private:
  std::mutex mutex_;
  std::optional<ChunkSink> sink_;
};

Route events(const std::shared_ptr<Events>& stream, std::chrono::milliseconds heartbeat = 10s) {
  return {.pattern = "/events",
          .handler = [stream, heartbeat](const Request&) -> Result<Response> {
            return Response(200, "text/event-stream", StreamedBody{stream, ": \n\n", heartbeat});
          },
          .response_types = {"text/event-stream"}};
}

Route lines(Worker& worker, int count, std::atomic<int>& produced) {
  return {.pattern = "/lines",
          .handler = [&worker, &produced, count](const Request&) -> Result<Response> {
            return Response(200, "text/plain",
                            StreamedBody{std::make_shared<Lines>(worker, count, produced)});
          },
          .response_types = {"text/plain"}};
}

}  // namespace

TEST_CASE("a streamed body arrives whole in chunks and the connection goes on") {
  std::atomic<int> produced = 0;
  Worker worker;
  TestServer server({lines(worker, 100'000, produced), echo(Method::Get, "/a")});
  Client client = server.connect();
  client.send(get("/lines") + get("/a"));
  const auto answer = client.read();
  CHECK(answer.field("Transfer-Encoding") == "chunked");
  CHECK(answer.field("Content-Length").empty());
  CHECK(answer.body.starts_with("line 0\nline 1\n"));
  CHECK(answer.body.ends_with("line 99999\n"));
  CHECK(client.read().body == "fixed");
}

TEST_CASE("HTTP/1.0 gets a stream up to the end of the connection, HEAD gets none") {
  std::atomic<int> produced = 0;
  Worker worker;
  TestServer server({lines(worker, 5000, produced), echo(Method::Get, "/a")});
  const Answer old = server.ask("GET /lines HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
  CHECK(old.field("Transfer-Encoding").empty());
  CHECK(old.field("Connection") == "close");
  CHECK(old.body.ends_with("line 4999\n"));
  produced = 0;
  Client client = server.connect();
  CHECK(client.ask("HEAD /lines HTTP/1.1\r\nHost: h\r\n\r\n", true).status == 200);
  CHECK(client.ask(get("/a")).body == "fixed");
  CHECK(produced == 0);
}

TEST_CASE(
    "a stream is produced no faster than its reader takes it, and a stuck reader is dropped") {
  std::atomic<int> produced = 0;
  Worker worker;
  constexpr int kMany = 20'000'000;
  TestServer server({lines(worker, kMany, produced)}, {.write_timeout = 400ms});
  Client client = server.connect();
  client.send(get("/lines"));
  client.read_some();
  CHECK(comes_true([&] { return server.server().counters().connections_open == 0; }));
  CHECK(produced < kMany / 2);  // what the socket's buffers hold, and no more
}

TEST_CASE("events leave at once, heartbeats fill the silence") {
  const auto stream = std::make_shared<Events>();
  // The time to write is short, for a fine sweep.
  TestServer server({events(stream, 50ms)}, {.write_timeout = 100ms});
  Client client = server.connect();
  client.send(get("/events"));
  std::string seen = client.read_some();
  while (seen.find("4\r\n: \n\n\r\n") == std::string::npos) seen += client.read_some();
  CHECK(seen.find("text/event-stream") != std::string::npos);
  REQUIRE(stream->send("data: 1\n\n"));
  while (seen.find("9\r\ndata: 1\n\n\r\n") == std::string::npos) seen += client.read_some();
  REQUIRE(stream->send("data: 2\n\n", true));
  while (!seen.ends_with("9\r\ndata: 2\n\n\r\n0\r\n\r\n")) seen += client.read_some();
}

TEST_CASE("a stream whose reader has gone is cancelled") {
  const auto stream = std::make_shared<Events>();
  TestServer server({events(stream, 30ms)}, {.write_timeout = 100ms});
  {
    Client client = server.connect();
    client.send(get("/events"));
    client.read_some();
  }
  CHECK(comes_true([&] { return stream->is_cancelled.load(); }));
}

TEST_CASE("a stream that throws in the silence ends alone, and deadlines are kept") {
  class Throwing final : public BodyStream {
   public:
    void next(ChunkSink sink) override { sink_.emplace(std::move(sink)); }
    void idle() override { throw std::runtime_error("a bug of the silence"); }
    void cancelled() override { throw std::runtime_error("a bug of the end"); }

   private:
    std::optional<ChunkSink> sink_;
  };
  const Route throwing{.pattern = "/events",
                       .handler = [](const Request&) -> Result<Response> {
                         return Response(
                             200, "text/event-stream",
                             StreamedBody{std::make_shared<Throwing>(), ": \n\n", 50ms});
                       },
                       .response_types = {"text/event-stream"}};
  TestServer server({throwing, echo(Method::Get, "/a")}, {.idle_timeout = 1500ms});
  Client reader = server.connect();
  reader.send(get("/events"));
  CHECK(reader.read_some().find("200 OK") != std::string::npos);
  CHECK(reader.is_closed_by_server());
  Client idle = server.connect();
  CHECK(idle.ask(get("/a")).status == 200);
  CHECK(idle.is_closed_by_server());
}

TEST_CASE("a stream that fails closes without the end of the body") {
  const auto stream = std::make_shared<Events>();
  TestServer server({events(stream)});
  Client client = server.connect();
  client.send(get("/events"));
  REQUIRE(stream->send("data: 1\n\n"));
  std::string seen = client.read_some();
  while (seen.find("data: 1") == std::string::npos) seen += client.read_some();
  REQUIRE(stream->fail());
  seen += client.read_to_end();
  CHECK_FALSE(seen.ends_with("0\r\n\r\n"));
}

TEST_CASE("stopping the server cuts streams") {
  const auto stream = std::make_shared<Events>();
  TestServer server({events(stream)});
  Client client = server.connect();
  client.send(get("/events"));
  client.read_some();
  server.server().stop();
  CHECK(stream->is_cancelled);
  CHECK(client.read_to_end().empty());
}

TEST_CASE(
    "a stream ends when its caller may not read on: regularly if it is endless, else broken") {
  std::atomic<bool> allowed = true;
  ServerHooks hooks;
  hooks.may_continue = [&](const Request&) { return allowed.load(); };
  for (const bool is_endless : {true, false}) {
    CAPTURE(is_endless);
    allowed = true;
    const auto stream = std::make_shared<Events>();
    TestServer server({answering("/events",
                                 [&](const Request&) -> Result<Response> {
                                   return Response(
                                       200, "text/event-stream",
                                       StreamedBody{.source = stream, .is_endless = is_endless});
                                 })},
                      {}, hooks);
    Client client = server.connect();
    client.send(get("/events"));
    REQUIRE(stream->send("data: 1\n\n"));
    for (std::string got; got.find("data: 1") == std::string::npos;) {
      const std::string more = client.read_some();
      REQUIRE_FALSE(more.empty());
      got += more;
    }
    allowed = false;
    const std::string rest = client.read_to_end();
    CHECK(rest.ends_with("0\r\n\r\n") == is_endless);
    CHECK(comes_true([&] { return stream->is_cancelled.load(); }));
  }
}
