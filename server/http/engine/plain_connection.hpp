#pragma once

#include "http/engine/asio.hpp"
#include "http/engine/connection.hpp"

namespace fitgauge::http {

/// A connection over TCP alone. Owns the socket, which is non-blocking.
class PlainConnection final : public Connection {
 public:
  PlainConnection(IoThread& thread, Peer peer, Socket socket)
      : Connection(thread, std::move(peer)), socket_(std::move(socket)) {}

  void start() override { begin(); }

 private:
  void read_some(std::span<char> room) override;
  std::size_t read_now(std::span<char> room, error_code& error) override;
  bool has_unread() const noexcept override;
  std::size_t write_now(std::string_view bytes, bool& broken) override;
  void write_some(std::string_view bytes) override;
  void end_gracefully() override;
  void close_socket() noexcept override;

  Socket socket_;
};

}  // namespace fitgauge::http
