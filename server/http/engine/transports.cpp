#include "http/engine/transports.hpp"

#include <fmt/format.h>
#include <openssl/ssl.h>

#include <string>
#include <utility>

namespace fitgauge::http {
namespace {

namespace ssl = asio::ssl;

}  // namespace

Result<std::shared_ptr<ssl::context>> load_tls(const TlsOptions& options) {
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  error_code error;
  const auto fail = [&](std::string_view what, const std::string& file) {
    return Error{ErrorCode::ConfigInvalid,
                 fmt::format("The TLS {} {} cannot be used: {}.", what, file, error.message()),
                 file};
  };
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_mode(context->native_handle(), SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION);
  context->use_certificate_chain_file(options.certificate_file, error);
  if (error) return fail("certificate", options.certificate_file);
  context->use_private_key_file(options.key_file, ssl::context::pem, error);
  if (error) return fail("key", options.key_file);
  if (!options.client_ca_file.empty()) {
    context->load_verify_file(options.client_ca_file, error);
    if (error) return fail("client CA", options.client_ca_file);
    SSL_CTX_set_client_CA_list(context->native_handle(),
                               SSL_load_client_CA_file(options.client_ca_file.c_str()));
    auto mode = ssl::verify_peer;
    if (options.require_client_certificate) mode |= ssl::verify_fail_if_no_peer_cert;
    context->set_verify_mode(mode);
    // Sessions are not resumed: a resumed one would skip the client's certificate.
    SSL_CTX_set_session_cache_mode(context->native_handle(), SSL_SESS_CACHE_OFF);
    SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_TICKET);
  }
  return context;
}

void TlsConnection::start() {
  stream_.async_handshake(ssl::stream_base::server,
                          [this, self = shared_from_this()](const error_code& error) {
                            if (error) return close();
                            begin();
                          });
}

void TlsConnection::read_some(std::span<char> room) {
  stream_.async_read_some(
      asio::buffer(room.data(), room.size()),
      [this, self = shared_from_this()](const error_code& error, std::size_t count) {
        on_read(error, count);
      });
}

bool TlsConnection::has_unread() const noexcept {
  error_code ignored;
  return stream_.lowest_layer().available(ignored) > 0;
}

void TlsConnection::write_some(std::string_view bytes) {
  stream_.async_write_some(
      asio::buffer(bytes.data(), bytes.size()),
      [this, self = shared_from_this()](const error_code& error, std::size_t count) {
        on_write(error, count);
      });
}

void TlsConnection::end_gracefully() {
  stream_.async_shutdown([this, self = shared_from_this()](const error_code&) { close(); });
}

void TlsConnection::close_socket() noexcept {
  error_code ignored;
  stream_.lowest_layer().close(ignored);
}

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
