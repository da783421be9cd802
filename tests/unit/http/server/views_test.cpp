// What a handler reads of its request must be what the client sent, whatever the body did to the
// buffers meanwhile: every form of body with every kind of route. AddressSanitizer sees the reads.

#include <doctest/doctest.h>

#include "base/gzip.hpp"
#include "test_server.hpp"
#include "worker.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

/// Longer than the buffer a connection begins with, so that reading it moves what can move.
const std::string kLongBody = [] {
  std::string text;
  for (int i = 0; text.size() < 30'000; ++i) text += std::to_string(i * 7919) + ",";
  return text;
}();

struct BodyForm {
  std::string name;
  std::string fields;
  /// The bytes after the head in the pieces that are sent one by one, for a given body.
  std::function<std::vector<std::string>(const std::string&)> pieces;
  bool gzip = false;
  bool expects = false;
  bool with_length = false;
};

std::vector<std::string> halves(const std::string& bytes) {
  return {bytes.substr(0, bytes.size() / 2), bytes.substr(bytes.size() / 2)};
}

std::string in_chunks(std::string_view bytes) {
  std::string out;
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 997))) {
    out += chunk(bytes.substr(0, 997));
  }
  return out + "0\r\nX-Trailer: t\r\n\r\n";
}

std::vector<BodyForm> body_forms() {
  using Texts = std::vector<std::string>;
  const auto whole = [](const std::string& bytes) { return Texts{bytes}; };
  const auto late = [](const std::string& bytes) { return halves(bytes); };
  const auto chunked = [](const std::string& bytes) { return Texts{in_chunks(bytes)}; };
  const auto slow_chunks = [](const std::string& bytes) { return halves(in_chunks(bytes)); };
  const std::string te = "Transfer-Encoding: chunked\r\n";
  const std::string ce = "Content-Encoding: gzip\r\n";
  const std::string expect = "Expect: 100-continue\r\n";
  return {
      {.name = "length", .fields = "", .pieces = whole, .with_length = true},
      {.name = "late length", .fields = "", .pieces = late, .with_length = true},
      {.name = "length, Expect",
       .fields = expect,
       .pieces = whole,
       .expects = true,
       .with_length = true},
      {.name = "gzip", .fields = ce, .pieces = late, .gzip = true, .with_length = true},
      {.name = "gzip, Expect",
       .fields = ce + expect,
       .pieces = late,
       .gzip = true,
       .expects = true,
       .with_length = true},
      {.name = "chunked", .fields = te, .pieces = chunked},
      {.name = "slow chunks", .fields = te, .pieces = slow_chunks},
      {.name = "chunked, Expect", .fields = te + expect, .pieces = chunked, .expects = true},
      {.name = "chunked gzip", .fields = te + ce, .pieces = slow_chunks, .gzip = true},
      {.name = "chunked gzip, Expect",
       .fields = te + ce + expect,
       .pieces = chunked,
       .gzip = true,
       .expects = true},
  };
}

/// Everything that a Request says, one item a line.
std::string description(const Request& request) {
  const auto shown = [](const auto& value) { return value ? std::string(*value) : "-"; };
  std::string out =
      fmt::format("{} {}?{}\n", name(request.method()), request.path(), request.query());
  for (const Parameter& parameter : request.route()->parameters) {
    out += fmt::format("{}={}\n", parameter.name, shown(request.text(parameter.name)));
  }
  out += fmt::format("key={}\nhost={}\ntype={}\naccept={}\n", shown(request.header("X-Key")),
                     request.own_origin(), request.media_type(), request.response_type());
  return out + std::string(request.body());
}

struct Target {
  Method method;
  std::string pattern;
  std::string sent;  ///< the request target
  std::string seen;  ///< the arguments as description() writes them
  bool takes_body = true;
};

const std::vector<Target> kTargets{
    {Method::Put, "/files/{path*}", "/files/nc_prog/some_program_name.h",
     "path=nc_prog/some_program_name.h\n"},
    {Method::Put, "/coded/{path*}", "/coded/nc%20prog/%C3%98.h", "path=nc prog/\xC3\x98.h\n"},
    {Method::Post, "/check/{name}", "/check/tool?action=check", "action=check\nname=tool\n"},
    {Method::Post, "/check2/{name}", "/check2/a%62c?action=ch%65ck", "action=check\nname=abc\n"},
    {Method::Get, "/limits/{designation}", "/limits/25H7", "designation=25H7\n", false},
    {Method::Get, "/list", "/list?action=SN-1", "action=SN-1\n", false},
    {Method::Delete, "/gone/{path*}", "/gone/nc_prog/8255.h", "path=nc_prog/8255.h\n", false},
    {Method::Post, "/keyed", "/keyed", "Idempotency-Key=\"retry-1\"\n"},
};

