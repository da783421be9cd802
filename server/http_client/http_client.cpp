#include "http_client/http_client.hpp"

#include <arpa/inet.h>
#include <curl/curl.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <array>

#include "base/retry_after.hpp"
#include "http_client/address_check.hpp"

namespace fitgauge::http_client {

/// What an address must pass.
struct AddressGate {
  bool may_reach_private = false;
  bool has_refused = false;
};

namespace {

constexpr long kConnectSeconds = 10;

struct HeaderList {
  HeaderList() = default;
  HeaderList(const HeaderList&) = delete;
  HeaderList& operator=(const HeaderList&) = delete;
  ~HeaderList() { curl_slist_free_all(first); }
  void add(const std::string& line) { first = curl_slist_append(first, line.c_str()); }

  curl_slist* first = nullptr;
};

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

std::size_t take_header(char* data, std::size_t, std::size_t size, void* user) {
  if (const auto wait = retry_after({data, size}))
    static_cast<HttpAnswer*>(user)->retry_after = *wait;
  return size;
}

int look_around(void* user, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  return (*static_cast<const std::function<bool()>*>(user))() ? 0 : 1;
}

}  // namespace

struct HttpClient::Handle {
  Handle() : curl(curl_easy_init()) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { curl_easy_cleanup(curl); }

  template <class Value>
  void set(CURLoption option, Value value) {
    curl_easy_setopt(curl, option, value);
  }

  CURL* curl;
  AddressGate gate{};
  std::array<char, CURL_ERROR_SIZE> error{};
};

HttpClient::HttpClient(HttpClientOptions options)
    : options_(std::move(options)), handle_(std::make_unique<Handle>()) {
  handle_->gate.may_reach_private = options_.may_reach_private;
}
HttpClient::~HttpClient() = default;

HttpAnswer HttpClient::call(const HttpCall& call, const std::function<bool()>& goes_on) {
  Handle& handle = *handle_;
  curl_easy_reset(handle.curl);  // the options, not the connection
  HttpAnswer answer;
  TakenBody body{.text = answer.body, .longest = call.longest_answer};
  HeaderList headers;
  headers.add("Expect:");  // no question whether the body is welcome
  for (const std::string& line : call.headers) headers.add(line);
  handle.set(CURLOPT_URL, call.url.c_str());
  handle.set(CURLOPT_PROTOCOLS_STR, "http,https");
  handle.set(CURLOPT_USERAGENT, "fitgauge/" FITGAUGE_VERSION);
  handle.set(CURLOPT_NOSIGNAL, 1L);
  handle.set(CURLOPT_QUICK_EXIT, 1L);  // a name that is looked up yet holds up no end
  if (!options_.may_ask_proxy) handle.set(CURLOPT_PROXY, "");
  if (!options_.authorities.empty()) handle.set(CURLOPT_CAINFO, options_.authorities.c_str());
  handle.set(CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  handle.set(CURLOPT_TIMEOUT, static_cast<long>(call.timeout.count()));
  handle.set(CURLOPT_OPENSOCKETFUNCTION, &open_socket);
  handle.set(CURLOPT_OPENSOCKETDATA, &handle.gate);
  handle.set(CURLOPT_NOPROGRESS, 0L);
  handle.set(CURLOPT_XFERINFOFUNCTION, &look_around);
  handle.set(CURLOPT_XFERINFODATA, &goes_on);
  handle.set(CURLOPT_WRITEFUNCTION, &take_body);
  handle.set(CURLOPT_WRITEDATA, &body);
  handle.set(CURLOPT_HEADERFUNCTION, &take_header);
  handle.set(CURLOPT_HEADERDATA, &answer);
  handle.set(CURLOPT_ERRORBUFFER, handle.error.data());
  handle.set(CURLOPT_HTTPHEADER, headers.first);
  if (std::string_view(call.method) != "GET") {
    handle.set(CURLOPT_CUSTOMREQUEST, call.method);
    handle.set(CURLOPT_POSTFIELDS, call.body.data());
    handle.set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(call.body.size()));
  }
  handle.error.front() = '\0';
  handle.gate.has_refused = false;

  const CURLcode code = curl_easy_perform(handle.curl);
  curl_easy_getinfo(handle.curl, CURLINFO_RESPONSE_CODE, &answer.status);
  if (code == CURLE_OK) return answer;
  answer.status = 0;
  answer.failure = handle.error.front() == '\0' ? curl_easy_strerror(code) : handle.error.data();
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
