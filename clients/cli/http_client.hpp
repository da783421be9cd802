#pragma once

#include "cli/outcome.hpp"

namespace fitgauge::http_client {
class CurlHandle;
}  // namespace fitgauge::http_client

namespace fitgauge::cli {

/// Address of the service and credentials.
struct Connection {
  std::string url;                 ///< as service_url() gives it
  std::string key{};               ///< API key; empty: no key is sent
  std::string authority_file{};    ///< PEM; the system's authorities when empty
  std::string certificate_file{};  ///< PEM, of this client
  std::string certificate_key_file{};
};

/// One request. The body is not copied: it outlives the call.
struct Request {
  std::string method = "GET";
  std::string target;                  ///< path and query, after the address of the service
  std::vector<std::string> headers{};  ///< `Name: value`
  std::string content_type{};          ///< of the body; empty: not sent
  std::string_view body{};
};

struct Answer {
  long status = 0;
  std::string content_type{};
  std::optional<std::chrono::seconds> retry_after{};
  std::string body{};

  bool ok() const { return status >= 200 && status < 300; }
};

/// One connection to the service, kept alive between requests (libcurl; proxies from its
/// environment variables, but none to this machine). Used by one thread. After a failure the next
/// request connects again.
class HttpClient {
 public:
  explicit HttpClient(Connection connection);
  ~HttpClient();
  HttpClient(HttpClient&&) noexcept;
  HttpClient& operator=(HttpClient&&) noexcept;

  const std::string& url() const { return connection_.url; }

  /// @errors NoAnswer: not reached, cut off, or silent for two minutes.
  Outcome<Answer> send(const Request& request);

  /// Receives a piece of a body; returns false to end the stream.
  using Sink = std::function<bool(std::string_view)>;

  /// Passes the body of a successful response to `sink` as it arrives, without a time limit; any
  /// other response has its body. @errors NoAnswer: also if nothing arrived for 45 seconds.
  Outcome<Answer> stream(const Request& request, const Sink& sink);

 private:
  Outcome<Answer> perform(const Request& request, const Sink* sink);

  Connection connection_;
  std::unique_ptr<http_client::CurlHandle> handle_;
};

/// Delays before a request is sent again: 0.2 s, doubled each time up to 10 s, or as long as the
/// service requests, until the sum exceeds the budget.
class Backoff {
 public:
  using Milliseconds = std::chrono::milliseconds;

  explicit Backoff(std::chrono::seconds budget) : left_(budget) {}

  /// @param retry_after of the response. @returns nothing if the budget is used up.
  std::optional<Milliseconds> next(std::optional<std::chrono::seconds> retry_after);

 private:
  static constexpr Milliseconds kFirst{200};
  static constexpr Milliseconds kLongest{10'000};

  Milliseconds left_;
  Milliseconds delay_ = kFirst;
};

/// Called before each delay with its reason and length.
using RetryNotice = std::function<void(const Failure&, std::chrono::milliseconds)>;

std::string new_idempotency_key();

/// Sends a request that may be repeated (a GET, or one with an idempotency key) until it gets an
/// answer that is final. @errors NoAnswer, with the last reason, when the budget is used up.
Outcome<Answer> send_until_answered(HttpClient& client, const Request& request, Backoff backoff,
                                    const RetryNotice& notice);

}  // namespace fitgauge::cli
