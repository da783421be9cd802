// Answers of every kind: asynchronous, prepared, streamed, conditional, failed.

#include <doctest/doctest.h>

#include "http/response.hpp"
#include "test_server.hpp"
#include "worker.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

/// Answers from another thread, the later the smaller its number.
Route slow(Worker& worker) {
  return answering_on(worker, "/slow/{n}", [](const Request& request) -> Result<Response> {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return plain("slow " + std::string(*request.text("n")));
  });
}

Route fast() {
  return answering("/fast/{n}", [](const Request& request) -> Result<Response> {
    return plain("fast " + std::string(*request.text("n")));
  });
}

/// Answers even numbers at once, and odd ones from another thread.
Route either(Worker& worker) {
  Route route = slow(worker);
  route.pattern = "/either/{n}";
  const auto is_odd = [](const Request& request) {
    return (request.text("n")->back() - '0') % 2 != 0;
  };
  route.handler = EitherHandler{is_odd, std::get<SyncHandler>(fast().handler),
                                std::get<AsyncHandler>(route.handler)};
  return route;
}

}  // namespace

TEST_CASE("pipelined requests are answered in order, whoever answers them") {
  Worker worker;
  TestServer server({slow(worker), fast()});
  Client client = server.connect();
  std::string requests;
  for (int i = 0; i < 40; ++i) requests += get(fmt::format("/{}/{}", i % 3 ? "fast" : "slow", i));
  client.send(requests);
  for (int i = 0; i < 40; ++i) {
    const auto answer = client.read();
    CHECK(answer.body == fmt::format("{} {}", i % 3 ? "fast" : "slow", i));
  }
}

TEST_CASE("a handler answers at once what it can, and in order with what it answers later") {
  Worker worker;
  TestServer server({either(worker)});
  Client client = server.connect();
  std::string requests;
  for (int i = 0; i < 40; ++i) requests += get(fmt::format("/either/{}", i));
  client.send(requests);
  for (int i = 0; i < 40; ++i) {
    const auto answer = client.read();
    CHECK(answer.body == fmt::format("{} {}", i % 2 == 0 ? "fast" : "slow", i));
  }
}

TEST_CASE("answers given together leave when the batch ends") {
  std::mutex mutex;
  std::vector<Responder> waiting;
  TestServer server({answering("/wait",
                               [&](const Request&, Responder responder) {
                                 const std::lock_guard lock(mutex);
                                 waiting.push_back(std::move(responder));
                               }),
                     fast()},
                    {.io_threads = 2});
  std::vector<Client> clients = server.connect(8);
  for (const Client& client : clients) client.send(get("/wait"));
  const auto count = [&] {
    const std::lock_guard lock(mutex);
    return waiting.size();
  };
  while (count() < clients.size()) std::this_thread::yield();
  {
    const AnswerBatch batch;
    for (std::size_t i = 0; i < 6; ++i) waiting[i].answer(plain("together"));
    waiting[6].fail({ErrorCode::StorageBusy, "full"});
    // A thread without a batch of its own is not held up by this one.
    std::thread other([&] { CHECK(server.ask(get("/fast/1")).body == "fast 1"); });
    other.join();
    waiting.clear();  // the last one without an answer
  }
  // Two I/O threads: which client is which has been left open.
  const auto together = std::count_if(clients.begin(), clients.end(), [](Client& client) {
    const auto answer = client.read();
    CHECK(answer.status != 0);
    return answer.status == 200 && answer.body == "together";
  });
  CHECK(together == 6);
}

