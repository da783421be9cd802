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
}

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

}  // namespace fitgauge::cli
