#pragma once

#include "base/histogram.hpp"
#include "http/server.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// Writes the Prometheus text format 0.0.4: a family, then its samples. Used by one thread.
class Exposition {
 public:
  using Labels = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  // Begins a family; the next samples belong to it. Names are plain words of the contract.
  Exposition& counter(std::string_view name, std::string_view help) {
    return family(name, help, "counter");
  }
  Exposition& gauge(std::string_view name, std::string_view help) {
    return family(name, help, "gauge");
  }
  Exposition& histogram(std::string_view name, std::string_view help) {
    return family(name, help, "histogram");
  }

  Exposition& sample(double value, Labels labels = {});
  Exposition& sample(std::integral auto count, Labels labels = {}) {
    return sample(static_cast<double>(count), labels);
  }

  /// The samples of one histogram of the family.
  template <std::size_t N>
  Exposition& sample(const Histogram<N>& histogram, Labels labels = {}) {
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < N; ++i) {
      below += histogram.count(i);
      line("_bucket", labels, histogram.bounds()[i], static_cast<double>(below));
    }
    below += histogram.count(N);
    line("_bucket", labels, kInfinity, static_cast<double>(below));
    line("_sum", labels, {}, histogram.sum());
    line("_count", labels, {}, static_cast<double>(below));
    return *this;
  }

  std::string take() { return std::move(out_); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  Exposition& family(std::string_view name, std::string_view help, std::string_view type);
  void line(std::string_view suffix, Labels labels, std::optional<double> bound, double value);

  std::string out_;
  std::string_view family_;
};

/// Metrics of /metrics: requests and problems, which are counted here, and the lines of its sources
/// at each request. docs/reference/metrics.md lists them. Thread-safe; counting a request needs one
/// short lock and no allocation after the first one of its route and status.
class Metrics {
 public:
  Metrics();

  void count(const http::FinishedRequest& request);
  /// A problem document was answered.
  void count(ErrorCode code);

  /// Writes metrics of a source, on any thread, without blocking. Its data outlive the server.
  using Source = std::function<void(Exposition&)>;
  void add(Source source);

  /// Prometheus text format 0.0.4.
  std::string text() const;

 private:
  using Seconds = Histogram<15>;
  /// By the route's text (whose address is its identity), the method and the status.
  using Key = std::tuple<const char*, http::Method, int>;
  struct Requests {
    std::uint64_t count = 0;
    std::string_view route{};  ///< the key in `seconds_`
    Seconds* seconds = nullptr;
  };

  std::vector<Source> sources_;
  mutable std::mutex mutex_;
  std::map<Key, Requests> requests_;
  std::map<std::string, Seconds, std::less<>> seconds_;  ///< by route, all its methods together
  std::map<ErrorCode, std::uint64_t> problems_;
};

/// Counts the measurements since the start by source and verdict, for metrics: reads new rows at
/// each request, so that storing has no overhead. Thread-safe.
class VerdictCounts : public std::enable_shared_from_this<VerdictCounts> {
 public:
  explicit VerdictCounts(app::MeasurementService& measurements) : measurements_(measurements) {}

  /// Reads new rows, the first time only the end of the log, and calls `done`, on a storage thread
  /// or at once; also if the storage cannot be read. A call during another one does not wait.
  void refresh(std::function<void()> done);

  void write(Exposition& out) const;

 private:
  static constexpr std::size_t kSources = 2;
  using Counts = std::array<std::array<std::uint64_t, gauging::kVerdicts>, kSources>;

  void take(const Result<app::ListPage>& page, const Counts& counts, std::int64_t last);

  app::MeasurementService& measurements_;
  mutable std::mutex mutex_;
  bool reading_ = false;
  std::optional<std::int64_t> position_;  ///< the last id that was counted
  Counts counts_{};
};

}  // namespace fitgauge::api