TEST_CASE("answers that pile up before a slow reader stay whole and in order") {
  Worker worker;
  TestServer server({answering("/fast/{n}",
                               [](const Request& request) -> Result<Response> {
                                 return plain(std::string(20'000, 'x') +
                                              std::string(*request.text("n")));
                               }),
                     slow(worker)});
  Client client = server.connect();
  constexpr int kCount = 1500;  // 30 MB, more than any socket buffer holds
  std::thread sender([&] {
    for (int i = 0; i < kCount; ++i)
      client.send(get(fmt::format("/{}/{}", i % 50 ? "fast" : "slow", i)));
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  bool in_order = true;
  for (int i = 0; i < kCount; ++i) {
    const auto answer = client.read();
    in_order = in_order && answer.body.ends_with((i % 50 ? "x" : "slow ") + std::to_string(i));
  }
  sender.join();
  CHECK(in_order);
}

TEST_CASE("every complete request in the buffer is answered in one write") {
  Worker worker;
  TestServer server({fast(), either(worker)});
  for (const std::string path : {"/fast/2", "/either/2"}) {
    Client client = server.connect();
    std::string requests;
    for (int i = 0; i < 16; ++i) requests += get(path);
    client.send(requests);
    const std::string answers = client.read_some();
    std::size_t count = 0;
    for (std::size_t at = 0; (at = answers.find("fast 2", at)) != std::string::npos; ++at) ++count;
    CHECK(count == 16);
  }
}

TEST_CASE("a handler that fails answers by the error formatter, one that throws 500 with the id") {
  std::string thrown;
  ServerHooks hooks;
  hooks.format_error = [](const Error& error, std::optional<int> status, const Request& request) {
    return Response(status.value_or(422), "application/problem+json",
                    fmt::format("{} {} {}", id(error.code), request.path(), request.id_text()));
  };
  hooks.handler_threw = [&](const Request&, std::string_view what) { thrown = what; };
  Worker worker;
  TestServer server(
      {{.pattern = "/error",
        .handler = [](const Request&) -> Result<Response> {
          return Error{ErrorCode::ClassUndefinedForSize, "no"};
        }},
       {.pattern = "/throw",
        .handler = [](const Request&) -> Result<Response> { throw std::runtime_error("oops"); }},
       answering_on(worker, "/async-error",
                    [](const Request&) -> Result<Response> {
                      return Error{ErrorCode::StorageBusy, "full"};
                    }),
       {.pattern = "/dropped", .handler = [](const Request&, Responder) {}},
       {.pattern = "/async-throw",
        .handler = [](const Request&, Responder) { throw std::runtime_error("early"); }}},
      {}, hooks);
  Client client = server.connect();
  auto answer = client.ask(get("/error"));
  CHECK(answer.status == 422);
  CHECK(answer.field("Content-Type") == "application/problem+json");
  CHECK(answer.body.starts_with("class.undefined_for_size /error "));
  answer = client.ask(get("/throw"));
  CHECK(answer.status == 500);
  CHECK(answer.body.starts_with("service.internal /throw "));
  CHECK(thrown == "oops");
  CHECK(client.ask(get("/async-error")).body.starts_with("storage.busy"));
  CHECK(client.ask(get("/dropped")).status == 500);
  CHECK(client.ask(get("/async-throw")).status == 500);
  CHECK(client.ask(get("/missing")).status == 404);
  CHECK(client.ask("BAD\r\n\r\n").body.starts_with("request."));
}

TEST_CASE("a prepared answer is the same bytes with the Date of now") {
  const auto prepared =
      prepare(Response(200, "application/json", std::string("{}")).with("Vary", "Accept"));
  TestServer server(
      {{.pattern = "/p", .handler = [&](const Request&) { return Response(prepared); }}});
  Client client = server.connect();
  const auto answer =
      client.ask(get("/p", "X-Request-Id: 1\r\n") + get("/p", "X-Request-Id: 1\r\n"));
  CHECK(answer.status == 200);
  CHECK(answer.body == "{}");
  CHECK(answer.field("Vary") == "Accept");
  CHECK(answer.field("Date").ends_with("GMT"));
  CHECK(answer.field("Date").find("1970") == std::string::npos);
  CHECK(client.read().head == answer.head);
  const auto head = client.ask("HEAD /p HTTP/1.1\r\nHost: h\r\n\r\n", true);
  CHECK(head.field("Content-Length") == "2");
  const auto last = client.ask(get("/p", "Connection: close\r\n"));
  CHECK(last.field("Connection") == "close");
  CHECK(last.body == "{}");
  CHECK(client.is_closed_by_server());
  CHECK(server.ask("GET /p HTTP/1.0\r\nConnection: keep-alive\r\n\r\n").field("Connection") ==
        "keep-alive");
}

TEST_CASE("If-None-Match is answered 304 from either kind of answer") {
  const auto tagged = [] {
    Response response = plain("body").with("Vary", "Accept").with("X-Other", "x");
    response.etag = "\"r1\"";
    return response;
  };
  const auto prepared = prepare(tagged());
  TestServer server({answering("/plain", [&](const Request&) { return tagged(); }),
                     answering("/prepared", [&](const Request&) { return Response(prepared); }),
                     {.method = Method::Post,
                      .pattern = "/plain",
                      .handler = [&](const Request&) { return tagged(); },
                      .response_types = {}}});
  for (const char* path : {"/plain", "/prepared"}) {
    Client client = server.connect();
    for (const char* tags : {"\"r1\"", "W/\"r1\"", "\"r0\", \"r1\"", "*"}) {
      const auto answer = client.ask(get(path, fmt::format("If-None-Match: {}\r\n", tags)));
      CHECK(answer.status == 304);
      CHECK(answer.field("ETag") == "\"r1\"");
      CHECK(answer.field("Vary") == "Accept");
      CHECK(answer.field("X-Other").empty());
      CHECK(answer.field("Content-Length").empty());
      CHECK(answer.field("Date").ends_with("GMT"));
    }
    const auto changed = client.ask(get(path, "If-None-Match: \"r2\"\r\n"));
    CHECK(changed.status == 200);
    CHECK(changed.body == "body");
    CHECK(
        client
            .ask(fmt::format("HEAD {} HTTP/1.1\r\nHost: h\r\nIf-None-Match: \"r1\"\r\n\r\n", path),
                 true)
            .status == 304);
  }
  CHECK(server.ask(post("/plain", "a/b", "", "If-None-Match: *\r\n")).status == 200);
}

TEST_CASE("a body of megabytes is sent whole, shared or not, prepared or not") {
  auto bytes = std::make_shared<std::string>();
  for (int i = 0; bytes->size() < 3'000'000; ++i) *bytes += std::to_string(i) + " ";
  const std::shared_ptr<const std::string> shared = bytes;
  const auto prepared = prepare(Response(200, "text/plain", shared));
  TestServer server(
      {answering("/shared", [&](const Request&) { return Response(200, "text/plain", shared); }),
       answering("/own", [&](const Request&) { return Response(200, "text/plain", *shared); }),
       answering("/prepared", [&](const Request&) { return Response(prepared); })});
  Client client = server.connect();
  client.send(get("/shared") + get("/own") + get("/prepared") + get("/own"));
  for (int i = 0; i < 4; ++i) {
    const auto answer = client.read();
    CHECK(answer.body == *shared);
  }
}

TEST_CASE("a line break in a field value cannot begin a field") {
  TestServer server({{.pattern = "/a", .handler = [](const Request&) -> Result<Response> {
                        return Response(204).with("Location", "/x\r\nSet-Cookie: a=b");
                      }}});
  const Answer answer = server.ask(get("/a"));
  CHECK(answer.field("Set-Cookie").empty());
  CHECK(answer.field("Location") == "/x  Set-Cookie: a=b");
}
