#pragma once

#include <boost/asio/write.hpp>

#include "http/engine/asio.hpp"

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

  AgentSession(http::Socket socket, std::string peer, Hooks hooks, SessionOptions options = {})
      : socket_(std::move(socket)),
        peer_(std::move(peer)),
        options_(options),
        hooks_(std::move(hooks)),
        full_(socket_.get_executor()),
        silence_(socket_.get_executor()) {}
  AgentSession& operator=(AgentSession&&) = delete;  // neither copied nor moved

  /// Reads the agent's lines: `* PING` gets its `* PONG`, other lines are ignored.
  void start() { read(); }
  /// A line with its end, or several.
  void send(std::shared_ptr<const std::string> lines) {
    if (has_ended_) return;
    const bool was_full = is_full();
    waiting_bytes_ += lines->size();
    waiting_.push_back(std::move(lines));
    if (!was_full && is_full()) {
      full_.expires_after(options_.longest_full);
      full_.async_wait([weak = weak_from_this()](http::error_code error) {
        const auto self = weak.lock();
        if (!error && self) self->end("the agent does not read its lines");
      });
    }
    if (waiting_.size() == 1) write();
  }
  /// Returns whether too much waits for it: send nothing more until has_room.
  bool is_full() const { return waiting_bytes_ > options_.full; }
  /// Closes the socket.
  void end(std::string_view why) {
    if (std::exchange(has_ended_, true)) return;
    full_.cancel();
    silence_.cancel();
    http::error_code ignored;
    socket_.close(ignored);
    hooks_.ended(shared_from_this(), why);
  }

  const std::string& peer() const { return peer_; }

 private:
  /// Bytes of a line that an agent sends; a command has a few words.
  static constexpr std::size_t kLongestLine = 1024;
  /// An agent that has begun to ping is lost after this number of missing pings.
  static constexpr int kMissingPings = 3;

  void read() {
    constexpr std::size_t kPiece = 512;
    const std::size_t kept = input_.size();
    input_.resize(kept + kPiece);
    socket_.async_read_some(
        http::asio::buffer(input_.data() + kept, kPiece),
        [self = shared_from_this(), kept](http::error_code error, std::size_t count) {
          if (self->has_ended_) return;
          if (error) return self->end("");
          self->input_.resize(kept + count);
          self->take_lines();
          if (self->input_.size() > kLongestLine) return self->end("it sends no lines");
          if (!self->has_ended_) self->read();
        });
  }
  /// Removes whole lines from the input.
  void take_lines() {
    std::size_t from = 0;
    for (std::size_t end = 0; (end = input_.find('\n', from)) != input_.npos; from = end + 1) {
      const std::string_view line = std::string_view(input_).substr(from, end - from);
      if (!line.starts_with("* PING")) continue;
      // A client that sends without reading gets no endless answers.
      if (is_full()) continue;
      send(std::make_shared<const std::string>(
          fmt::format("* PONG {}\n", options_.heartbeat.count())));
      expect_sign_of_life();
    }
    input_.erase(0, from);
  }

  void write() {
    http::asio::async_write(socket_, http::asio::buffer(*waiting_.front()),
                            [self = shared_from_this()](http::error_code error, std::size_t) {
                              if (self->has_ended_) return;
                              if (error) return self->end("");
                              self->written(self->waiting_.front()->size());
                            });
  }

  void written(std::size_t bytes) {
    const bool was_full = is_full();
    waiting_bytes_ -= bytes;
    waiting_.pop_front();
    if (!waiting_.empty()) write();
    if (!was_full || is_full()) return;
    full_.cancel();
    hooks_.has_room();
  }

  void expect_sign_of_life() {
    silence_.expires_after(kMissingPings * options_.heartbeat);
    silence_.async_wait([weak = weak_from_this()](http::error_code error) {
      const auto self = weak.lock();
      if (!error && self) self->end("its heartbeat has stopped");
    });
  }

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
