#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/histogram.hpp"

namespace fitgauge::api {

/// Writes the Prometheus text format 0.0.4: a family, then its samples. Used by one thread.
class Exposition {
 public:
  using Labels = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  // Each begins a family; the samples that follow are of it. Names are plain words of the contract.
  Exposition& counter(std::string_view name, std::string_view help);
  Exposition& gauge(std::string_view name, std::string_view help);
  Exposition& histogram(std::string_view name, std::string_view help);

  Exposition& sample(double value, Labels labels = {});

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

}  // namespace fitgauge::api
