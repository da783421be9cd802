#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <sys/socket.h>

#include "base/folder.hpp"
#include "plant/lsv2/link/link_server.hpp"
#include "plant/lsv2/link/messages.hpp"

using namespace fitgauge;
using namespace fitgauge::control_link;
using namespace std::string_literals;

namespace {

/// Answers the name of each telegram, but nothing to T_FD.
class Echo final : public Conversation {
 public:
  std::optional<Telegram> answer(const Telegram& telegram) override {
    if (telegram.name == EndOfData::kName) return std::nullopt;
    if (telegram.name == Logout::kName) throw std::runtime_error("a bug");
    return encode(MachineParameter{word(telegram.name)});
  }
  std::size_t buffer() const override { return kSmallestBuffer; }
};

/// A server, and why it sent clients away.
struct Served {
  explicit Served(LinkServerOptions options) {
    options.host = "127.0.0.1";
    server =
        LinkServer::start(std::move(options), {.converse = [] { return std::make_unique<Echo>(); },
                                               .sent_away =
                                                   [this](std::string_view, std::string_view why) {
                                                     const std::lock_guard lock(mutex);
                                                     reasons.emplace_back(why);
                                                   }})
            .value();
  }

  Descriptor connect() const {
    Descriptor client(socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(server->port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(client.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) ==
            0);
    return client;
  }

  std::vector<std::string> seen() {
    const std::lock_guard lock(mutex);
    return reasons;
  }

  std::mutex mutex;
  std::vector<std::string> reasons;
  std::unique_ptr<LinkServer> server;
};

void send_all(const Descriptor& client, const std::string& bytes) {
  REQUIRE(send(client.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
          static_cast<ssize_t>(bytes.size()));
}

/// All that comes until the server closes.
std::string read_to_end(const Descriptor& client) {
  std::string all;
  char bytes[512];
  for (ssize_t count = 0; (count = recv(client.get(), bytes, sizeof bytes, 0)) > 0;) {
    all.append(bytes, static_cast<std::size_t>(count));
  }
  return all;
}

}  // namespace

TEST_CASE("telegrams that come together are answered in their order") {
  Served served({});
  const Descriptor client = served.connect();
  send_all(client, "\0\0\0\0R_PR\0\0\0\0T_FD\0\0\0\0R_DI"s);
  shutdown(client.get(), SHUT_WR);
  CHECK(read_to_end(client) == "\0\0\0\5S_MCR_PR\0\0\0\0\5S_MCR_DI\0"s);
}

TEST_CASE("slow and silent clients end") {
  using std::chrono::milliseconds;
  SUBCASE("a telegram that stays short") {
    Served served({.telegram_timeout = milliseconds(20)});
    const Descriptor client = served.connect();
    send_all(client, "\0\0\0\0R_"s);
    CHECK(read_to_end(client).empty());
    CHECK(served.seen() == std::vector{"its telegram stays short"s});
  }
  SUBCASE("one that says nothing") {
    Served served({.idle_timeout = milliseconds(20)});
    const Descriptor client = served.connect();
    CHECK(read_to_end(client).empty());
    CHECK(served.seen() == std::vector{"the client was silent for too long"s});
  }
  SUBCASE("one too many") {
    Served served({.most_connections = 0});
    CHECK(read_to_end(served.connect()).empty());
    CHECK(served.seen() == std::vector{"too many clients are connected"s});
  }
  SUBCASE("one that is no client") {
    Served served({});
    const Descriptor client = served.connect();
    send_all(client, "GET / HTTP/1.1\r\n\r\n");
    CHECK(read_to_end(client).empty());
    CHECK(served.seen() == std::vector{"the client does not send telegrams"s});
  }
}

TEST_CASE("a bug in one conversation ends that one alone") {
  Served served({});
  const Descriptor well = served.connect();
  const Descriptor hit = served.connect();
  send_all(hit, "\0\0\0\0A_LO"s);
  CHECK(read_to_end(hit).empty());
  send_all(well, "\0\0\0\0R_PR"s);
  shutdown(well.get(), SHUT_WR);
  CHECK(read_to_end(well) == "\0\0\0\5S_MCR_PR\0"s);
}

TEST_CASE("a port in use is an error that names it") {
  Served served({});
  const auto second = LinkServer::start({.host = "127.0.0.1", .port = served.server->port()},
                                        {.converse = [] { return std::make_unique<Echo>(); }});
  CHECK(second.error().code == ErrorCode::ListenFailed);
}
