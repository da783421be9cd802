#pragma once

#include "http/engine/asio.hpp"
#include "http/server.hpp"
#include "plant/mtconnect/mtconnect_document.hpp"

namespace fitgauge::mtconnect {

/// Bounds of an agent: memory and time.
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
  AgentSession& operator=(AgentSession&&) = delete;  // neither copied nor moved

  /// Reads the agent's lines: `* PING` gets its `* PONG`, other lines are ignored.
  void start() { read(); }
  /// A line with its end, or several.
  void send(std::shared_ptr<const std::string> lines);
  /// Returns whether too much waits for it: send nothing more until has_room.
  bool is_full() const { return waiting_bytes_ > options_.full; }
  /// Closes the socket.
  void end(std::string_view why);
  const std::string& peer() const { return peer_; }

 private:
  void read();
  /// Removes whole lines from the input.
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

namespace fitgauge::app {

// SHDR, which an adapter sends to an agent: `time|data item|value|data item|value` and a line end.
// The data items are those of the device Gauge, by their ids.

class EventService;
class MeasurementService;

}  // namespace fitgauge::app

namespace fitgauge::mtconnect {

std::string shdr_availability(Timestamp at);
/// The part and the feature, whose table has one entry.
std::string shdr_line(const app::Measurement& measurement);
std::string shdr_line(const Counts& counts, Timestamp at);

/// A text as a value between `|`: quoted if it has one or begins with a quote, without control
/// characters; UNAVAILABLE if it is absent.
std::string shdr_text(std::string_view text);

struct AdapterOptions {
  http::ListenAddress listen{};
  std::size_t most_agents = 16;  ///< further agents are closed at once
  SessionOptions session{};
  /// Reports an agent that was sent away: address and reason. On the adapter's thread.
  std::function<void(std::string_view peer, std::string_view why)> sent_away{};
};

/// Sends measurements to MTConnect agents as lines of SHDR. A new agent gets the newest measurement
/// and the counts, and then all stored measurements in order. It reads the log on its own thread
/// while an agent is connected; no writer waits for it.
class ShdrAdapter {
 public:
  /// @param measurements, events, clock outlive it. @errors ListenFailed
  static Result<std::unique_ptr<ShdrAdapter>> start(AdapterOptions options,
                                                    app::MeasurementService& measurements,
                                                    app::EventService& events, const Clock& clock);
  /// Closes every connection.
  ~ShdrAdapter();
  ShdrAdapter& operator=(ShdrAdapter&&) = delete;  // neither copied nor moved

  /// The actual port if 0 was requested.
  std::uint16_t port() const;

 private:
  class Loop;
  explicit ShdrAdapter(std::shared_ptr<Loop> loop);

  const std::shared_ptr<Loop> loop_;
};

}  // namespace fitgauge::mtconnect
