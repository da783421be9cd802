// Bytes as what a client sends, in pieces of drawn sizes, through a connection without a socket.
// Every answer is one, what a handler reads is there (AddressSanitizer looks), and the connection
// ends or waits for more.

#include <cctype>

#include "http/engine/connection.hpp"
#include "http/engine/io_thread.hpp"
#include "target.hpp"

using namespace fitgauge;
using namespace fitgauge::http;

namespace {

/// A client that is gone when it has sent everything, and takes answers in small pieces.
class MemoryConnection final : public Connection {
 public:
  using Connection::Connection;

  void start() override { begin(); }

  /// One event: bytes come, or bytes have left. @returns false when it waits for neither.
  bool step(std::string_view& unsent, std::size_t most) {
    if (is_closed_) return false;
    if (!leaving_.empty()) {
      const std::string_view bytes = std::exchange(leaving_, {});
      sent_ += bytes;
      on_write({}, bytes.size());
      return true;
    }
    if (room_.empty()) return false;
    const std::span<char> room = std::exchange(room_, {});
    if (unsent.empty()) {
      on_read(asio::error::eof, 0);
      return true;
    }
    const std::size_t count = std::min({room.size(), most, unsent.size()});
    std::memcpy(room.data(), unsent.data(), count);
    unsent.remove_prefix(count);
    on_read({}, count);
    return true;
  }

  const std::string& sent() const { return sent_; }

 private:
  void read_some(std::span<char> room) override { room_ = room; }
  std::size_t write_now(std::string_view bytes, bool&) override {
    const std::size_t count = std::min<std::size_t>(bytes.size(), 1500);
    sent_ += bytes.substr(0, count);
    return count;
  }
  void write_some(std::string_view bytes) override { leaving_ = bytes; }
  void end_gracefully() override { read_more(); }
  void close_socket() noexcept override { is_closed_ = true; }

  std::span<char> room_;
  std::string_view leaving_;
  std::string sent_;
  bool is_closed_ = false;
};

/// Sends a few pieces.
class CountedPieces final : public BodyStream {
 public:
  void next(ChunkSink sink) override {
    if (++told_ > 3) return sink.finish("end");
    sink.put("piece");
  }

 private:
  int told_ = 0;
};

/// Reads all that a request says.
std::string description(const Request& request) {
  std::string out(request.path());
  out += request.query();
  for (const Parameter& parameter : request.route()->parameters) {
    if (const auto value = request.text(parameter.name)) out += *value;
  }
  out += request.own_origin();
  out += request.media_type();
  out += request.header("X-Key").value_or("");
  request.append_identity(out);
  out += request.body();
  // The bytes behind the body may be read.
  unsigned sum = 0;
  for (std::size_t i = 0; i < Request::kBodyPadding; ++i) {
    sum += static_cast<unsigned char>(request.body().data()[request.body().size() + i]);
  }
  return out + std::to_string(sum == 0);
}

std::vector<Route> routes() {
  const BodyRules body{.use = BodyUse::Required, .limit = 50'000};
  const auto at_once = [](const Request& request) -> Result<Response> {
    Response response(200, "text/plain", description(request));
    response.etag = "\"7\"";
    return response;
  };
  const auto later = [](const Request& request, Responder responder) {
    responder.answer(Response(200, "text/plain", description(request)));
  };
  std::vector<Route> all(5);
  all[0].pattern = "/g/{name}";
  all[0].handler = SyncHandler(at_once);
  all[0].parameters = {{.name = "q"}};
  all[1].method = Method::Post;
  all[1].pattern = "/p/{path*}";
  all[1].handler = SyncHandler(at_once);
  all[1].body = body;
  all[2].method = Method::Put;
  all[2].pattern = "/a/{path*}";
  all[2].handler = AsyncHandler(later);
  all[2].body = body;
  all[3].pattern = "/s";
  all[3].handler = SyncHandler([](const Request&) -> Result<Response> {
    return Response(200, "text/plain", StreamedBody{.source = std::make_shared<CountedPieces>()});
  });
  all[4].method = Method::Delete;
  all[4].pattern = "/a/{path*}";
  all[4].handler = AsyncHandler(later);
  for (Route& route : all) route.response_types = {"text/plain"};
  return all;
}

}  // namespace

void take(std::string_view bytes) {
  static ServerShared shared({}, RouteTable(routes()), {});
  if (bytes.empty()) return;
  // The first byte draws the sizes of the pieces.
  const std::size_t most = std::size_t{1} << (static_cast<unsigned char>(bytes[0]) % 16U);
  std::string_view unsent = bytes.substr(1);

  IoThread thread(shared, 1);
  const auto connection =
      std::make_shared<MemoryConnection>(thread, Peer{.address = "127.0.0.1", .loopback = true});
  thread.add(connection, Place(shared.connections));
  connection->start();
  // Every step takes bytes or sends some: there are no more of them than bytes and answers.
  while (connection->step(unsent, most) || thread.context().poll() > 0) thread.context().restart();
  const std::string& sent = connection->sent();
  require(sent.empty() || (sent.starts_with("HTTP/1.1 ") && std::isdigit(sent[9]) != 0));
  connection->close();
}
