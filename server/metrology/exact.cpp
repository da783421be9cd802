#include "metrology/exact.hpp"

#include <cmath>

namespace fitgauge::metrology {
namespace {

constexpr Wide kShort = Wide{1} << 62;

constexpr bool is_short(Wide value) { return -kShort < value && value < kShort; }

}  // namespace

Integer power_of_ten(int exponent) {
  return boost::multiprecision::pow(Integer(10), static_cast<unsigned>(exponent));
}

long double nearest(const Exact& value) {
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
  const long double magnitude =
      std::ldexp(static_cast<long double>(static_cast<Bits>(quotient)), -shift);
  return negative ? -magnitude : magnitude;
}

long double ratio(Wide numerator, Wide denominator) {
  if (is_short(numerator) && is_short(denominator)) {
    return static_cast<long double>(numerator) / static_cast<long double>(denominator);
  }
  return nearest(Exact(Integer(numerator), Integer(denominator)));
}

void ExactSum::add(Wide value) {
  Wide sum = 0;
  if (__builtin_add_overflow(low_, value, &sum)) {
    high_ += Integer(low_);
    sum = value;
  }
  low_ = sum;
}

void ExactSum::add_product(Wide a, Wide b) {
  if (is_short(a) && is_short(b)) return add(a * b);
  high_ += Integer(a) * Integer(b);
}

}  // namespace fitgauge::metrology
