#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "api/service/exposition.hpp"
#include "base/result.hpp"
#include "http/server.hpp"

namespace fitgauge::api {

/// What /metrics shows: requests and problems, which are counted here, and what its sources write
/// when somebody asks. docs/reference/metrics.md lists it. Thread-safe; counting a request takes
/// one short lock and no allocation once its route and status were seen.
class Metrics {
 public:
  Metrics();
  ~Metrics();

  void count(const http::FinishedRequest& request);
  /// A problem document was answered.
  void count(ErrorCode code);

  /// Writes families of its own; called on any thread, must not block. What it uses lives as long
  /// as the server.
  using Source = std::function<void(Exposition&)>;
  void add(Source source);

  /// Prometheus text format 0.0.4.
  std::string text() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fitgauge::api
