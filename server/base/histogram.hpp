#pragma once

namespace fitgauge {

/// Counts observations by upper bound, for metrics. Thread-safe. An observation is two atomic
/// additions; a reader may see one before the other.
template <std::size_t N>
class Histogram {
 public:
  using Bounds = std::array<double, N>;  ///< rising; a last bucket has the values above them

  explicit constexpr Histogram(const Bounds& bounds) : bounds_(bounds) {}

  void observe(double value) {
    const auto bucket = std::lower_bound(bounds_.begin(), bounds_.end(), value) - bounds_.begin();
    counts_[static_cast<std::size_t>(bucket)].fetch_add(1, std::memory_order_relaxed);
    sum_.fetch_add(value, std::memory_order_relaxed);
  }

  std::span<const double> bounds() const { return bounds_; }
  /// Returns the count of bucket `i`, 0 to N.
  std::uint64_t count(std::size_t i) const { return counts_[i].load(std::memory_order_relaxed); }
  double sum() const { return sum_.load(std::memory_order_relaxed); }

 private:
  Bounds bounds_;
  std::array<std::atomic<std::uint64_t>, N + 1> counts_{};
  std::atomic<double> sum_{0};
};

}  // namespace fitgauge
