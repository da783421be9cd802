#include "http/client/http_client.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>

#include "http/client/curl_handle.hpp"

namespace fitgauge::http_client {

/// What an address must pass.
struct AddressGate {
  bool may_reach_private = false;
  bool has_refused = false;
};

namespace {

constexpr long kConnectSeconds = 10;

/// The resolved address counts, not the name: a name may change its mind between two looks.
curl_socket_t open_socket(void* user, curlsocktype, curl_sockaddr* address) {
  auto& gate = *static_cast<AddressGate*>(user);
  if (!gate.may_reach_private && is_private_address(address->addr)) {
    gate.has_refused = true;
    return CURL_SOCKET_BAD;
  }
  return socket(address->family, address->socktype | SOCK_CLOEXEC, address->protocol);
}

struct TakenBody {
  std::string& text;
  std::size_t longest;
};

std::size_t take_body(char* data, std::size_t, std::size_t size, void* user) {
  const auto& body = *static_cast<const TakenBody*>(user);
  if (body.longest == 0) return size;
  if (body.text.size() + size > body.longest) return 0;
  body.text.append(data, size);
  return size;
}

int look_around(void* user, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  return (*static_cast<const std::function<bool()>*>(user))() ? 0 : 1;
}

}  // namespace

struct HttpClient::Handle : CurlHandle {
  AddressGate gate{};
};

HttpClient::HttpClient(HttpClientOptions options)
    : options_(std::move(options)), handle_(std::make_unique<Handle>()) {
  handle_->gate.may_reach_private = options_.may_reach_private;
}
HttpClient::~HttpClient() = default;

HttpAnswer HttpClient::call(const HttpCall& call, const std::function<bool()>& goes_on) {
  Handle& handle = *handle_;
  HttpAnswer answer;
  TakenBody body{.text = answer.body, .longest = call.longest_answer};
  handle.begin(call.url, call.method, call.headers, call.body);
  handle.set(CURLOPT_QUICK_EXIT, 1L);  // a name that is looked up yet holds up no end
  if (!options_.may_ask_proxy) handle.set(CURLOPT_PROXY, "");
  handle.set_text(CURLOPT_CAINFO, options_.authorities);
  handle.set(CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  handle.set(CURLOPT_TIMEOUT, static_cast<long>(call.timeout.count()));
  handle.set(CURLOPT_OPENSOCKETFUNCTION, &open_socket);
  handle.set(CURLOPT_OPENSOCKETDATA, &handle.gate);
  handle.set(CURLOPT_NOPROGRESS, 0L);
  handle.set(CURLOPT_XFERINFOFUNCTION, &look_around);
  handle.set(CURLOPT_XFERINFODATA, &goes_on);
  handle.set(CURLOPT_WRITEFUNCTION, &take_body);
  handle.set(CURLOPT_WRITEDATA, &body);
  handle.gate.has_refused = false;

  const CURLcode code = handle.perform();
  answer.retry_after = handle.retry_after();
  if (code == CURLE_OK) {
    answer.status = handle.status();
    return answer;
  }
  answer.failure = handle.reason(code);
  if (handle.gate.has_refused) {
    answer.failure =
        "its address is one of this machine or a private network: allow these by "
        "allow_private_addresses in the configuration of the service";
  }
  return answer;
}

std::optional<std::string> fault_of_url(const std::string& url) {
  const std::unique_ptr<CURLU, decltype(&curl_url_cleanup)> parsed(curl_url(), &curl_url_cleanup);
  const auto part = [&](CURLUPart which) {
    char* text = nullptr;
    if (curl_url_get(parsed.get(), which, &text, 0) != CURLUE_OK) return std::string();
    std::string copy(text);
    curl_free(text);
    return copy;
  };
  if (curl_url_set(parsed.get(), CURLUPART_URL, url.c_str(), 0) != CURLUE_OK) {
    return "this is no address: write https://host/path";
  }
  const std::string scheme = part(CURLUPART_SCHEME);
  if (scheme != "https" && scheme != "http") return "an address begins with https:// or http://";
  if (!part(CURLUPART_USER).empty() || !part(CURLUPART_PASSWORD).empty()) {
    return "an address holds no name and password: the signature says who sends";
  }
  return std::nullopt;
}

}  // namespace fitgauge::http_client
