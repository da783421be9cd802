#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "http/engine/asio.hpp"

namespace fitgauge::mtconnect {

/// What an agent may hold and how long it may take.
struct SessionOptions {
  std::size_t full = std::size_t{256} << 10;  ///< bytes that wait for it; then others wait as well
  std::chrono::milliseconds longest_full = std::chrono::seconds(10);
  std::chrono::milliseconds heartbeat = std::chrono::seconds(10);  ///< as PONG asks for
};

/// One agent that reads lines. Used on the thread of its socket.
class AgentSession : public std::enable_shared_from_this<AgentSession> {
 public:
  /// @param ended once, with the reason; empty: the agent hung up.
  /// @param has_room again, after it was full.
  struct Hooks {
    std::function<void(const std::shared_ptr<AgentSession>&, std::string_view why)> ended;
    std::function<void()> has_room;
  };

  AgentSession(http::Socket socket, std::string peer, const SessionOptions& options, Hooks hooks);
  AgentSession(const AgentSession&) = delete;
  AgentSession& operator=(const AgentSession&) = delete;

  /// Begins to read what the agent says: `* PING` gets its `* PONG`, anything else is passed over.
  void start();
  /// A line with its end, or several.
  void send(std::shared_ptr<const std::string> lines);
  /// More waits for it than it should: send nothing more until has_room.
  bool is_full() const { return waiting_bytes_ > options_.full; }
  /// Closes the socket.
  void end(std::string_view why);
  const std::string& peer() const { return peer_; }

 private:
  void read();
  /// Takes whole lines from what was read.
  void take_lines();
  void write();
  void written(std::size_t bytes);
  void expect_sign_of_life();

  http::Socket socket_;
  const std::string peer_;
  const SessionOptions options_;
  const Hooks hooks_;
  std::string input_{};
  std::deque<std::shared_ptr<const std::string>> waiting_{};
  std::size_t waiting_bytes_ = 0;
  http::Timer full_;
  http::Timer silence_;
  bool has_ended_ = false;
};

}  // namespace fitgauge::mtconnect
