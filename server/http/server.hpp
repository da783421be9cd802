#pragma once

#include "http/route.hpp"

namespace fitgauge::http {

struct ListenAddress {
  std::string host;  ///< a numeric address: `127.0.0.1`, `::1`, `0.0.0.0`
  std::uint16_t port = 0;
  /// Without TLS, for health checks on this machine: the guard allows only health routes.
  bool health_only = false;

  bool is_loopback() const;
  /// The address to reach it here: `127.0.0.1:8286` for 0.0.0.0, `[::1]:8286` for ::.
  std::string own_address() const;
};

/// Reads `127.0.0.1:8286`, `[::1]:8286` or `localhost:8286` (127.0.0.1).
/// @errors ConfigInvalid
Result<ListenAddress> parse_listen_address(std::string_view text);

/// Checks that this machine lets the process listen there. A port in use passes: it may be our own.
/// @errors ListenFailed
Result<void> check_listen(const ListenAddress& address);

struct TlsOptions {
  std::string certificate_file;  ///< PEM, the chain
  std::string key_file;          ///< PEM
  std::string client_ca_file{};  ///< PEM; empty: clients are not asked for a certificate
  bool require_client_certificate = false;
};

/// Checks that a server can start with these files: they can be read, and key and certificate
/// match.
/// @errors ConfigInvalid naming the file.
Result<void> check_tls(const TlsOptions& options);

struct ServerOptions {
  std::vector<ListenAddress> listen{};
  unsigned io_threads = 1;
  /// Connections above this number are answered with 503 and closed.
  std::size_t max_connections = 1024;
  /// Bytes of large bodies in memory at once, in all connections together. A body waits for its
  /// share. Under pressure, a silent sender loses its share. A body without a length that grows
  /// beyond 1 MiB uses the limit of its route.
  std::size_t body_budget = std::size_t{64} << 20;
  /// Folder for bodies whose route spools them; empty: they stay in memory.
  std::string spool_folder{};
  /// Maximum number of unsent bytes of all connections together. Above it, answers end that have
  /// waited longer than `unsent_time`, the oldest first: active readers finish in that time. Memory
  /// that several answers share does not count.
  std::size_t unsent_budget = std::size_t{64} << 20;
  std::chrono::milliseconds unsent_time = std::chrono::seconds(10);
  /// A sender that is silent for this time loses its share when others wait for memory.
  std::chrono::milliseconds stall_time = std::chrono::seconds(1);
  std::chrono::milliseconds header_timeout = std::chrono::seconds(10);
  std::chrono::milliseconds request_timeout = std::chrono::seconds(30);  ///< header and body
  std::chrono::milliseconds idle_timeout = std::chrono::seconds(30);
  std::chrono::milliseconds write_timeout = std::chrono::seconds(30);  ///< if the reader stalls
  /// Longest time that stop() waits for requests in flight.
  std::chrono::milliseconds drain_timeout = std::chrono::seconds(7);
  std::optional<TlsOptions> tls{};
  /// Origins whose pages may use the service (CORS), as browsers send them: `https://mes.example`.
  std::vector<std::string> allowed_origins{};
};

/// One request that ended, for logs and metrics.
struct FinishedRequest {
  const Request& request;  ///< head and caller; the body is gone
  std::string_view route;  ///< the pattern, or empty when none was found
  std::string_view method;
  int status = 0;                 ///< 0: none was sent
  bool broken_off = false;        ///< the connection ended before the answer did
  std::int64_t microseconds = 0;  ///< from its first byte until its answer is handed to the socket
  std::uint64_t bytes_received = 0;
  std::uint64_t bytes_sent = 0;
};

struct ServerHooks {
  /// Makes the document of an error. `status` is set if the engine itself refuses; otherwise the
  /// code of the handler's or guard's error decides. Without this hook: plain text.
  std::function<Response(const Error& error, std::optional<int> status, const Request& request)>
      format_error{};
  /// Runs before parameters and body are read. A response or an error is the answer.
  std::function<Result<std::optional<Response>>(Request& request, const Route& route)> guard{};
  /// Asked a few times a second while a body streams: false ends it; the caller may not read on.
  std::function<bool(const Request&)> may_continue{};
  std::function<void(const FinishedRequest&)> finished{};
  /// Reports the text of a handler's exception. The client got 500 with the request's id.
  std::function<void(const Request&, std::string_view what)> handler_threw{};
};

struct ServerCounters {
  std::uint64_t connections_open = 0;
  std::uint64_t connections_refused = 0;  ///< beyond max_connections
  std::uint64_t requests = 0;
  std::uint64_t body_bytes_in_flight = 0;
};

/// Owns the listening sockets, the I/O threads and every connection. Hooks and handlers run on the
/// I/O threads; the member functions may be called from any thread.
class Server {
 public:
  /// Binds, listens and starts the threads.
  /// @errors ListenFailed with the address and the reason, ConfigInvalid for unusable certificates.
  static Result<std::unique_ptr<Server>> start(ServerOptions options, RouteTable routes,
                                               ServerHooks hooks);
  /// Stops; every Responder must be gone.
  ~Server();
  Server& operator=(Server&&) = delete;  // neither copied nor moved

  /// Returns the ports in the order of ServerOptions::listen: the actual ones for port 0.
  const std::vector<std::uint16_t>& ports() const;

  ServerCounters counters() const;

  /// Reads the certificate files again; open connections keep theirs.
  /// @errors ConfigInvalid: the old ones stay in use.
  Result<void> reload_tls();

  /// Stops accepting, closes idle connections, waits for requests in flight (at most drain_timeout;
  /// streams are cut), closes the rest and ends the I/O threads. After it returns, nothing calls a
  /// handler, a hook or a stream. Later answers are dropped.
  void stop();

 private:
  class Impl;
  explicit Server(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace fitgauge::http
