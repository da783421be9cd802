#pragma once

#include "base/json/json_writer.hpp"
#include "cli/outcome.hpp"

namespace fitgauge::http_client {
class CurlHandle;
}  // namespace fitgauge::http_client

namespace fitgauge::cli {

/// Address of the service and credentials.
struct Connection {
  std::string url;                 ///< as service_url() gives it
  std::string key{};               ///< API key; empty: no key is sent
  std::string authority_file{};    ///< PEM; the system's authorities when empty
  std::string certificate_file{};  ///< PEM, of this client
  std::string certificate_key_file{};
};

/// One request. The body is not copied: it outlives the call.
struct Request {
  std::string method = "GET";
  std::string target;                  ///< path and query, after the address of the service
  std::vector<std::string> headers{};  ///< `Name: value`
  std::string content_type{};          ///< of the body; empty: not sent
  std::string_view body{};
};

struct Answer {
  long status = 0;
  std::string content_type{};
  std::optional<std::chrono::seconds> retry_after{};
  std::string body{};

  bool ok() const { return status >= 200 && status < 300; }
};

/// One connection to the service, kept alive between requests (libcurl; proxies from its
/// environment variables, but none to this machine). Used by one thread. After a failure the next
/// request connects again.
class HttpClient {
 public:
  explicit HttpClient(Connection connection);
  ~HttpClient();

  const std::string& url() const { return connection_.url; }

  /// @errors NoAnswer: not reached, cut off, or silent for two minutes.
  Outcome<Answer> send(const Request& request) { return perform(request, nullptr); }

  /// Receives a piece of a body; returns false to end the stream.
  using Sink = std::function<bool(std::string_view)>;

  /// Passes the body of a successful response to `sink` as it arrives, without a time limit; any
  /// other response has its body. @errors NoAnswer: also if nothing arrived for 45 seconds.
  Outcome<Answer> stream(const Request& request, const Sink& sink) {
    return perform(request, &sink);
  }

 private:
  Outcome<Answer> perform(const Request& request, const Sink* sink);

  Connection connection_;
  std::unique_ptr<http_client::CurlHandle> handle_;
};

/// Delays before a request is sent again: 0.2 s, doubled each time up to 10 s, or as long as the
/// service requests, until the sum exceeds the budget.
class Backoff {
 public:
  using Milliseconds = std::chrono::milliseconds;

  explicit Backoff(std::chrono::seconds budget) : left_(budget) {}

  /// @param retry_after of the response. @returns nothing if the budget is used up.
  std::optional<Milliseconds> next(std::optional<std::chrono::seconds> retry_after);

 private:
  static constexpr Milliseconds kFirst{200};
  static constexpr Milliseconds kLongest{10'000};

  Milliseconds left_;
  Milliseconds delay_ = kFirst;
};

/// Called before each delay with its reason and length.
using RetryNotice = std::function<void(const Failure&, std::chrono::milliseconds)>;

std::string new_idempotency_key();

/// Sends a request that may be repeated (a GET, or one with an idempotency key) until it gets an
/// answer that is final. @errors NoAnswer, with the last reason, when the budget is used up.
Outcome<Answer> send_until_answered(HttpClient& client, const Request& request, Backoff backoff,
                                    const RetryNotice& notice);

/// Returns the address of a service in its used form: `localhost:8286` becomes http, a trailing
/// slash is removed.
/// @errors Usage for another scheme or no host.
Outcome<std::string> service_url(std::string_view text);

/// Whether the address is one of this machine: no proxy leads there.
bool is_loopback(std::string_view url);

/// Encodes `text` as one segment of a path or one value of a query (RFC 3986: every character that
/// is not unreserved).
/// @param kept further characters that are not encoded
std::string percent_encoded(std::string_view text, std::string_view kept = {});

/// `nc_prog/8255/8255.h` or `TNC:\nc_prog\8255\8255.h` as the service's path of the file.
std::string file_target(std::string_view path);

/// Returns the path as the control writes it.
std::string control_path(std::string_view path);

/// Returns the part after the last slash or backslash.
std::string_view base_name(std::string_view path);

/// A response of the service, or a file that it wrote, with any number of values.
inline Result<JsonValue> parse_document(std::string_view text) {
  return parse_json(text, std::numeric_limits<std::size_t>::max());
}

/// The members of an object that is sent, in the order they are added.
class JsonObject {
 public:
  JsonObject& add(std::string_view name, std::string_view value) {
    return add_raw(name, json_string(value));
  }
  JsonObject& add(std::string_view name, std::integral auto number) {
    return add_raw(name, std::to_string(number));
  }
  /// An empty value, of an option that was not given, is not added.
  JsonObject& add_given(std::string_view name, std::string_view value) {
    return value.empty() ? *this : add(name, value);
  }
  /// @param json a value that is JSON already
  JsonObject& add_raw(std::string_view name, std::string_view json) {
    members_ += fmt::format("{}{}:{}", members_.empty() ? "" : ",", json_string(name), json);
    return *this;
  }

  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

/// The error in one field of a body.
struct FieldProblem {
  std::string pointer;                ///< JSON pointer: `/3/measured_mm`
  std::optional<std::size_t> line{};  ///< of the body, from 1, if the format has lines
  std::string detail;
};

/// A problem document (RFC 9457) of the service.
struct Problem {
  std::string code;
  std::string title;
  std::string detail;
  std::string where;  ///< the place in a body that could not be read, or empty
  std::vector<FieldProblem> fields{};
};

/// @returns nothing when the answer is something else: a proxy's page, another service.
std::optional<Problem> problem_of(const Answer& answer);

/// Returns the failure of a request in one line, with its remedy.
/// @param url the address that answered
Failure failure_of(const Answer& answer, const std::string& url);

/// Returns whether to repeat the request soon: the service is busy, starting or still at work.
bool is_temporary(const Answer& answer);

/// Returns a response that is a success. @errors as failure_of().
Outcome<Answer> expect_ok(Outcome<Answer> answer, const std::string& url);

/// Returns the document of a successful response. @errors NoAnswer if it is not JSON.
Outcome<JsonValue> read_document(const Answer& answer, const std::string& url);

}  // namespace fitgauge::cli
