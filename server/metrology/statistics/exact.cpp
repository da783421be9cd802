#include "metrology/statistics/exact.hpp"

#include <cmath>

namespace fitgauge::metrology {

Integer power_of_ten(int exponent) {
  return boost::multiprecision::pow(Integer(10), static_cast<unsigned>(exponent));
}

namespace {

template <class Real>
Real rounded(const Exact& value) {
  Integer top = numerator(value);
  Integer bottom = denominator(value);
  if (top == 0) return 0;
  const bool negative = top < 0;
  if (negative) top = -top;
  // A quotient of 66 or 67 bits, its last one set where something follows it, rounds as the
  // fraction itself would.
  constexpr int kBits = 66;
  const int shift = kBits + static_cast<int>(msb(bottom)) - static_cast<int>(msb(top));
  if (shift > 0) {
    top <<= shift;
  } else {
    bottom <<= -shift;
  }
  Integer quotient;
  Integer rest;
  divide_qr(top, bottom, quotient, rest);
  if (rest != 0) quotient |= 1;
  __extension__ using Bits = unsigned __int128;
  const Real magnitude = std::ldexp(static_cast<Real>(static_cast<Bits>(quotient)), -shift);
  return negative ? -magnitude : magnitude;
}

}  // namespace

long double nearest(const Exact& value) { return rounded<long double>(value); }
double nearest_double(const Exact& value) { return rounded<double>(value); }

void ExactSum::carry(Wide value) {
  high_ += Integer(low_);
  low_ = value;
}

void ExactSum::add_long_product(Wide a, Wide b) { high_ += Integer(a) * Integer(b); }

}  // namespace fitgauge::metrology
