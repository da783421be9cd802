#include "http/engine/transports.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>

#include "base/folder.hpp"

namespace fitgauge::http {
namespace {

namespace ssl = asio::ssl;

/// Out of file descriptors, for example: the clients wait in the kernel's queue.
constexpr auto kRetry = std::chrono::milliseconds(100);

/// Bytes of one call of OpenSSL, which counts in int.
constexpr std::size_t kMostAtOnce = 1 << 20;

/// Tells clients which authorities a certificate may be of.
void name_authorities(SSL_CTX* context, const std::string& pem) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> text(
      BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), &BIO_free);
  while (X509* const authority = PEM_read_bio_X509(text.get(), nullptr, nullptr, nullptr)) {
    SSL_CTX_add_client_CA(context, authority);
    X509_free(authority);
  }
  ERR_clear_error();
}

Error cannot_listen(const ListenAddress& address, const error_code& error) {
  return Error::of(ErrorCode::ListenFailed, "cannot listen on {} port {}: {}", address.host,
                   address.port, error.message());
}

/// Opens and binds; the error has the failed step.
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

Result<std::shared_ptr<ssl::context>> load_tls(const TlsOptions& options) {
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  error_code error;
  const auto refuse = [](std::string_view what, const std::string& file, const std::string& why) {
    return Error{ErrorCode::ConfigInvalid,
                 fmt::format("the TLS {} {} cannot be used: {}", what, file, why), file};
  };
  const auto unreadable = [&](auto what, const auto& file, const Error& cause) {
    return refuse(what, file, cause.message);
  };
  const auto fail = [&](auto what, const auto& file) {
    return refuse(what, file, error.message());
  };
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_mode(context->native_handle(), SSL_MODE_RELEASE_BUFFERS |
                                                 SSL_MODE_ENABLE_PARTIAL_WRITE |
                                                 SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION);
  // OpenSSL would wait for a writer of a FIFO.
  const auto certificate = read_regular(options.certificate_file);
  if (!certificate) return unreadable("certificate", options.certificate_file, certificate.error());
  const auto key = read_regular(options.key_file);
  if (!key) return unreadable("key", options.key_file, key.error());
  context->use_certificate_chain(asio::buffer(*certificate), error);
  if (error) return fail("certificate", options.certificate_file);
  context->use_private_key(asio::buffer(*key), ssl::context::pem, error);
  if (error) return fail("key", options.key_file);
  if (!options.client_ca_file.empty()) {
    const auto authorities = read_regular(options.client_ca_file);
    if (!authorities) return unreadable("client CA", options.client_ca_file, authorities.error());
    context->add_certificate_authority(asio::buffer(*authorities), error);
    if (error) return fail("client CA", options.client_ca_file);
    name_authorities(context->native_handle(), *authorities);
    auto mode = ssl::verify_peer;
    if (options.require_client_certificate) mode |= ssl::verify_fail_if_no_peer_cert;
    context->set_verify_mode(mode);
    // Sessions are not resumed: a resumed one would skip the client's certificate.
    SSL_CTX_set_session_cache_mode(context->native_handle(), SSL_SESS_CACHE_OFF);
    SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_TICKET);
  }
  return context;
}

TlsConnection::TlsConnection(IoThread& thread, Peer peer, Socket socket,
                             const std::shared_ptr<ssl::context>& context)
    : Connection(thread, std::move(peer)), socket_(std::move(socket)), context_(context) {
  socket_.non_blocking(true);
}

template <class Step, class Done>
void TlsConnection::drive(Step step, Done done) {
  ERR_clear_error();
  const int result = step(session_.get());
  const int reason = SSL_get_error(session_.get(), result);
  if (reason == SSL_ERROR_WANT_READ || reason == SSL_ERROR_WANT_WRITE) {
    const auto ready = reason == SSL_ERROR_WANT_READ ? Socket::wait_read : Socket::wait_write;
    return socket_.async_wait(
        ready, [this, self = shared_from_this(), step, done](const error_code& error) {
          if (error) return done(error, 0);
          drive(step, done);
        });
  }
  const bool done_well = result > 0;
  asio::post(socket_.get_executor(), [self = shared_from_this(), done, done_well, result] {
    done(done_well ? error_code() : asio::error::eof,
         done_well ? static_cast<std::size_t>(result) : 0);
  });
}

void TlsConnection::await_record(std::size_t awaited) {
  std::array<unsigned char, SSL3_RT_HEADER_LENGTH> head{};  // RFC 8446, 5.1: type, version, length
  error_code error;
  const std::size_t read = socket_.receive(asio::buffer(head), Socket::message_peek, error);
  if (error && error != asio::error::would_block) return close();
  std::size_t record = head.size();
  if (read == head.size()) record += std::size_t{head[3]} * 256 + head[4];
  const bool possible =
      read == 0 || (head[0] == SSL3_RT_HANDSHAKE && record <= SSL3_RT_MAX_PACKET_SIZE);
  const std::size_t come = socket_.available(error);
  const bool waits = possible && come >= awaited && (read < head.size() || come < record);
  socket_.set_option(Socket::receive_low_watermark(waits ? static_cast<int>(record) : 1), error);
  if (!waits) return shake_hands();  // even at the end of the input: OpenSSL then refuses it
  const auto ready = [this, self = shared_from_this(), record](const error_code& failed) {
    if (failed || !fitgauge::guarded("a handshake", [&] { await_record(record); })) close();
  };
  socket_.async_wait(Socket::wait_read, ready);
}

void TlsConnection::shake_hands() {
  session_.reset(SSL_new(context_->native_handle()));
  if (session_ == nullptr) throw std::bad_alloc();
  SSL_set_fd(session_.get(), socket_.native_handle());
  drive([](SSL* session) { return SSL_accept(session); },
        [this](const error_code& error, std::size_t) { error ? close() : begin(); });
}

void TlsConnection::read_some(std::span<char> room) {
  drive(
      [room](SSL* session) {
        return SSL_read(session, room.data(), static_cast<int>(std::min(room.size(), kMostAtOnce)));
      },
      [this](const error_code& error, std::size_t count) { on_read(error, count); });
}

void TlsConnection::write_some(std::string_view bytes) {
  drive(
      [bytes](SSL* session) {
        return SSL_write(session, bytes.data(),
                         static_cast<int>(std::min(bytes.size(), kMostAtOnce)));
      },
      [this](const error_code& error, std::size_t count) { on_write(error, count); });
}

void TlsConnection::end_gracefully() {
  drive(
      [](SSL* session) {
        const int sent = SSL_shutdown(session);
        return sent == 0 ? SSL_shutdown(session) : sent;
      },
      [this](const error_code&, std::size_t) { close(); });
}

void PlainConnection::read_some(std::span<char> room) {
  socket_.async_read_some(
      asio::buffer(room.data(), room.size()),
      [this, self = shared_from_this()](const error_code& error, std::size_t count) {
        on_read(error, count);
      });
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

Listener::Listener(std::vector<IoThread*> threads, Deliver deliver)
    : threads_(std::move(threads)),
      deliver_(std::move(deliver)),
      acceptor_(threads_.front()->context()),
      retry_(threads_.front()->context()) {}

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
  if (error) return cannot_listen(address, error);
  return listener;
}

void Listener::accept() {
  acceptor_.async_accept([this](const error_code& error, Socket socket) {
    if (!acceptor_.is_open()) return;
    if (!error) {
      // Out of memory: drops this client; the next one may stay.
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
