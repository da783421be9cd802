#include "cli/http_client.hpp"

#include <curl/curl.h>
#include <fmt/format.h>

#include <array>

#include "base/retry_after.hpp"
#include "cli/address.hpp"

namespace fitgauge::cli {
namespace {

constexpr long kConnectSeconds = 5;
constexpr long kAnswerSeconds = 120;
constexpr long kSilenceSeconds = 45;  // the service sends a sign of life every 15 s
constexpr long kUploadBuffer = 512L * 1024;
constexpr const char* kUserAgent = "fitgauge/" FITGAUGE_VERSION;

struct HeaderList {
  HeaderList() = default;
  HeaderList(const HeaderList&) = delete;
  HeaderList& operator=(const HeaderList&) = delete;
  ~HeaderList() { curl_slist_free_all(first); }
  void add(const std::string& line) { first = curl_slist_append(first, line.c_str()); }

  curl_slist* first = nullptr;
};

/// Where the pieces of the answer that is being read go.
struct Reading {
  CURL* curl;
  Answer answer{};
  const HttpClient::Sink* sink;
  bool ended_by_sink = false;
};

/// What to do about a connection that did not come about.
std::string_view advice_for(CURLcode code) {
  switch (code) {
    case CURLE_PEER_FAILED_VERIFICATION:
      return "name the authority of its certificate with --ca, or its right name with --server";
    case CURLE_SSL_CACERT_BADFILE: return "--ca takes a PEM file with certificates";
    case CURLE_SSL_CERTPROBLEM:
      return "--cert and --cert-key take this client's certificate and its key as PEM files";
    case CURLE_SSL_CONNECT_ERROR:
      return "does it speak TLS there, and does it want a certificate (--cert, --cert-key)?";
    default: return "start fitgauged there, or name another address with --server";
  }
}

std::size_t take_body(char* data, std::size_t, std::size_t size, void* user) {
  auto& reading = *static_cast<Reading*>(user);
  if (reading.answer.status == 0) {
    curl_easy_getinfo(reading.curl, CURLINFO_RESPONSE_CODE, &reading.answer.status);
  }
  if (reading.sink == nullptr || !reading.answer.ok()) {
    reading.answer.body.append(data, size);
    return size;
  }
  if ((*reading.sink)({data, size})) return size;
  reading.ended_by_sink = true;
  return CURL_WRITEFUNC_ERROR;
}

std::size_t take_header(char* data, std::size_t, std::size_t size, void* user) {
  if (const auto wait = retry_after({data, size}))
    static_cast<Reading*>(user)->answer.retry_after = *wait;
  return size;
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
  void set_text(CURLoption option, const std::string& value) {
    if (!value.empty()) set(option, value.c_str());
  }

  CURL* curl;
  std::array<char, CURL_ERROR_SIZE> error{};
};

HttpClient::HttpClient(Connection connection)
    : connection_(std::move(connection)), handle_(std::make_unique<Handle>()) {}
HttpClient::~HttpClient() = default;
HttpClient::HttpClient(HttpClient&&) noexcept = default;
HttpClient& HttpClient::operator=(HttpClient&&) noexcept = default;

Outcome<Answer> HttpClient::send(const Request& request) { return perform(request, nullptr); }

Outcome<Answer> HttpClient::stream(const Request& request, const Sink& sink) {
  return perform(request, &sink);
}

Outcome<Answer> HttpClient::perform(const Request& request, const Sink* sink) {
  Handle& handle = *handle_;
  curl_easy_reset(handle.curl);  // the options, not the connection
  const std::string url = connection_.url + request.target;
  handle.set_text(CURLOPT_URL, url);
  handle.set_text(CURLOPT_CUSTOMREQUEST, request.method);
  handle.set(CURLOPT_PROTOCOLS_STR, "http,https");
  handle.set(CURLOPT_USERAGENT, kUserAgent);
  handle.set(CURLOPT_NOSIGNAL, 1L);
  handle.set(CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  if (is_loopback(connection_.url)) handle.set(CURLOPT_PROXY, "");
  handle.set_text(CURLOPT_CAINFO, connection_.authority_file);
  handle.set_text(CURLOPT_SSLCERT, connection_.certificate_file);
  handle.set_text(CURLOPT_SSLKEY, connection_.certificate_key_file);
  if (sink == nullptr) {
    handle.set(CURLOPT_TIMEOUT, kAnswerSeconds);
  } else {
    handle.set(CURLOPT_LOW_SPEED_LIMIT, 1L);
    handle.set(CURLOPT_LOW_SPEED_TIME, kSilenceSeconds);
  }

  HeaderList headers;
  headers.add("Expect:");  // no question whether a large body is welcome
  // Empty, it keeps libcurl from naming the type of a web form.
  headers.add("Content-Type:" + (request.content_type.empty() ? "" : ' ' + request.content_type));
  if (!connection_.key.empty()) headers.add("Authorization: Bearer " + connection_.key);
  for (const std::string& line : request.headers) headers.add(line);
  handle.set(CURLOPT_HTTPHEADER, headers.first);
  if (request.method != "GET") {
    handle.set(CURLOPT_POSTFIELDS, request.body.data() == nullptr ? "" : request.body.data());
    handle.set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(request.body.size()));
    handle.set(CURLOPT_UPLOAD_BUFFERSIZE, kUploadBuffer);
  }

  Reading reading{.curl = handle.curl, .sink = sink};
  handle.set(CURLOPT_WRITEFUNCTION, &take_body);
  handle.set(CURLOPT_WRITEDATA, &reading);
  handle.set(CURLOPT_HEADERFUNCTION, &take_header);
  handle.set(CURLOPT_HEADERDATA, &reading);
  handle.error.front() = '\0';
  handle.set(CURLOPT_ERRORBUFFER, handle.error.data());

  const CURLcode code = curl_easy_perform(handle.curl);
  if (code != CURLE_OK && !reading.ended_by_sink) {
    const char* const reason =
        handle.error.front() == '\0' ? curl_easy_strerror(code) : handle.error.data();
    return Failure{ExitCode::NoAnswer, fmt::format("no answer from {}: {}; {}", connection_.url,
                                                   reason, advice_for(code))};
  }
  curl_easy_getinfo(handle.curl, CURLINFO_RESPONSE_CODE, &reading.answer.status);
  const char* type = nullptr;
  curl_easy_getinfo(handle.curl, CURLINFO_CONTENT_TYPE, &type);
  if (type != nullptr) reading.answer.content_type = type;
  return std::move(reading.answer);
}

}  // namespace fitgauge::cli
