#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <cstdint>

namespace fitgauge::metrology {

/// Whole numbers of any size and their fractions, without expression templates. Sums, differences
/// and quotients of decimals are exact in them; what is irrational is rounded once, to `long
/// double`.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                              boost::multiprecision::et_off>;
using Exact = boost::multiprecision::number<
    boost::multiprecision::rational_adaptor<boost::multiprecision::cpp_int_backend<>>,
    boost::multiprecision::et_off>;

/// A decimal value times a power of ten.
__extension__ using Wide = __int128;

Integer power_of_ten(int exponent);
inline Exact whole(std::size_t count) { return {Integer(count)}; }

/// The nearest `long double`, which holds 19 digits; ties to even.
long double nearest(const Exact& value);
/// The nearest `double`, which is not always that of the nearest `long double`: that was rounded.
double nearest_double(const Exact& value);
/// Whether products of two such numbers fit in 128 bits.
constexpr bool is_short(Wide value) {
  constexpr Wide kShort = Wide{1} << 62;
  return -kShort < value && value < kShort;
}

/// A sum that never overflows: 128 bits while they reach, then any number.
class ExactSum {
 public:
  void add(Wide value) {
    Wide sum = 0;
    if (__builtin_add_overflow(low_, value, &sum)) return carry(value);
    low_ = sum;
  }
  void add_product(Wide a, Wide b) {
    if (is_short(a) && is_short(b)) return add(a * b);
    add_long_product(a, b);
  }
  Integer value() const { return high_ + Integer(low_); }

 private:
  void carry(Wide value);
  void add_long_product(Wide a, Wide b);

  Wide low_ = 0;
  Integer high_ = 0;
};

}  // namespace fitgauge::metrology
