#pragma once

#include <curl/curl.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fitgauge::http_client {

/// A handle of libcurl, whose connection is kept between calls. For one thread.
class CurlHandle {
 public:
  CurlHandle() : curl_(curl_easy_init()) {}
  ~CurlHandle();
  CurlHandle(const CurlHandle&) = delete;
  CurlHandle& operator=(const CurlHandle&) = delete;

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

}  // namespace fitgauge::http_client
