#pragma once

#include <openssl/ssl.h>

#include <boost/asio/ssl/context.hpp>

#include "http/engine/connection.hpp"

namespace fitgauge::http {

/// Makes a context with the certificate, the key and the checks of clients.
/// @errors ConfigInvalid with the file that cannot be used.
Result<std::shared_ptr<asio::ssl::context>> load_tls(const TlsOptions& options);

/// A connection over TLS 1.2 or later. It has no session of OpenSSL (37 KB) before the client's
/// first record is whole. OpenSSL works on the socket itself: Asio's stream keeps 68 KB of buffers
/// for each connection, also for one that never ends its handshake. The program must ignore
/// SIGPIPE.
class TlsConnection final : public Connection {
 public:
  TlsConnection(IoThread& thread, Peer peer, Socket socket,
                const std::shared_ptr<asio::ssl::context>& context);

  void start() override { await_record(0); }

 private:
  void read_some(std::span<char> room) override;
  bool has_unread() const noexcept override {
    error_code ignored;
    return SSL_has_pending(session_.get()) == 1 || socket_.available(ignored) > 0;
  }
  std::size_t write_now(std::string_view, bool&) override { return 0; }
  void write_some(std::string_view bytes) override;
  void end_gracefully() override;
  void close_socket() noexcept override {
    error_code ignored;
    socket_.close(ignored);
  }

  /// Calls `step` again each time the socket is ready, until OpenSSL waits no more. `done` gets the
  /// error and the bytes, never inside drive().
  template <class Step, class Done>
  void drive(Step step, Done done);

  /// Shakes hands when the client's first record is whole. `awaited`: bytes that must have come
  /// since the last check, or the client has stopped sending.
  void await_record(std::size_t awaited);
  void shake_hands();

  Socket socket_;
  std::shared_ptr<asio::ssl::context> context_;
  std::unique_ptr<SSL, decltype(&SSL_free)> session_{nullptr, &SSL_free};  ///< none before
};

/// A connection over plain TCP. Owns the socket, which is non-blocking.
class PlainConnection final : public Connection {
 public:
  PlainConnection(IoThread& thread, Peer peer, Socket socket)
      : Connection(thread, std::move(peer)), socket_(std::move(socket)) {}

  void start() override { begin(); }

 private:
  void read_some(std::span<char> room) override;
  std::size_t read_now(std::span<char> room, error_code& error) override {
    return socket_.read_some(asio::buffer(room.data(), room.size()), error);
  }
  bool has_unread() const noexcept override {
    error_code ignored;
    return socket_.available(ignored) > 0;
  }
  std::size_t write_now(std::string_view bytes, bool& broken) override;
  void write_some(std::string_view bytes) override;
  void end_gracefully() override {
    error_code ignored;
    socket_.shutdown(Socket::shutdown_send, ignored);
    read_more();
  }
  void close_socket() noexcept override {
    error_code ignored;
    socket_.close(ignored);
  }

  Socket socket_;
};

/// One listening socket, served by the first I/O thread, that deals its connections to all threads
/// in turn. Belongs to that thread after start().
class Listener {
 public:
  /// Called on the first I/O thread with a new connected socket, for the given thread.
  using Deliver = std::function<void(IoThread&, Socket, Peer)>;

  /// Binds and listens.
  /// @errors ListenFailed with the address and the system's reason.
  static Result<std::unique_ptr<Listener>> open(const ListenAddress& address,
                                                std::vector<IoThread*> threads, Deliver deliver);

  std::uint16_t port() const { return port_; }
  void start() { accept(); }
  void close() {
    error_code ignored;
    acceptor_.close(ignored);
    retry_.cancel();
  }

 private:
  Listener(std::vector<IoThread*> threads, Deliver deliver);
  void accept();
  void deal(Socket socket);

  std::vector<IoThread*> threads_;
  Deliver deliver_;
  Acceptor acceptor_;
  Timer retry_;
  std::uint16_t port_ = 0;
  std::size_t next_ = 0;
  bool health_only_ = false;
};

}  // namespace fitgauge::http
