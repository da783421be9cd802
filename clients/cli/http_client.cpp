#include "cli/http_client.hpp"

#include <random>

#include "http/client/http_client.hpp"

namespace fitgauge::cli {
namespace {

constexpr long kConnectSeconds = 5;
constexpr long kAnswerSeconds = 120;
constexpr long kSilenceSeconds = 45;  // the service sends a sign of life every 15 s
constexpr long kUploadBuffer = 512L * 1024;

/// Receiver of the current response's pieces.
struct Reading {
  const http_client::CurlHandle& handle;
  Answer answer{};
  const HttpClient::Sink* sink;
  bool ended_by_sink = false;
};

/// The remedy for a failed connection.
std::string_view advice_for(CURLcode code) {
  switch (code) {
    case CURLE_PEER_FAILED_VERIFICATION:
      return "give its CA certificate with --ca, or the name in its certificate with --server";
    case CURLE_SSL_CACERT_BADFILE: return "--ca must be a PEM file with certificates";
    case CURLE_SSL_CERTPROBLEM:
      return "--cert and --cert-key must be PEM files with the certificate and the key of this "
             "client";
    case CURLE_SSL_CONNECT_ERROR:
      return "check that the service uses TLS at this address, and if it needs a certificate "
             "(--cert, --cert-key)";
    default: return "start fitgauged there, or give another address with --server";
  }
}

std::size_t take_body(char* data, std::size_t, std::size_t size, void* user) {
  auto& reading = *static_cast<Reading*>(user);
  if (reading.answer.status == 0) reading.answer.status = reading.handle.status();
  if (reading.sink == nullptr || !reading.answer.ok()) {
    reading.answer.body.append(data, size);
    return size;
  }
  if ((*reading.sink)({data, size})) return size;
  reading.ended_by_sink = true;
  return CURL_WRITEFUNC_ERROR;
}

}  // namespace

HttpClient::HttpClient(Connection connection)
    : connection_(std::move(connection)), handle_(std::make_unique<http_client::CurlHandle>()) {}
HttpClient::~HttpClient() = default;
HttpClient::HttpClient(HttpClient&&) noexcept = default;
HttpClient& HttpClient::operator=(HttpClient&&) noexcept = default;

Outcome<Answer> HttpClient::send(const Request& request) { return perform(request, nullptr); }

Outcome<Answer> HttpClient::stream(const Request& request, const Sink& sink) {
  return perform(request, &sink);
}

Outcome<Answer> HttpClient::perform(const Request& request, const Sink* sink) {
  http_client::CurlHandle& handle = *handle_;
  std::vector<std::string> headers = request.headers;
  // Empty, it keeps libcurl from naming the type of a web form.
  headers.push_back("Content-Type:" +
                    (request.content_type.empty() ? "" : ' ' + request.content_type));
  if (!connection_.key.empty()) headers.push_back("Authorization: Bearer " + connection_.key);
  handle.begin(connection_.url + request.target, request.method, headers, request.body);
  handle.set(CURLOPT_UPLOAD_BUFFERSIZE, kUploadBuffer);
  handle.set(CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  handle.set(CURLOPT_PATH_AS_IS, 1L);  // `..` is a name, not a way out of the resource
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
  Reading reading{.handle = handle, .sink = sink};
  handle.set(CURLOPT_WRITEFUNCTION, &take_body);
  handle.set(CURLOPT_WRITEDATA, &reading);

  const CURLcode code = handle.perform();
  if (code != CURLE_OK && !reading.ended_by_sink) {
    return Failure::of(ExitCode::NoAnswer, "no answer from {}: {}; {}", connection_.url,
                       handle.reason(code), advice_for(code));
  }
  reading.answer.status = handle.status();
  reading.answer.content_type = handle.content_type();
  reading.answer.retry_after = handle.retry_after();
  return std::move(reading.answer);
}

std::optional<Backoff::Milliseconds> Backoff::next(
    std::optional<std::chrono::seconds> retry_after) {
  Milliseconds wait = delay_;
  if (retry_after) wait = std::max(wait, Milliseconds(*retry_after));
  if (wait > left_) return std::nullopt;
  left_ -= wait;
  delay_ = std::min(delay_ * 2, kLongest);
  return wait;
}

std::string new_idempotency_key() {
  std::random_device entropy;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", entropy(), entropy(), entropy(), entropy());
}

Outcome<Answer> send_until_answered(HttpClient& client, const Request& request, Backoff backoff,
                                    const RetryNotice& notice) {
  for (;;) {
    auto answer = client.send(request);
    if (answer && !is_temporary(*answer)) return answer;
    const Failure failure = answer ? failure_of(*answer, client.url()) : answer.error();
    const auto wait = backoff.next(answer ? answer->retry_after : std::nullopt);
    if (!wait) return failure;
    notice(failure, *wait);
    std::this_thread::sleep_for(*wait);
  }
}

}  // namespace fitgauge::cli
