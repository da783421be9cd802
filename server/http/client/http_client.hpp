#pragma once

#include <curl/curl.h>
#include <sys/socket.h>

namespace fitgauge {

/// The wait that a line of a head requests (RFC 9110, 10.2.3); none for another field or a date.
std::optional<std::chrono::seconds> retry_after(std::string_view line);

}  // namespace fitgauge

namespace fitgauge::http_client {

/// A handle of libcurl, which keeps its connection between calls. Used by one thread.
class CurlHandle {
 public:
  CurlHandle() : curl_(curl_easy_init()) {}
  ~CurlHandle();
  CurlHandle& operator=(CurlHandle&&) = delete;  // neither copied nor moved

  /// Begins a call with the options of a new handle: only http and https, no redirection, no Expect
  /// for a large body. The body, sent with every method but GET, and the values of set() must stay
  /// in place until perform() returns.
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

  /// 0 before the answer has begun
  long status() const {
    long status = 0;
    curl_easy_getinfo(curl_, CURLINFO_RESPONSE_CODE, &status);
    return status;
  }
  std::string content_type() const {
    const char* type = nullptr;
    curl_easy_getinfo(curl_, CURLINFO_CONTENT_TYPE, &type);
    return type == nullptr ? "" : type;
  }
  std::optional<std::chrono::seconds> retry_after() const { return retry_after_; }
  std::string reason(CURLcode code) const {
    return error_.front() == '\0' ? curl_easy_strerror(code) : error_.data();
  }

 private:
  static std::size_t take_header(char* data, std::size_t, std::size_t size, void* handle);

  CURL* curl_;
  curl_slist* headers_ = nullptr;
  std::optional<std::chrono::seconds> retry_after_;
  std::array<char, CURL_ERROR_SIZE> error_{};
};

/// Whether an address is of this machine, its networks or a provider's network: loopback, private,
/// link-local, shared, multicast, reserved, and IPv6 forms with such an IPv4 address (RFC 6890 with
/// its registries). An address that is neither IPv4 nor IPv6 is private.
bool is_private_address(const sockaddr& address);

struct HttpClientOptions {
  bool may_reach_private = true;  ///< addresses of this machine and its networks
  bool may_ask_proxy = false;     ///< the proxy that the environment names
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
  std::string body{};     ///< if a part is read
  std::string failure{};  ///< why there was no answer
  std::optional<std::chrono::seconds> retry_after{};
};

/// Calls other servers over a connection that it keeps (libcurl). Follows no redirection and checks
/// certificates. Used by one thread.
class HttpClient {
 public:
  explicit HttpClient(HttpClientOptions options) : options_(std::move(options)) {}

  /// Blocks. @param goes_on called some times a second; false ends the call.
  HttpAnswer call(const HttpCall& call, const std::function<bool()>& goes_on);

 private:
  static curl_socket_t open_socket(void* client, curlsocktype, curl_sockaddr* address);

  const HttpClientOptions options_;
  CurlHandle handle_;
  bool has_refused_ = false;  ///< an address of this call
};

/// Returns the fault of a text as an address to call; none if it is one.
std::optional<std::string> fault_of_url(const std::string& url);

}  // namespace fitgauge::http_client
