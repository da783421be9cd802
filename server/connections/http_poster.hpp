#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::connections {

struct HttpPosterOptions {
  std::string url{};                 ///< http:// or https://
  std::chrono::seconds timeout{15};  ///< of a request, all in all
  bool may_reach_private = false;    ///< addresses of this machine and its networks
};

struct HttpAnswer {
  long status = 0;  ///< 0: there was none
  std::string failure{};
  std::optional<std::chrono::seconds> retry_after{};
};

/// Posts JSON to one address over a connection that is kept (libcurl). Follows no redirection, asks
/// no proxy, checks certificates by the system's authorities, reads no more of an answer than its
/// header. For one thread.
class HttpPoster {
 public:
  explicit HttpPoster(HttpPosterOptions options);
  ~HttpPoster();
  HttpPoster(const HttpPoster&) = delete;
  HttpPoster& operator=(const HttpPoster&) = delete;

  /// Waits; ends within a second after a stop.
  /// @param headers `Name: value`
  HttpAnswer post(const std::vector<std::string>& headers, std::string_view body,
                  const std::stop_token& stop);

 private:
  struct Handle;
  const HttpPosterOptions options_;
  std::unique_ptr<Handle> handle_;
};

/// Why a text is no address to post to; none: it is one.
std::optional<std::string> fault_of_url(const std::string& url);

}  // namespace fitgauge::connections
