#include "api/service/metrics.hpp"

#include <functional>
#include <map>
#include <mutex>
#include <tuple>

#include "api/service/version.hpp"
#include "api/wire/problem.hpp"

namespace fitgauge::api {
namespace {

using Seconds = Histogram<15>;
constexpr Seconds::Bounds kSeconds = {0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025,
                                      0.05,   0.1,     0.25,   0.5,   1,      2.5,   10};

constexpr int kUnauthorized = 401;
constexpr int kServerError = 500;

}  // namespace

struct Metrics::Parts {
  /// By the route's text (whose address is its identity), the method and the status.
  using Key = std::tuple<const char*, http::Method, int>;
  struct Requests {
    std::uint64_t count = 0;
    std::string_view route{};  ///< the key in `seconds`
    Seconds* seconds = nullptr;
  };

  std::vector<Source> sources;
  std::mutex mutex;
  std::map<Key, Requests> requests;
  std::map<std::string, Seconds, std::less<>> seconds;  ///< by route, all its methods together
  std::map<ErrorCode, std::uint64_t> problems;
};

Metrics::Metrics() : parts_(std::make_unique<Parts>()) {
  // What somebody is woken by is there from the start: a series that begins with 1 has no increase.
  for (const ErrorCode code : {
#define FITGAUGE_ERROR(name, id, title) ErrorCode::name,
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
       }) {
    const int status = status_of(code);
    if (status == kUnauthorized || status >= kServerError) parts_->problems[code] = 0;
  }
}
Metrics::~Metrics() = default;

void Metrics::count(const http::FinishedRequest& request) {
  const Parts::Key key{request.route.data(), request.request.method(), request.status};
  const std::lock_guard lock(parts_->mutex);
  auto [found, is_new] = parts_->requests.try_emplace(key);
  Parts::Requests& requests = found->second;
  if (is_new) {
    auto& [route, seconds] =
        *parts_->seconds.try_emplace(std::string(request.route), kSeconds).first;
    requests.route = route;
    requests.seconds = &seconds;
  }
  ++requests.count;
  requests.seconds->observe(static_cast<double>(request.microseconds) / 1e6);
}

void Metrics::count(ErrorCode code) {
  const std::lock_guard lock(parts_->mutex);
  ++parts_->problems[code];
}

void Metrics::add(Source source) {
  const std::lock_guard lock(parts_->mutex);
  parts_->sources.push_back(std::move(source));
}

std::string Metrics::text() const {
  Exposition out;
  std::vector<Source> sources;
  out.gauge("fitgauge_build_info", "1, with the version as a label")
      .sample(1, {{"version", kVersion}});
  {
    const std::lock_guard lock(parts_->mutex);
    out.counter("fitgauge_http_requests_total", "Answered requests by route, method and status");
    for (const auto& [key, requests] : parts_->requests) {
      // A method the service does not know is the client's text: it must not become a label.
      const http::Method method = std::get<http::Method>(key);
      out.sample(static_cast<double>(requests.count),
                 {{"route", requests.route},
                  {"method", method == http::Method::Other ? "other" : http::name(method)},
                  {"status", std::to_string(std::get<int>(key))}});
    }
    out.histogram("fitgauge_http_request_duration_seconds",
                  "From a request's first byte to its answer's last byte");
    for (const auto& [route, seconds] : parts_->seconds) out.sample(seconds, {{"route", route}});
    out.counter("fitgauge_problems_total", "Problem documents answered, by their code");
    for (const auto& [code, count] : parts_->problems) {
      out.sample(static_cast<double>(count), {{"code", id(code)}});
    }
    sources = parts_->sources;
  }
  for (const Source& source : sources) source(out);
  return out.take();
}

}  // namespace fitgauge::api
