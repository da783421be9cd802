#include "daemon/healthcheck.hpp"

#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <memory>

namespace fitgauge::daemon {
namespace {

constexpr std::string_view kRequest =
    "GET /readyz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";

using Bio = std::unique_ptr<BIO, decltype(&BIO_free_all)>;
using SslContext = std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)>;

/// The loopback address of the port the service listens on: it may listen on every address.
std::string own_address(const std::string& listen) {
  const std::size_t colon = listen.rfind(':');
  const std::string host = listen.substr(0, colon);
  const bool any = host.empty() || host == "0.0.0.0" || host == "[::]" || host == "*";
  return (any ? "127.0.0.1" : host) + listen.substr(colon);
}

void limit_waiting(BIO* connection) {
  const int socket = static_cast<int>(BIO_get_fd(connection, nullptr));
  const timeval limit{.tv_sec = 3, .tv_usec = 0};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
}

}  // namespace

Result<void> healthcheck(const Config& config) {
  const auto failed = [](std::string what) { return Error{ErrorCode::NotReady, std::move(what)}; };
  const std::string address = own_address(config.listen.front());

  const SslContext context(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  const bool tls = !config.tls_cert.empty();
  // The certificate is the service's own and names the address of the outside: it is not verified.
  const Bio connection(tls ? BIO_new_ssl_connect(context.get()) : BIO_new(BIO_s_connect()),
                       &BIO_free_all);
  if (!connection || BIO_set_conn_hostname(connection.get(), address.c_str()) <= 0 ||
      BIO_do_connect(connection.get()) <= 0) {
    return failed("nothing listens on " + address);
  }
  limit_waiting(connection.get());
  if (BIO_write(connection.get(), kRequest.data(), static_cast<int>(kRequest.size())) <= 0) {
    return failed("cannot write to " + address);
  }
  char answer[64] = {};
  const int length = BIO_read(connection.get(), answer, sizeof answer);
  const std::string_view text(answer, length > 0 ? static_cast<std::size_t>(length) : 0);
  const std::string_view line = text.substr(0, text.find('\r'));
  if (!line.starts_with("HTTP/1.1 200")) {
    return failed(line.empty() ? "no answer from " + address
                               : fmt::format("{} answered '{}'", address, line));
  }
  return {};
}

}  // namespace fitgauge::daemon
