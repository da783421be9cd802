#include "db/store/measurement_statistics.hpp"

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
  if (count_++ == 0) first_ = min_ = max_ = value_nm;
  min_ = std::min(min_, value_nm);
  max_ = std::max(max_, value_nm);
  const Sum difference = Sum{value_nm} - first_;
  sum_ += difference;
  squares_ += difference * difference;
}

void ExactStatistics::add(const ExactStatistics& other) {
  if (other.count_ == 0) return;
  if (count_ == 0) {
    *this = other;
    return;
  }
  // The other's differences count from its first value, which is `shift` from ours: the sum of (d +
  // shift)^2. Unsigned, because an intermediate product may not fit although the sum does.
  const auto shift = static_cast<Bits>(Sum{other.first_} - first_);
  const auto n = static_cast<Bits>(other.count_);
  const auto sum = static_cast<Bits>(other.sum_);
  sum_ += static_cast<Sum>(sum + n * shift);
  squares_ = static_cast<Sum>(static_cast<Bits>(squares_) + static_cast<Bits>(other.squares_) +
                              2 * shift * sum + n * shift * shift);
  count_ += other.count_;
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
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

std::array<char, ExactStatistics::kEncodedSize> ExactStatistics::encode() const {
  std::array<char, kEncodedSize> bytes;
  char* at = bytes.data();
  const auto put = [&at](const auto& value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
  };
  put(count_), put(first_), put(min_), put(max_), put(sum_), put(squares_);
  return bytes;
}

ExactStatistics ExactStatistics::decode(std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little, "stored as this machine has them");
  ExactStatistics statistics;
  if (bytes.size() != kEncodedSize) return statistics;
  const char* at = bytes.data();
  const auto take = [&at](auto& value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  };
  take(statistics.count_), take(statistics.first_), take(statistics.min_), take(statistics.max_);
  take(statistics.sum_), take(statistics.squares_);
  return statistics;
}

void ExactStatistics::pack(std::string& out) const {
  append_number(out, static_cast<std::uint64_t>(count_));
  append_difference(out, first_, 0);
  append_difference(out, min_, first_);
  append_difference(out, max_, first_);
  append_signed(out, static_cast<Bits>(sum_));
  append_number(out, static_cast<Bits>(squares_));
}

ExactStatistics ExactStatistics::unpack(PackedNumbers& in) {
  ExactStatistics statistics;
  statistics.count_ = static_cast<std::int64_t>(in.number());
  statistics.first_ = in.above(0);
  statistics.min_ = in.above(statistics.first_);
  statistics.max_ = in.above(statistics.first_);
  statistics.sum_ = static_cast<Sum>(in.signed_number<Bits>());
  statistics.squares_ = static_cast<Sum>(in.number<Bits>());
  return statistics;
}

}  // namespace fitgauge::store
