#include "http/server.hpp"

#include <random>

#include "base/folder.hpp"
#include "http/engine/transports.hpp"

namespace fitgauge::http {
using TlsContext = std::shared_ptr<asio::ssl::context>;

class Server::Impl {
 public:
  Impl(ServerOptions options, RouteTable routes, ServerHooks hooks)
      : shared_(std::move(options), std::move(routes), std::move(hooks)) {}
  ~Impl() { stop(); }

  Result<void> open() {
    if (shared_.options.tls) tls_ = TRY(load_tls(*shared_.options.tls));
    std::random_device random;
    std::vector<IoThread*> threads;
    for (unsigned i = 0; i < std::max(1U, shared_.options.io_threads); ++i) {
      const std::uint64_t first_id = (std::uint64_t{random()} << 32) | random();
      threads_.push_back(std::make_unique<IoThread>(shared_, first_id));
      threads.push_back(threads_.back().get());
    }
    for (const ListenAddress& address : shared_.options.listen) {
      auto listener =
          Listener::open(address, threads, [this](IoThread& thread, Socket socket, Peer peer) {
            take(thread, std::move(socket), std::move(peer));
          });
      if (!listener) return std::move(listener).error();
      ports_.push_back((*listener)->port());
      listeners_.push_back(std::move(*listener));
    }
    for (const auto& listener : listeners_) listener->start();
    for (const auto& thread : threads_) thread->start();
    return {};
  }

  /// After it returns, no I/O thread calls a handler, a hook or a stream.
  void stop() {
    if (shared_.stopping.exchange(true) || threads_.empty()) return;
    // Each thread keeps a place until it has notified its connections, the first until all have.
    threads_.front()->post([this, first = Place(shared_.connections)] {
      for (const auto& listener : listeners_) listener->close();
      // Deals the sockets that are already accepted: later posts follow them.
      for (const auto& thread : threads_)
        thread->post([&each = *thread, place = Place(shared_.connections)] { each.drain(); });
    });
    shared_.connections.wait_until_empty(shared_.options.drain_timeout);
    for (const auto& thread : threads_) thread->join();
  }

  Result<void> reload_tls() {
    if (!shared_.options.tls) return {};
    auto context = TRY(load_tls(*shared_.options.tls));
    const std::lock_guard lock(tls_mutex_);
    tls_ = std::move(context);
    return {};
  }

  ServerCounters counters() const {
    ServerCounters counters{.connections_open = shared_.connections.inside(),
                            .connections_refused = refused_.load(std::memory_order_relaxed),
                            .body_bytes_in_flight = shared_.budgets.used()};
    for (const auto& thread : threads_) counters.requests += thread->requests();
    return counters;
  }

  const std::vector<std::uint16_t>& ports() const { return ports_; }

 private:
  void take(IoThread& thread, Socket socket, Peer peer) {
    if (shared_.connections.inside() >= shared_.options.max_connections) {
      refused_.fetch_add(1, std::memory_order_relaxed);
      return turn_away(std::move(socket), peer);
    }
    // Counted from here: its thread may be busy, and more connections arrive.
    Place place(shared_.connections);
    TlsContext tls;
    if (shared_.options.tls && !peer.health_only) {
      peer.tls = true;
      const std::lock_guard lock(tls_mutex_);
      tls = tls_;
    }
    // Asio's socket object belongs to one thread, so only the descriptor is passed.
    const auto protocol = socket.local_endpoint().protocol();
    thread.post([&thread, place = std::move(place), protocol,
                 descriptor = Descriptor(socket.release()), peer = std::move(peer),
                 tls = std::move(tls)]() mutable {
      if (thread.shared().stopping) return;
      Socket arrived(thread.context());
      arrived.assign(protocol, descriptor.get());
      descriptor.release();
      error_code gone;  // a client that has left already shows at the first read
      arrived.set_option(asio::ip::tcp::no_delay(true), gone);
      arrived.non_blocking(true, gone);
      std::shared_ptr<Connection> connection;
      if (tls) {
        connection = std::make_shared<TlsConnection>(thread, std::move(peer), std::move(arrived),
                                                     std::move(tls));
      } else {
        connection = std::make_shared<PlainConnection>(thread, std::move(peer), std::move(arrived));
      }
      thread.add(connection, std::move(place));
      connection->start();
    });
  }

