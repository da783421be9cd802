#include "api/service/metrics.hpp"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <map>
#include <mutex>
#include <tuple>

#include "api/service/version.hpp"

namespace fitgauge::api {
namespace {

const prometheus::Histogram::BucketBoundaries kSeconds = {
    0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 10};

}  // namespace

struct Metrics::Parts {
  prometheus::Registry registry;
  prometheus::Family<prometheus::Counter>& requests =
      prometheus::BuildCounter()
          .Name("fitgauge_http_requests_total")
          .Help("Answered requests by route, method and status")
          .Register(registry);
  prometheus::Family<prometheus::Histogram>& durations =
      prometheus::BuildHistogram()
          .Name("fitgauge_http_request_duration_seconds")
          .Help("From a request's first byte to its answer's last byte")
          .Register(registry);
  prometheus::Family<prometheus::Gauge>& connections = prometheus::BuildGauge()
                                                           .Name("fitgauge_http_connections")
                                                           .Help("Open connections")
                                                           .Register(registry);
  prometheus::Family<prometheus::Gauge>& body_bytes = prometheus::BuildGauge()
                                                          .Name("fitgauge_http_body_bytes")
                                                          .Help("Bytes of request bodies in memory")
                                                          .Register(registry);
  prometheus::Family<prometheus::Gauge>& build = prometheus::BuildGauge()
                                                     .Name("fitgauge_build_info")
                                                     .Help("1, with the version as a label")
                                                     .Register(registry);

  struct Series {
    prometheus::Counter* requests;
    prometheus::Histogram* duration;
  };
  /// By the route's text (whose address is its identity), the method and the status.
  using Key = std::tuple<const char*, http::Method, int>;
  std::map<Key, Series> series;
  std::mutex mutex;
  std::function<http::ServerCounters()> counters;
};

Metrics::Metrics() : parts_(std::make_unique<Parts>()) {
  parts_->build.Add({{"version", std::string(kVersion)}}).Set(1);
}

Metrics::~Metrics() = default;

void Metrics::count(const http::FinishedRequest& request) {
  const http::Method method = http::method_named(request.method);
  const Parts::Key key{request.route.data(), method, request.status};
  const std::lock_guard lock(parts_->mutex);
  auto found = parts_->series.find(key);
  if (found == parts_->series.end()) {
    const prometheus::Labels route{{"route", std::string(request.route)}};
    prometheus::Labels labels = route;
    // A method the service does not know is the client's text: it must not become a label.
    labels.emplace("method", method == http::Method::Other ? "other" : http::name(method));
    labels.emplace("status", std::to_string(request.status));
    found = parts_->series
                .emplace(key, Parts::Series{&parts_->requests.Add(labels),
                                            &parts_->durations.Add(route, kSeconds)})
                .first;
  }
  found->second.requests->Increment();
  found->second.duration->Observe(static_cast<double>(request.microseconds) / 1e6);
}

void Metrics::watch(std::function<http::ServerCounters()> counters) {
  const std::lock_guard lock(parts_->mutex);
  parts_->counters = std::move(counters);
}

std::string Metrics::text() const {
  {
    const std::lock_guard lock(parts_->mutex);
    if (parts_->counters) {
      const http::ServerCounters counters = parts_->counters();
      parts_->connections.Add({}).Set(static_cast<double>(counters.connections_open));
      parts_->body_bytes.Add({}).Set(static_cast<double>(counters.body_bytes_in_flight));
    }
  }
  return prometheus::TextSerializer().Serialize(parts_->registry.Collect());
}

}  // namespace fitgauge::api
