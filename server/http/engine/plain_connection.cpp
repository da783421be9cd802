#include "http/engine/plain_connection.hpp"

namespace fitgauge::http {

void PlainConnection::read_some(std::span<char> room) {
  socket_.async_read_some(
      asio::buffer(room.data(), room.size()),
      [this, self = shared_from_this()](const error_code& error, std::size_t count) {
        on_read(error, count);
      });
}

std::size_t PlainConnection::read_now(std::span<char> room, error_code& error) {
  return socket_.read_some(asio::buffer(room.data(), room.size()), error);
}

bool PlainConnection::has_unread() const noexcept {
  error_code ignored;
  return socket_.available(ignored) > 0;
}

std::size_t PlainConnection::write_now(std::string_view bytes, bool& broken) {
  error_code error;
  const std::size_t count = socket_.write_some(asio::buffer(bytes.data(), bytes.size()), error);
  broken = error && error != asio::error::would_block && error != asio::error::try_again;
  return count;
}

void PlainConnection::write_some(std::string_view bytes) {
  socket_.async_write_some(
      asio::buffer(bytes.data(), bytes.size()),
      [this, self = shared_from_this()](const error_code& error, std::size_t count) {
        on_write(error, count);
      });
}

void PlainConnection::end_gracefully() {
  error_code ignored;
  socket_.shutdown(Socket::shutdown_send, ignored);
  read_more();
}

void PlainConnection::close_socket() noexcept {
  error_code ignored;
  socket_.close(ignored);
}

}  // namespace fitgauge::http
