#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>

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
/// numerator / denominator, rounded once. @pre denominator > 0
long double ratio(Wide numerator, Wide denominator);

/// A sum that never overflows: 128 bits while they reach, then any number.
class ExactSum {
 public:
  void add(Wide value);
  void add_product(Wide a, Wide b);
  Integer value() const { return high_ + Integer(low_); }

 private:
  Wide low_ = 0;
  Integer high_ = 0;
};

}  // namespace fitgauge::metrology