  /// The largest number of connections is open: responds without reading a request, if no handshake
  /// is needed. On the first I/O thread.
  void turn_away(Socket socket, const Peer& peer) {
    if (shared_.options.tls) return;
    IoThread& thread = *threads_.front();
    RequestHead nothing_read;
    Exchange exchange(shared_.routes, shared_.hooks, shared_.options.allowed_origins, peer);
    Response response =
        exchange.refuse(nothing_read, thread.next_request_id(),
                        {503, ErrorCode::Overloaded,
                         "too many connections are open: close one, or try again soon"});
    std::string text;
    OutputQueue out(text);
    append_answer(out, response, exchange.form(false), thread.date());
    error_code ignored;
    socket.non_blocking(true, ignored);
    socket.write_some(asio::buffer(text), ignored);
    socket.shutdown(Socket::shutdown_send, ignored);
    // Unread bytes would turn the close into a reset, which can overtake the answer.
    std::array<char, 4096> unread;
    socket.read_some(asio::buffer(unread), ignored);
  }

  ServerShared shared_;
  std::vector<std::unique_ptr<IoThread>> threads_;
  std::vector<std::unique_ptr<Listener>> listeners_;
  std::vector<std::uint16_t> ports_;
  std::mutex tls_mutex_;
  TlsContext tls_;
  std::atomic<std::uint64_t> refused_{0};
};

Result<void> check_tls(const TlsOptions& options) {
  TRY(load_tls(options));
  return {};
}

Result<std::unique_ptr<Server>> Server::start(ServerOptions options, RouteTable routes,
                                              ServerHooks hooks) {
  auto impl = std::make_unique<Impl>(std::move(options), std::move(routes), std::move(hooks));
  TRY(impl->open());
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() = default;
const std::vector<std::uint16_t>& Server::ports() const { return impl_->ports(); }
ServerCounters Server::counters() const { return impl_->counters(); }
Result<void> Server::reload_tls() { return impl_->reload_tls(); }
void Server::stop() { impl_->stop(); }

bool ListenAddress::is_loopback() const {
  error_code error;
  const auto address = asio::ip::make_address(host, error);
  return !error && address.is_loopback();
}

std::string ListenAddress::own_address() const {
  error_code error;
  const auto address = asio::ip::make_address(host, error);
  if (error) return fmt::format("{}:{}", host, port);
  const std::string loopback = address.is_v6() ? "::1" : "127.0.0.1";
  const std::string& here = address.is_unspecified() ? loopback : host;
  if (address.is_v6()) return fmt::format("[{}]:{}", here, port);
  return fmt::format("{}:{}", here, port);
}

Result<ListenAddress> parse_listen_address(std::string_view text) {
  const Error malformed{ErrorCode::ConfigInvalid,
                        fmt::format("{} is not an address to listen on: give a numeric address and "
                                    "a port, such as 127.0.0.1:8286 or [::1]:8286",
                                    text)};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return malformed;
  std::string_view host = text.substr(0, colon);
  const std::string_view digits = text.substr(colon + 1);
  const bool is_bracketed = host.starts_with('[') && host.ends_with(']');
  if (is_bracketed) host = host.substr(1, host.size() - 2);

  ListenAddress address{.host = std::string(host == "localhost" ? "127.0.0.1" : host)};
  const auto port = read_number<std::uint16_t>(digits);
  if (!port) return malformed;
  address.port = *port;
  error_code error;
  const auto ip = asio::ip::make_address(address.host, error);
  if (error || ip.is_v6() != is_bracketed) return malformed;
  return address;
}

}  // namespace fitgauge::http
