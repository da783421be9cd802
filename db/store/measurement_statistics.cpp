#include "store/measurement_statistics.hpp"

#include <boost/multiprecision/cpp_int.hpp>

namespace fitgauge::store {
namespace {

namespace mp = boost::multiprecision;

/// An integer of any size, without expression templates.
using Integer = mp::number<mp::cpp_int_backend<>, mp::et_off>;

constexpr int kDigits = 12;                    ///< after the point of a millimetre
const Integer kUnitsPerNanometre = 1'000'000;  ///< 1e-12 mm

/// numerator / denominator to the nearest integer, half away from zero.
Integer divide_rounded(const Integer& numerator, const Integer& denominator) {
  const Integer magnitude = (2 * abs(numerator) + denominator) / (2 * denominator);
  return numerator < 0 ? -magnitude : magnitude;
}

/// units of 1e-12 mm as a decimal in mm
std::string format_units(const Integer& units) {
  std::string digits = abs(units).str();
  if (digits.size() <= kDigits) digits.insert(0, kDigits + 1 - digits.size(), '0');
  digits.insert(digits.size() - kDigits, 1, '.');
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return units < 0 ? '-' + digits : digits;
}

}  // namespace

void ExactStatistics::add(std::int64_t value_nm) {
  if (count_++ == 0) first_ = value_nm;
  const Sum difference = Sum{value_nm} - first_;
  sum_ += difference;
  squares_ += difference * difference;
}

std::string ExactStatistics::mean_mm() const {
  const Integer numerator = (Integer(first_) * count_ + Integer(sum_)) * kUnitsPerNanometre;
  return format_units(divide_rounded(numerator, count_));
}

std::string ExactStatistics::standard_deviation_mm() const {
  // variance = (n * squares - sum^2) / (n * (n - 1)); its root in units, rounded to nearest:
  // floor((floor(2 * root) + 1) / 2).
  const Integer n = count_;
  const Integer sum(sum_);
  const Integer numerator =
      (n * Integer(squares_) - sum * sum) * kUnitsPerNanometre * kUnitsPerNanometre * 4;
  const Integer twice_root = sqrt(numerator / (n * (n - 1)));
  return format_units((twice_root + 1) / 2);
}

}  // namespace fitgauge::store
