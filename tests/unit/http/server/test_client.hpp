#pragma once

namespace fitgauge::http::test {

/// One answer as it came over the wire.
struct Answer {
  int status = 0;    ///< 0: the server closed instead
  std::string head;  ///< status line and fields
  std::string body;  ///< chunks joined

  /// The value of a field, case-insensitive, or empty.
  std::string field(std::string_view name) const;
};

/// A raw TCP client on the loopback that sends exactly the bytes it is given. Every wait ends after
/// a minute, so that a server that hangs fails a test instead of stopping it.
class Client {
 public:
  explicit Client(std::uint16_t port);
  ~Client();
  Client(Client&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Client& operator=(Client&&) = delete;

  /// @returns false when the server has closed.
  bool send(std::string_view bytes) const;
  void shut_down_send() const;

  /// The next answer; `head_only` for the answer to HEAD.
  Answer read(bool head_only = false);
  /// Sends and reads one answer.
  Answer ask(std::string_view bytes, bool head_only = false);
  /// Whatever comes until the server closes.
  std::string read_to_end();
  /// Whatever has come so far, after waiting for at least one byte (or the end).
  std::string read_some();
  /// The server closes without sending anything more.
  bool is_closed_by_server();

 private:
  bool receive();

  int socket_ = -1;
  std::string buffer_;
};

}  // namespace fitgauge::http::test
