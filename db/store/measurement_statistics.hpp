#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "db/store/packed_numbers.hpp"

namespace fitgauge::store {

/// Mean, standard deviation and range of lengths in exact integers: 128-bit sums of the differences
/// from the first value, and of their squares. They hold 1e10 lengths of up to 1e14 nm.
class ExactStatistics {
 public:
  void add(std::int64_t value_nm);
  /// As if every value of the other had been added.
  void add(const ExactStatistics& other);

  std::int64_t count() const { return count_; }
  std::int64_t min_nm() const { return min_; }
  std::int64_t max_nm() const { return max_; }

  /// In mm to 1e-12, half away from zero, as the shortest decimal.
  std::string mean_mm() const;
  /// The same of the standard deviation of n - 1. @pre count() >= 2
  std::string standard_deviation_mm() const;

  /// As bytes to be stored, and back; bytes of another size give empty statistics.
  static constexpr std::size_t kEncodedSize = 64;
  std::array<char, kEncodedSize> encode() const;
  static ExactStatistics decode(std::string_view bytes);

  /// The same in some twenty bytes.
  void pack(std::string& out) const;
  static ExactStatistics unpack(PackedNumbers& in);

 private:
  __extension__ using Sum = __int128;
  using Bits = Unsigned128;

  std::int64_t count_ = 0;
  std::int64_t first_ = 0;
  std::int64_t min_ = 0;
  std::int64_t max_ = 0;
  Sum sum_ = 0;
  Sum squares_ = 0;
};

}  // namespace fitgauge::store
