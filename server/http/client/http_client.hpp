#pragma once

#include <curl/curl.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge {

/// The wait that a line of an HTTP head asks for (RFC 9110, 10.2.3); none of another field, or
/// where it is a date.
std::optional<std::chrono::seconds> retry_after(std::string_view line);

}  // namespace fitgauge

namespace fitgauge::http_client {

/// A handle of libcurl, whose connection is kept between calls. For one thread.
class CurlHandle {
 public:
  CurlHandle() : curl_(curl_easy_init()) {}
  ~CurlHandle();
  CurlHandle& operator=(CurlHandle&&) = delete;  // neither copied nor moved

  /// Begins a call with the options of a new handle: http and https alone, no redirection, no
  /// question whether a large body is welcome. The body, sent with every method but GET, and what
  /// set() is given stay where they are until perform() returns.
  /// @param headers `Name: value`
  void begin(const std::string& url, const std::string& method,
             std::span<const std::string> headers, std::string_view body);
  template <class Value>
  void set(CURLoption option, Value value) {
    curl_easy_setopt(curl_, option, value);
  }
  void set_text(CURLoption option, const std::string& value) {
    if (!value.empty()) set(option, value.c_str());
  }

  CURLcode perform() { return curl_easy_perform(curl_); }

  long status() const;  ///< 0 before the answer has begun
  std::string content_type() const;
  std::optional<std::chrono::seconds> retry_after() const { return retry_after_; }
  std::string reason(CURLcode code) const;

 private:
  static std::size_t take_header(char* data, std::size_t, std::size_t size, void* handle);

  CURL* curl_;
  curl_slist* headers_ = nullptr;
  std::optional<std::chrono::seconds> retry_after_;
  std::array<char, CURL_ERROR_SIZE> error_{};
};

/// Whether an address leads no further than this machine, its networks or a provider's inside:
/// loopback, private, link-local, shared, multicast, reserved, and IPv6 forms that hold one of IPv4
/// (RFC 6890 with its registries). What is neither IPv4 nor IPv6 is private.
bool is_private_address(const sockaddr& address);

struct HttpClientOptions {
  bool may_reach_private = true;  ///< addresses of this machine and its networks
  bool may_ask_proxy = false;     ///< the one that the environment names
  std::string authorities{};      ///< PEM file; the system's when empty
};

/// The request. The views must outlive the call.
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
  HttpClient& operator=(HttpClient&&) = delete;  // neither copied nor moved

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
