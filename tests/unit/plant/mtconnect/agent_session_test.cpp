#include "plant/mtconnect/agent_session.hpp"

#include <doctest/doctest.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>

namespace fitgauge::mtconnect {
namespace {

using namespace std::chrono_literals;
using http::asio::ip::tcp;

/// A session and the agent at its other end.
struct Connected {
  explicit Connected(const SessionOptions& options) {
    tcp::acceptor acceptor(io, {http::asio::ip::address_v4::loopback(), 0});
    agent.connect(acceptor.local_endpoint());
    http::Socket accepted(io);
    acceptor.accept(accepted);
    session = std::make_shared<AgentSession>(
        std::move(accepted), "agent",
        AgentSession::Hooks{
            .ended = [this](const auto&, std::string_view why) { ended = std::string(why); },
            .has_room = [] {}},
        options);
    session->start();
  }

  void say(std::string_view text) { http::asio::write(agent, http::asio::buffer(text)); }
  /// @returns what the agent has got up to a line's end.
  std::string line() {
    while (agent.available() == 0 && !ended) io.run_one_for(1s);
    http::error_code error;
    const std::size_t count =
        http::asio::read_until(agent, http::asio::dynamic_buffer(heard), '\n', error);
    const std::string taken = heard.substr(0, count);
    heard.erase(0, count);
    return taken;
  }

  http::asio::io_context io{};
  tcp::socket agent{io};
  std::shared_ptr<AgentSession> session;
  std::optional<std::string> ended;  ///< why
  std::string heard;
};

TEST_CASE("an agent that has pinged and is silent for three heartbeats is sent away") {
  Connected connected({.heartbeat = 10ms});
  connected.say("* PING\n");
  CHECK(connected.line() == "* PONG 10\n");
  connected.io.run_for(20s);  // returns when nothing is left to wait for
  CHECK(connected.ended == "its heartbeat has stopped");
}

TEST_CASE("one that never pings stays, as does one whose next ping is not due yet") {
  Connected silent({.heartbeat = 10ms});
  silent.say("* ADAPTER\n");
  silent.io.run_for(200ms);
  CHECK_FALSE(silent.ended.has_value());
  Connected pinging({.heartbeat = 1h});
  pinging.say("* PI");
  pinging.say("NG\r\n");
  CHECK(pinging.line() == "* PONG 3600000\n");
  CHECK_FALSE(pinging.ended.has_value());
}

TEST_CASE("one that sends no lines is sent away") {
  Connected connected({});
  connected.say(std::string(4096, 'x'));
  connected.io.run_for(20s);
  CHECK(connected.ended == "it sends no lines");
}

TEST_CASE("one that does not read is sent away") {
  Connected connected({.full = 1024, .longest_full = 50ms});
  // More than both kernels' buffers take.
  const auto lines = std::make_shared<const std::string>(std::size_t{64} << 20, 'x');
  connected.session->send(lines);
  CHECK(connected.session->is_full());
  connected.io.run_for(20s);
  CHECK(connected.ended == "the agent does not read its lines");
}

}  // namespace
}  // namespace fitgauge::mtconnect
