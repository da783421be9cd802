#include "http/engine/listener.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/guarded.hpp"

namespace fitgauge::http {

namespace {
/// Out of file descriptors, say: the clients wait in the kernel's queue meanwhile.
constexpr auto kRetry = std::chrono::milliseconds(100);
}  // namespace

Listener::Listener(std::vector<IoThread*> threads, Deliver deliver)
    : threads_(std::move(threads)),
      deliver_(std::move(deliver)),
      acceptor_(threads_.front()->context()),
      retry_(threads_.front()->context()) {}

namespace {

Error cannot_listen(const ListenAddress& address, const error_code& error) {
  return {ErrorCode::ListenFailed, fmt::format("Cannot listen on {} port {}: {}.", address.host,
                                               address.port, error.message())};
}

/// Opens and binds; the error tells what failed.
error_code bind(Acceptor& acceptor, const ListenAddress& address) {
  error_code error;
  const auto ip = asio::ip::make_address(address.host, error);
  const asio::ip::tcp::endpoint endpoint(ip, address.port);
  if (!error) acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(Acceptor::reuse_address(true), error);
  if (!error && ip.is_v6()) acceptor.set_option(asio::ip::v6_only(true), error);
  if (!error) acceptor.bind(endpoint, error);
  return error;
}

}  // namespace

Result<void> check_listen(const ListenAddress& address) {
  asio::io_context context;
  Acceptor acceptor(context);
  const error_code error = bind(acceptor, address);
  if (error && error != asio::error::address_in_use) return cannot_listen(address, error);
  return {};
}

Result<std::unique_ptr<Listener>> Listener::open(const ListenAddress& address,
                                                 std::vector<IoThread*> threads, Deliver deliver) {
  std::unique_ptr<Listener> listener(new Listener(std::move(threads), std::move(deliver)));
  listener->health_only_ = address.health_only;
  Acceptor& acceptor = listener->acceptor_;
  error_code error = bind(acceptor, address);
  if (!error) acceptor.listen(Acceptor::max_listen_connections, error);
  if (!error) listener->port_ = acceptor.local_endpoint(error).port();
  if (error) {
    return cannot_listen(address, error);
  }
  return listener;
}

void Listener::close() {
  error_code ignored;
  acceptor_.close(ignored);
  retry_.cancel();
}

void Listener::accept() {
  acceptor_.async_accept([this](const error_code& error, Socket socket) {
    if (!acceptor_.is_open()) return;
    if (!error) {
      // Out of memory: this client goes, the next one may stay.
      guarded("a new connection", [&] { deal(std::move(socket)); });
      return accept();
    }
    retry_.expires_after(kRetry);
    retry_.async_wait([this](const error_code& cancelled) {
      if (!cancelled && acceptor_.is_open()) accept();
    });
  });
}

void Listener::deal(Socket socket) {
  IoThread& thread = *threads_[next_];
  next_ = (next_ + 1) % threads_.size();
  error_code gone;  // a client that has left already shows at the first read
  const asio::ip::address address = socket.remote_endpoint(gone).address();
  deliver_(thread, std::move(socket),
           {.address = address.to_string(),
            .loopback = address.is_loopback(),
            .health_only = health_only_});
}

}  // namespace fitgauge::http
