#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/outcome.hpp"

namespace fitgauge::http_client {
class CurlHandle;
}  // namespace fitgauge::http_client

namespace fitgauge::cli {

/// Where the service is and how one shows who one is.
struct Connection {
  std::string url;                 ///< as service_url() gives it
  std::string key{};               ///< API key; empty sends none
  std::string authority_file{};    ///< PEM; the system's authorities when empty
  std::string certificate_file{};  ///< PEM, of this client
  std::string certificate_key_file{};
};

/// One request. The body is not copied: it outlives the call.
struct Request {
  std::string method = "GET";
  std::string target;                  ///< path and query, behind the address of the service
  std::vector<std::string> headers{};  ///< `Name: value`
  std::string content_type{};          ///< of the body; none is sent when empty
  std::string_view body{};
};

struct Answer {
  long status = 0;
  std::string content_type{};
  std::optional<std::chrono::seconds> retry_after{};
  std::string body{};

  bool ok() const { return status >= 200 && status < 300; }
};

/// One connection to the service, kept alive between requests (libcurl; proxies as its environment
/// variables say, but none to this machine). Not for several threads. After a failure the next
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

  /// Takes a piece of a body; false ends the stream.
  using Sink = std::function<bool(std::string_view)>;

  /// Gives the body of a good answer to `sink` as it comes, however long that takes; any other
  /// answer has its body. @errors NoAnswer: also when nothing came for 45 seconds.
  Outcome<Answer> stream(const Request& request, const Sink& sink);

 private:
  Outcome<Answer> perform(const Request& request, const Sink* sink);

  Connection connection_;
  std::unique_ptr<http_client::CurlHandle> handle_;
};

/// How long to wait before a request is sent again: 0.2 s, then twice as long each time up to 10 s,
/// or as long as the service says, until the waiting adds up to the budget.
class Backoff {
 public:
  using Milliseconds = std::chrono::milliseconds;

  explicit Backoff(std::chrono::seconds budget) : left_(budget) {}

  /// @param retry_after what the answer said. @returns nothing when the budget is used up.
  std::optional<Milliseconds> next(std::optional<std::chrono::seconds> retry_after);

 private:
  static constexpr Milliseconds kFirst{200};
  static constexpr Milliseconds kLongest{10'000};

  Milliseconds left_;
  Milliseconds delay_ = kFirst;
};

/// Told before each wait: why, and for how long.
using RetryNotice = std::function<void(const Failure&, std::chrono::milliseconds)>;

/// A new idempotency key.
std::string new_idempotency_key();

/// Sends a request that may be repeated (a GET, or one with an idempotency key) until it gets an
/// answer that is final. @errors NoAnswer, with the last reason, when the budget is used up.
Outcome<Answer> send_until_answered(HttpClient& client, const Request& request, Backoff backoff,
                                    const RetryNotice& notice);

}  // namespace fitgauge::cli
