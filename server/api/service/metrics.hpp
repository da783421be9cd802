#pragma once

#include <functional>
#include <memory>
#include <string>

#include "http/server.hpp"

namespace fitgauge::api {

/// What /metrics shows. Thread-safe; counting a request takes one short lock and no allocation once
/// its route and status were seen.
class Metrics {
 public:
  Metrics();
  ~Metrics();

  void count(const http::FinishedRequest& request);

  /// Where the server's own counters are read; set once before the first request.
  void watch(std::function<http::ServerCounters()> counters);

  /// Prometheus text format 0.0.4.
  std::string text() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fitgauge::api
