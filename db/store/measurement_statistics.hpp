#pragma once

#include <cstdint>
#include <string>

namespace fitgauge::store {

/// Mean and standard deviation of lengths in exact integers: 128-bit sums of the differences from
/// the first value, and of their squares. They hold 1e10 lengths of up to 1e14 nm.
class ExactStatistics {
 public:
  void add(std::int64_t value_nm);

  std::int64_t count() const { return count_; }

  /// In mm to 1e-12, half away from zero, as the shortest decimal.
  std::string mean_mm() const;
  /// The same of the standard deviation of n - 1. @pre count() >= 2
  std::string standard_deviation_mm() const;

 private:
  __extension__ using Sum = __int128;

  std::int64_t count_ = 0;
  std::int64_t first_ = 0;
  Sum sum_ = 0;
  Sum squares_ = 0;
};

}  // namespace fitgauge::store
