#pragma once

namespace fitgauge::store {

// Numbers are written seven bits a byte, the lowest first; the eighth bit is set if another byte
// follows. The lowest bit of signed numbers is the sign. An optional text is its length plus one,
// or 0 if absent, and its bytes.

__extension__ using Unsigned128 = unsigned __int128;

template <class Number>
void append_number(std::string& out, Number number) {
  constexpr unsigned kMore = 0x80;
  for (; number >= kMore; number >>= 7U) {
    out += static_cast<char>(static_cast<unsigned>(number & 0x7FU) | kMore);
  }
  out += static_cast<char>(number);
}

/// @param number in two's complement
template <class Number>
void append_signed(std::string& out, Number number) {
  const bool is_negative = number >> (8 * sizeof number - 1) != 0;
  append_number<Number>(out, is_negative ? ~(number << 1U) : number << 1U);
}

/// Differences wrap around as unsigned numbers, so they are always reversible.
inline void append_difference(std::string& out, std::int64_t of, std::int64_t from) {
  append_signed(out, static_cast<std::uint64_t>(of) - static_cast<std::uint64_t>(from));
}

inline void append_text(std::string& out, std::optional<std::string_view> text) {
  append_number<std::uint64_t>(out, text ? text->size() + 1 : 0);
  out += text.value_or("");
}

/// Reads them in their order; after the end, or if malformed, a number is 0.
class PackedNumbers {
 public:
  explicit PackedNumbers(std::string_view bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

  template <class Number = std::uint64_t>
  Number number() {
    Number number = 0;
    for (unsigned shift = 0; at_ != end_ && shift < 8 * sizeof number; shift += 7) {
      const auto byte = static_cast<unsigned char>(*at_++);
      number |= Number{byte & 0x7FU} << shift;
      if (byte < 0x80U) return number;
    }
    is_sound_ = false;
    return 0;
  }
  template <class Number = std::uint64_t>
  Number signed_number() {
    const Number bits = number<Number>();
    return (bits & 1U) == 0 ? bits >> 1U : ~(bits >> 1U);
  }
  std::int64_t above(std::int64_t from) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(from) + signed_number());
  }
  std::string_view bytes(std::uint64_t size) {
    if (size > static_cast<std::uint64_t>(end_ - at_)) {
      is_sound_ = false;
      return {};
    }
    const std::string_view bytes(at_, size);
    at_ += size;
    return bytes;
  }
  std::string_view rest() { return bytes(static_cast<std::uint64_t>(end_ - at_)); }
  std::optional<std::string_view> text() {
    const std::uint64_t size = number();
    return size == 0 ? std::nullopt : std::optional(bytes(size - 1));
  }

  bool is_sound() const { return is_sound_; }
  bool is_at_end() const { return is_sound_ && at_ == end_; }

 private:
  const char* at_;
  const char* end_;
  bool is_sound_ = true;
};

/// Numbers of equal width in bits; each can be read without the numbers before it.
class NumberRow {
 public:
  static constexpr unsigned kMostBits = 57;
  /// Bytes that must follow the numbers.
  static constexpr std::size_t kPadding = 8;

  NumberRow() = default;
  /// @param at the first of size(count, bits) bytes; kPadding more can be read
  NumberRow(const char* at, unsigned bits)
      : at_(at), bits_(bits), mask_((std::uint64_t{1} << bits) - 1) {}

  static std::size_t size(std::size_t count, unsigned bits) { return (count * bits + 7) / 8; }

  std::uint64_t operator[](std::size_t i) const {
    std::uint64_t word = 0;
    std::memcpy(&word, at_ + i * bits_ / 8, sizeof word);
    return word >> (i * bits_ % 8) & mask_;
  }

  template <class Number>
  static void append(std::string& out, std::span<const Number> numbers, unsigned bits) {
    std::uint64_t word = 0;
    unsigned used = 0;
    for (const std::uint64_t number : numbers) {
      word |= number << used;
      for (used += bits; used >= 8; used -= 8, word >>= 8U) out += static_cast<char>(word & 0xFFU);
    }
    if (used > 0) out += static_cast<char>(word);
  }

 private:
  const char* at_ = nullptr;
  std::size_t bits_ = 0;
  std::uint64_t mask_ = 0;
};

/// Mean, standard deviation and range of lengths in exact integers: 128-bit sums of the differences
/// from the first value, and of their squares. They hold 1e10 lengths of up to 1e14 nm.
class ExactStatistics {
 public:
  void add(std::int64_t value_nm);
  /// Adds every value of the other.
  void add(const ExactStatistics& other);

  std::int64_t count() const { return count_; }
  std::int64_t min_nm() const { return min_; }
  std::int64_t max_nm() const { return max_; }

  /// Returns the mean in mm to 1e-12, half away from zero, as the shortest decimal.
  std::string mean_mm() const;
  /// Returns the standard deviation of n - 1 in mm to 1e-12. @pre count() >= 2
  std::string standard_deviation_mm() const;

  /// Converts to bytes for the store, and back; bytes of another size give empty statistics.
  static constexpr std::size_t kEncodedSize = 64;
  std::array<char, kEncodedSize> encode() const;
  static ExactStatistics decode(std::string_view bytes);

  /// Encodes in some twenty bytes.
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