std::vector<Route> routes_of(const Target& target, Worker& worker, bool asynchronous) {
  const auto describe = [](const Request& request) { return plain(description(request)); };
  Route route = asynchronous ? answering_on(worker, target.pattern, describe)
                             : answering(target.pattern, describe);
  route.method = target.method;
  if (target.seen.find("action=") != std::string::npos) route.parameters = {{.name = "action"}};
  if (target.seen.find("Idempotency-Key") != std::string::npos) {
    route.parameters = {{.name = "Idempotency-Key", .place = ParameterPlace::Header}};
  }
  route.body = {.use = target.takes_body ? BodyUse::Required : BodyUse::None};
  route.response_types = {"text/html", "text/plain"};
  return {std::move(route)};
}

}  // namespace

TEST_CASE("a request says what was sent, in every form of body and on every kind of route") {
  Worker worker;
  for (const bool asynchronous : {false, true}) {
    for (const Target& target : kTargets) {
      TestServer server(routes_of(target, worker, asynchronous));
      Client client = server.connect();  // one for all forms: what one leaves behind meets the next
      for (const BodyForm& form : body_forms()) {
        for (const std::string& body : {kLongBody, std::string("short")}) {
          CAPTURE(target.sent);
          CAPTURE(form.name);
          CAPTURE(body.size());
          const std::string bytes = form.gzip ? gzip(body) : body;
          std::string head = fmt::format(
              "{} {} HTTP/1.1\r\nHost: gauge.example:8286\r\nContent-Type: Text/CSV\r\n"
              "Accept: text/plain\r\nX-Key: some-value\r\nIdempotency-Key: \"retry-1\"\r\n{}",
              name(target.method), target.sent, form.fields);
          if (form.with_length) head += fmt::format("Content-Length: {}\r\n", bytes.size());
          client.send(head + "\r\n");
          if (form.expects) REQUIRE(client.read().status == 100);
          for (const std::string& piece : form.pieces(bytes)) {
            client.send(piece);
            std::this_thread::yield();
          }
          const auto answer = client.read();
          CHECK(answer.status == 200);
          const std::size_t mark = target.sent.find('?');
          const std::string expected = fmt::format(
              "{} {}?{}\n{}key=some-value\nhost=http://gauge.example:8286\n"
              "type=text/csv\naccept=text/plain\n{}",
              name(target.method), target.sent.substr(0, mark),
              mark == std::string::npos ? "" : target.sent.substr(mark + 1), target.seen,
              target.takes_body ? body : "");
          CHECK((answer.body == expected));  // not printed: it is long
        }
      }
    }
  }
}

TEST_CASE("a request behind a chunked body is read from its first byte") {
  TestServer server(
      {echo(Method::Post, "/p", {.use = BodyUse::Required}), echo(Method::Get, "/a")});
  for (const std::size_t size : {5U, 5000U, 30'000U}) {
    Client client = server.connect();
    const std::string body(size, 'x');
    client.send(kChunkedPost);
    const std::string rest = in_chunks(body) + get("/a") + get("/a");
    client.send(rest.substr(0, rest.size() - 20));  // into the middle of a head
    CHECK((client.read().body == body));
    CHECK(client.read().body == "fixed");
    client.send(rest.substr(rest.size() - 20));
    CHECK(client.read().body == "fixed");
  }
}

TEST_CASE("a Transfer-Encoding before a long head is understood") {
  TestServer server({echo(Method::Post, "/p", {.use = BodyUse::Required})});
  Client client = server.connect();
  client.send("POST /p HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n");
  for (int i = 0; i < 6; ++i) {  // each moves the head into a larger buffer, or may
    client.send(fmt::format("X-Long-{}: {}\r\n", i, std::string(4000, 'l')));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK(client.ask("\r\n" + in_chunks("hello")).body == "hello");
}
