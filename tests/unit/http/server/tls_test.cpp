#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>

#include "test_server.hpp"
#include "tls_files.hpp"

using namespace fitgauge;
using namespace fitgauge::http;
using namespace fitgauge::http::test;

namespace {

struct TlsAnswer {
  std::string server_name;  ///< of the server's certificate
  std::string bytes;        ///< everything up to the end of the connection
  bool ended_cleanly = false;
};

std::string common_name(X509* certificate) {
  std::array<char, 64> text{};
  X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName, text.data(),
                            static_cast<int>(text.size()));
  return text.data();
}

/// One connection: sends, reads to the end. Empty when the handshake fails.
TlsAnswer ask(std::uint16_t port, std::string_view request, const TlsFiles* identity = nullptr) {
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()),
                                                                  &SSL_CTX_free);
  if (identity != nullptr) {
    SSL_CTX_use_certificate_file(context.get(), identity->certificate().c_str(), SSL_FILETYPE_PEM);
    SSL_CTX_use_PrivateKey_file(context.get(), identity->key().c_str(), SSL_FILETYPE_PEM);
  }
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const timeval patience{.tv_sec = 60, .tv_usec = 0};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);

  TlsAnswer answer;
  const std::unique_ptr<SSL, decltype(&SSL_free)> session(SSL_new(context.get()), &SSL_free);
  SSL_set_fd(session.get(), socket);
  if (SSL_connect(session.get()) == 1) {
    const std::unique_ptr<X509, decltype(&X509_free)> peer(SSL_get1_peer_certificate(session.get()),
                                                           &X509_free);
    answer.server_name = common_name(peer.get());
    SSL_write(session.get(), request.data(), static_cast<int>(request.size()));
    std::array<char, 16384> bytes;
    int count = 0;
    while ((count = SSL_read(session.get(), bytes.data(), static_cast<int>(bytes.size()))) > 0) {
      answer.bytes.append(bytes.data(), static_cast<std::size_t>(count));
    }
    answer.ended_cleanly = SSL_get_error(session.get(), count) == SSL_ERROR_ZERO_RETURN;
  }
  ::close(socket);
  return answer;
}

std::vector<Route> tls_routes() {
  return {answering("/who",
                    [](const Request& request) -> Result<Response> {
                      return Response(200, "text/plain", "I am " + request.own_origin());
                    }),
          answering("/large", [](const Request&) -> Result<Response> {
            return Response(200, "text/plain", std::string(1'000'000, 'x'));
          })};
}

ServerOptions with(TlsOptions tls) { return {.tls = std::move(tls)}; }

const std::string kLast = "Connection: close\r\n";

}  // namespace

TEST_CASE("requests are served over TLS and the connection ends cleanly") {
  const TlsFiles files("gauge-1");
  TestServer server(tls_routes(), with({files.certificate(), files.key()}));
  const TlsAnswer answer = ask(server.port(), get("/who") + get("/who", kLast));
  CHECK(answer.server_name == "gauge-1");
  CHECK(answer.ended_cleanly);
  const std::size_t first = answer.bytes.find("I am https://test");
  REQUIRE(first != std::string::npos);
  CHECK(answer.bytes.find("I am https://test", first + 1) != std::string::npos);
  CHECK(ask(server.port(), get("/large", kLast)).bytes.size() > 1'000'000);
}

TEST_CASE("a plain client on a TLS port harms nobody") {
  const TlsFiles files("gauge-1");
  TestServer server(tls_routes(), with({files.certificate(), files.key()}));
  Client plain = server.connect();
  plain.send(get("/who"));
  plain.read_to_end();
  CHECK(ask(server.port(), get("/who", kLast)).ended_cleanly);
}

TEST_CASE("a client certificate is taken when its issuer is trusted") {
  const TlsFiles files("gauge-1");
  const TlsFiles press("press-3");
  const TlsFiles stranger("stranger");
  TlsOptions options{files.certificate(), files.key(), press.certificate(), false};
  {
    TestServer server(tls_routes(), with(options));
    CHECK(ask(server.port(), get("/who", kLast), &press).bytes.find("I am") != std::string::npos);
    CHECK(ask(server.port(), get("/who", kLast)).bytes.find("I am") != std::string::npos);
    CHECK(ask(server.port(), get("/who", kLast), &stranger).bytes.empty());
  }
  options.require_client_certificate = true;
  TestServer server(tls_routes(), with(options));
  CHECK(ask(server.port(), get("/who", kLast), &press).bytes.find("I am") != std::string::npos);
  CHECK(ask(server.port(), get("/who", kLast)).bytes.empty());
}

TEST_CASE("new certificate files are used after reload_tls, unusable ones are not") {
  const TlsFiles files("old");
  TestServer server(tls_routes(), with({files.certificate(), files.key()}));
  files.renew("new");
  CHECK(ask(server.port(), get("/who", kLast)).server_name == "old");
  CHECK(server.server().reload_tls().has_value());
  CHECK(ask(server.port(), get("/who", kLast)).server_name == "new");
  std::ofstream(files.key()) << "not a key";
  const auto reloaded = server.server().reload_tls();
  CHECK(reloaded.error().code == ErrorCode::ConfigInvalid);
  CHECK(reloaded.error().message.find(files.key()) != std::string::npos);
  CHECK(ask(server.port(), get("/who", kLast)).server_name == "new");
}

TEST_CASE("a server whose certificate cannot be read does not start") {
  CHECK(Server::start(with({"/nonexistent.pem", "/nonexistent.pem"}), RouteTable({}), {})
            .has_error());
}
