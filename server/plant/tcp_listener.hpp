#pragma once

#include "base/thread.hpp"
#include "http/engine/asio.hpp"

namespace fitgauge::connections {

/// A port whose clients are all served by one thread.
class TcpListener {
 public:
  using Take = std::function<void(http::Socket client, const std::string& peer)>;

  /// @param place of the thread. @param border names the calls of `take` in reports of bugs. Both
  /// are literals. @param take gets each client and its address, on the thread.
  TcpListener(std::string_view place, std::string_view border, Take take)
      : place_(place), border_(border), take_(std::move(take)) {}
  TcpListener& operator=(TcpListener&&) = delete;  // neither copied nor moved
  ~TcpListener() { stop(); }

  /// Binds, listens and starts the thread. @param host a numeric address. @param purpose follows
  /// the address in the error. @errors ListenFailed.
  Result<void> open(const std::string& host, std::uint16_t port, std::string_view purpose = "") {
    http::error_code error;
    const auto address = http::asio::ip::make_address(host, error);
    const http::asio::ip::tcp::endpoint endpoint(address, port);
    if (!error) acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(http::Acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(http::asio::socket_base::max_listen_connections, error);
    if (!error) port_ = acceptor_.local_endpoint(error).port();
    if (error) {
      return Error{ErrorCode::ListenFailed, fmt::format("cannot listen on {} port {}{}: {}", host,
                                                        port, purpose, error.message())};
    }
    thread_ = Thread(place_, [this](const auto&) {
      if (!is_waiting_) accept();  // at the start, and when an exception left nothing to wait for
      io_.run();
    });
    return {};
  }

  /// Ends the thread; what it waits for is dropped.
  void stop() {
    io_.stop();
    thread_.stop();
  }

  http::asio::io_context& io() { return io_; }
  /// The actual port if 0 was requested.
  std::uint16_t port() const { return port_; }

 private:
  void accept() {
    acceptor_.async_accept(peer_, [this](http::error_code error, http::Socket client) {
      is_waiting_ = false;
      if (!error) {
        // Missing memory here must not end the acceptance of clients.
        guarded(border_, [&] { take_(std::move(client), peer_.address().to_string()); });
        return accept();
      }
      // Out of descriptors, for example: clients wait in the kernel's queue for this time.
      pause_.expires_after(std::chrono::milliseconds(100));
      pause_.async_wait([this](http::error_code cancelled) {
        if (!cancelled) accept();
      });
      is_waiting_ = true;
    });
    is_waiting_ = true;
  }

  const std::string_view place_;
  const std::string_view border_;
  const Take take_;
  std::uint16_t port_ = 0;
  http::asio::io_context io_{1};
  http::Acceptor acceptor_{io_};
  http::Timer pause_{io_};
  http::asio::ip::tcp::endpoint peer_;
  bool is_waiting_ = false;  ///< for a client, or for the end of a pause
  Thread thread_;
};

}  // namespace fitgauge::connections
