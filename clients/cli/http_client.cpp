#include "cli/http_client.hpp"

#include <random>

#include "http/client/http_client.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::string_view kDrive = "TNC:\\";

/// Without the drive, with `/` between the folders.
std::string slashed(std::string_view path) {
  if (ascii_iequals(path.substr(0, kDrive.size() - 1), "TNC:"))
    path.remove_prefix(kDrive.size() - 1);
  std::string out(path);
  std::replace(out.begin(), out.end(), '\\', '/');
  return out.substr(std::min(out.find_first_not_of('/'), out.size()));
}

std::string_view host_of(std::string_view url) {
  url.remove_prefix(url.find("://") + 3);
  const std::string_view authority = url.substr(0, url.find('/'));
  if (authority.starts_with('[')) return authority.substr(0, authority.find(']') + 1);
  return authority.substr(0, authority.find(':'));
}

bool is_unreserved(char c) {
  return is_ascii_alphanumeric(c) || c == '-' || c == '.' || c == '_' || c == '~';
}

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

constexpr long kUnauthorized = 401;
constexpr long kForbidden = 403;
constexpr long kServerError = 500;

std::optional<std::size_t> line_of(const JsonValue& entry) {
  return read_number<std::size_t>(entry.text_of("line"));
}

ExitCode exit_code_of(const Answer& answer) {
  if (answer.status == kUnauthorized || answer.status == kForbidden) return ExitCode::KeyNeeded;
  if (answer.status >= kServerError || is_temporary(answer)) return ExitCode::NoAnswer;
  return ExitCode::Refused;
}

/// The detail, or the list of the fields, which has the detail with its place.
std::string sentence(const Problem& problem) {
  if (problem.fields.empty()) return problem.detail.empty() ? problem.title : problem.detail;
  std::string text;
  for (const FieldProblem& field : problem.fields)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", field.pointer, field.detail);
  return text;
}

}  // namespace

Outcome<std::string> service_url(std::string_view text) {
  std::string url(trim(text));
  if (url.find("://") == std::string::npos) url.insert(0, "http://");
  while (url.ends_with('/')) url.pop_back();
  const bool known = url.starts_with("http://") || url.starts_with("https://");
  if (known && !host_of(url + '/').empty()) return url;
  return Failure::of(ExitCode::Usage,
                     "the address of the service must be such as http://127.0.0.1:8286; got '{}'",
                     text);
}

bool is_loopback(std::string_view url) {
  const std::string_view host = host_of(url);
  return host == "localhost" || host == "[::1]" || host.starts_with("127.");
}

std::string percent_encoded(std::string_view text, std::string_view kept) {
  std::string out;
  for (const char c : text) {
    if (is_unreserved(c) || kept.find(c) != std::string_view::npos) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

std::string file_target(std::string_view path) {
  std::string out = "/v1/files";
  const std::string rest = slashed(path);
  for (const std::string_view part : split(rest, '/')) out += '/' + percent_encoded(part);
  return out;
}

std::string control_path(std::string_view path) {
  std::string out = slashed(path);
  std::replace(out.begin(), out.end(), '/', '\\');
  return out.insert(0, kDrive);
}

std::string_view base_name(std::string_view path) {
  return path.substr(path.find_last_of("/\\") + 1);
}

HttpClient::HttpClient(Connection connection)
    : connection_(std::move(connection)), handle_(std::make_unique<http_client::CurlHandle>()) {}
HttpClient::~HttpClient() = default;

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

std::optional<Problem> problem_of(const Answer& answer) {
  if (!answer.content_type.starts_with("application/problem+json")) return std::nullopt;
  const auto document = parse_document(answer.body);
  if (!document) return std::nullopt;
  Problem problem{.code = std::string(document->text_of("code")),
                  .title = std::string(document->text_of("title")),
                  .detail = std::string(document->text_of("detail")),
                  .where = std::string(document->text_of("where"))};
  // The detail describes all of an input that cannot be read.
  if (!problem.where.empty()) return problem;
  for (const JsonValue& entry : document->member("errors").items) {
    problem.fields.push_back({.pointer = std::string(entry.text_of("pointer")),
                              .line = line_of(entry),
                              .detail = std::string(entry.text_of("detail"))});
  }
  return problem;
}

Failure failure_of(const Answer& answer, const std::string& url) {
  const auto problem = problem_of(answer);
  if (!problem) {
    return {exit_code_of(answer),
            fmt::format(
                "{} returns status {} without a problem document: check that fitgauged runs there",
                url, answer.status)};
  }
  std::string text = sentence(*problem);
  if (answer.status == kUnauthorized) text += "; set FITGAUGE_KEY, or give a file with --key-file";
  if (answer.status == kForbidden) text += "; use a key with another role";
  return {exit_code_of(answer), std::move(text), answer.body};
}

bool is_temporary(const Answer& answer) {
  constexpr long kTimeout = 408;
  constexpr long kConflict = 409;
  constexpr long kTooMany = 429;
  switch (answer.status) {
    case kTimeout:
    case kTooMany:
    case 502:
    case 503:
    case 504: return true;
    case kConflict: {
      const auto problem = problem_of(answer);
      return problem && problem->code == "idempotency.in_progress";
    }
    default: return false;
  }
}

Outcome<Answer> expect_ok(Outcome<Answer> answer, const std::string& url) {
  if (!answer || answer->ok()) return answer;
  return failure_of(*answer, url);
}

Outcome<JsonValue> read_document(const Answer& answer, const std::string& url) {
  auto document = parse_document(answer.body);
  if (document) return *std::move(document);
  return Failure::of(ExitCode::NoAnswer, "{} does not return JSON: check that fitgauged runs there",
                     url);
}

}  // namespace fitgauge::cli
