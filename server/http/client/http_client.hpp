#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::http_client {

struct HttpClientOptions {
  bool may_reach_private = true;  ///< addresses of this machine and its networks
  bool may_ask_proxy = false;     ///< the one that the environment names
  std::string authorities{};      ///< PEM file; the system's when empty
};

/// What is asked for. The views need to last for the call alone.
struct HttpCall {
  std::string method = "POST";
  std::string url{};                   ///< http:// or https://
  std::vector<std::string> headers{};  ///< `Name: value`
  std::string_view body{};             ///< sent with every method but GET
  std::chrono::seconds timeout{15};    ///< all in all
  std::size_t longest_answer = 0;      ///< bytes of its body; 0: it is dropped
};

struct HttpAnswer {
  long status = 0;        ///< 0: there was none
  std::string body{};     ///< where some of it is taken
  std::string failure{};  ///< why there was no answer
  std::optional<std::chrono::seconds> retry_after{};
};

/// Calls others over a connection that is kept (libcurl). Follows no redirection and checks
/// certificates. For one thread.
class HttpClient {
 public:
  explicit HttpClient(HttpClientOptions options);
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Waits. @param goes_on asked some times a second meanwhile; false gives up.
  HttpAnswer call(const HttpCall& call, const std::function<bool()>& goes_on);

 private:
  struct Handle;
  const HttpClientOptions options_;
  std::unique_ptr<Handle> handle_;
};

/// Why a text is no address to call; none: it is one.
std::optional<std::string> fault_of_url(const std::string& url);

}  // namespace fitgauge::http_client
