#include "http/client/http_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <boost/asio/ip/network_v6.hpp>

#include "base/folder.hpp"

namespace fitgauge {

std::optional<std::chrono::seconds> retry_after(std::string_view line) {
  constexpr std::string_view kName = "Retry-After:";
  if (!ascii_iequals(line.substr(0, kName.size()), kName)) return std::nullopt;
  std::string_view value = trim(line.substr(kName.size()));
  while (value.ends_with('\n') || value.ends_with('\r')) value.remove_suffix(1);
  const auto seconds = read_number<int>(value);
  if (!seconds || *seconds < 0) return std::nullopt;
  return std::chrono::seconds(*seconds);
}

}  // namespace fitgauge

namespace fitgauge::http_client {
namespace {

namespace ip = boost::asio::ip;

constexpr const char* kPrivate[] = {
    "::ffff:0.0.0.0/104",      // this network
    "::ffff:10.0.0.0/104",     // private
    "::ffff:100.64.0.0/106",   // shared between providers
    "::ffff:127.0.0.0/104",    // loopback
    "::ffff:169.254.0.0/112",  // link-local
    "::ffff:172.16.0.0/108",   // private
    "::ffff:192.0.0.0/120",    // protocols
    "::ffff:192.168.0.0/112",  // private
    "::ffff:198.18.0.0/111",   // benchmarks
    "::ffff:224.0.0.0/99",     // multicast, reserved, broadcast
    "fc00::/7",                // unique local
    "fe80::/10",               // link-local
    "fec0::/10",               // site-local, deprecated
    "ff00::/8",                // multicast
    "100::/64",                // discard
    "64:ff9b:1::/48",          // translation inside of a network
};

/// Networks, and the place of an address of IPv4 in an address of each.
constexpr std::pair<const char*, std::size_t> kEmbedded4[] = {
    {"::/96", 12},         // ::, ::1 and ::a.b.c.d
    {"64:ff9b::/96", 12},  // translated
    {"2002::/16", 2},      // 6to4
};

bool is_in(const ip::address_v6& address, const char* network) {
  const auto of = ip::make_network_v6(network);
  return ip::network_v6(address, of.prefix_length()).canonical() == of;
}

bool is_private(const ip::address_v6& address) {
  const auto has = [&address](const char* network) { return is_in(address, network); };
  if (std::ranges::any_of(kPrivate, has)) return true;
  for (const auto& [network, offset] : kEmbedded4) {
    if (!has(network)) continue;
    const auto bytes = address.to_bytes();
    ip::address_v4::bytes_type inner;
    std::copy_n(bytes.data() + offset, inner.size(), inner.begin());
    return is_private(ip::make_address_v6(ip::v4_mapped, ip::address_v4(inner)));
  }
  return false;
}

constexpr long kConnectSeconds = 10;

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

CurlHandle::~CurlHandle() {
  curl_easy_cleanup(curl_);
  curl_slist_free_all(headers_);
}

void CurlHandle::begin(const std::string& url, const std::string& method,
                       std::span<const std::string> headers, std::string_view body) {
  curl_easy_reset(curl_);  // the options, not the connection
  curl_slist_free_all(std::exchange(headers_, nullptr));
  headers_ = curl_slist_append(headers_, "Expect:");
  for (const std::string& line : headers) headers_ = curl_slist_append(headers_, line.c_str());
  retry_after_.reset();
  error_.front() = '\0';
  set_text(CURLOPT_URL, url);
  set_text(CURLOPT_CUSTOMREQUEST, method);
  set(CURLOPT_PROTOCOLS_STR, "http,https");
  set(CURLOPT_USERAGENT, "fitgauge/" FITGAUGE_VERSION);
  set(CURLOPT_NOSIGNAL, 1L);
  set(CURLOPT_HTTPHEADER, headers_);
  set(CURLOPT_HEADERFUNCTION, &take_header);
  set(CURLOPT_HEADERDATA, this);
  set(CURLOPT_ERRORBUFFER, error_.data());
  if (method == "GET") return;
  set(CURLOPT_POSTFIELDS, body.data() == nullptr ? "" : body.data());
  set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
}

std::size_t CurlHandle::take_header(char* data, std::size_t, std::size_t size, void* handle) {
  if (const auto wait = fitgauge::retry_after({data, size}))
    static_cast<CurlHandle*>(handle)->retry_after_ = *wait;
  return size;
}

bool is_private_address(const sockaddr& address) {
  if (address.sa_family == AF_INET) {
    sockaddr_in v4;
    std::memcpy(&v4, &address, sizeof v4);
    const ip::address_v4 read(ntohl(v4.sin_addr.s_addr));
    return is_private(ip::make_address_v6(ip::v4_mapped, read));
  }
  if (address.sa_family != AF_INET6) return true;
  sockaddr_in6 v6;
  std::memcpy(&v6, &address, sizeof v6);
  ip::address_v6::bytes_type bytes;
  std::memcpy(bytes.data(), &v6.sin6_addr, bytes.size());
  return is_private(ip::address_v6(bytes));
}

/// The resolved address counts, not the name: a name may change its mind between two looks.
curl_socket_t HttpClient::open_socket(void* client, curlsocktype, curl_sockaddr* address) {
  auto& self = *static_cast<HttpClient*>(client);
  if (!self.options_.may_reach_private && is_private_address(address->addr)) {
    self.has_refused_ = true;
    return CURL_SOCKET_BAD;
  }
  return socket(address->family, address->socktype | SOCK_CLOEXEC, address->protocol);
}

HttpAnswer HttpClient::call(const HttpCall& call, const std::function<bool()>& goes_on) {
  CurlHandle& handle = handle_;
  HttpAnswer answer;
  TakenBody body{.text = answer.body, .longest = call.longest_answer};
  handle.begin(call.url, call.method, call.headers, call.body);
  handle.set(CURLOPT_QUICK_EXIT, 1L);  // a name that is looked up yet holds up no end
  if (!options_.may_ask_proxy) handle.set(CURLOPT_PROXY, "");
  if (!options_.authorities.empty()) {
    const auto authorities = read_regular(options_.authorities);
    if (!authorities) {
      return {.failure = fmt::format("cannot read {}: {}", options_.authorities,
                                     authorities.error().message)};
    }
    curl_blob blob{.data = const_cast<char*>(authorities->data()),
                   .len = authorities->size(),
                   .flags = CURL_BLOB_COPY};
    handle.set(CURLOPT_CAINFO_BLOB, &blob);
  }
  handle.set(CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  handle.set(CURLOPT_TIMEOUT, static_cast<long>(call.timeout.count()));
  handle.set(CURLOPT_OPENSOCKETFUNCTION, &open_socket);
  handle.set(CURLOPT_OPENSOCKETDATA, this);
  handle.set(CURLOPT_NOPROGRESS, 0L);
  handle.set(CURLOPT_XFERINFOFUNCTION, &look_around);
  handle.set(CURLOPT_XFERINFODATA, &goes_on);
  handle.set(CURLOPT_WRITEFUNCTION, &take_body);
  handle.set(CURLOPT_WRITEDATA, &body);
  has_refused_ = false;

  const CURLcode code = handle.perform();
  answer.retry_after = handle.retry_after();
  if (code == CURLE_OK) {
    answer.status = handle.status();
    return answer;
  }
  answer.failure = handle.reason(code);
  if (has_refused_) {
    answer.failure =
        "the address belongs to this machine or a private network: set allow_private_addresses in "
        "the configuration to allow it";
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
    return "the address must be such as https://host/path";
  }
  const std::string scheme = part(CURLUPART_SCHEME);
  if (scheme != "https" && scheme != "http")
    return "the address must begin with https:// or http://";
  if (!part(CURLUPART_USER).empty() || !part(CURLUPART_PASSWORD).empty())
    return "the address must not contain a name or password: the signature identifies the sender";
  return std::nullopt;
}

}  // namespace fitgauge::http_client
