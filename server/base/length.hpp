#pragma once

namespace fitgauge {

/// Forms of a decimal text, and the treatment of digits finer than the scale.
struct DecimalSyntax {
  int scale = 6;               ///< digits after the point: value = integer / 10^scale
  bool decimal_comma = false;  ///< `25,5` is read as `25.5`
  bool exponent = false;       ///< `2.5e1` is read
  bool round_to_nearest =
      false;  ///< round finer digits, half away from zero, instead of refusing them
};

/// Reads the whole of `text` as an exact decimal: [sign] digits [mark digits] [exponent].
/// @returns the value times 10^scale.
/// @errors NumberMalformed; NumberOutOfRange when it does not fit; LengthTooFine when a non-zero
///   digit lies beyond the scale and rounding is not asked for.
Result<std::int64_t> parse_decimal(std::string_view text, const DecimalSyntax& syntax);

/// Appends value / 10^scale as the shortest exact decimal: `25.021`, `25`, `-0.75`.
void append_decimal(std::string& out, std::int64_t value, int scale);

std::string format_decimal(std::int64_t value, int scale);

/// Room for any decimal: its sign, 19 digits, a zero before the point, the point.
inline constexpr std::size_t kDecimalRoom = 24;
/// Writes a decimal as append_decimal to a buffer with enough room. @param scale from 0 to 18.
/// @returns the end of the text.
char* write_decimal(char* to, std::int64_t value, int scale);

/// A length, or a difference of lengths, in whole nanometres: exact in every sum and comparison.
/// As doubles, 25 % of all `size + deviation / 1000` differ from the exact decimal. Doubles cross
/// at `nearest_mm` and `to_mm` only.
class Length {
 public:
  constexpr Length() = default;

  static constexpr Length nanometres(std::int64_t count) { return Length(count); }
  static constexpr Length micrometres(std::int64_t count) { return Length(count * 1'000); }
  static constexpr Length millimetres(std::int64_t count) { return Length(count * 1'000'000); }

  /// Returns the nearest nanometre to a floating-point value in mm, half away from zero.
  /// @errors LengthOutOfRange if it is not finite or beyond 1e12 mm.
  static Result<Length> nearest_mm(double millimetres);

  constexpr std::int64_t count() const { return nanometres_; }

  /// The nearest double, in mm: not exact.
  constexpr double to_mm() const { return static_cast<double>(nanometres_) / 1e6; }

  constexpr Length operator-() const { return Length(-nanometres_); }
  constexpr Length& operator+=(Length other) { return *this = *this + other; }
  constexpr Length& operator-=(Length other) { return *this = *this - other; }
  friend constexpr Length operator+(Length a, Length b) {
    return Length(a.nanometres_ + b.nanometres_);
  }
  friend constexpr Length operator-(Length a, Length b) {
    return Length(a.nanometres_ - b.nanometres_);
  }
  friend constexpr Length operator*(Length a, std::int64_t factor) {
    return Length(a.nanometres_ * factor);
  }
  // NOLINTNEXTLINE(modernize-use-nullptr): the zero is the compiler's
  friend constexpr auto operator<=>(Length, Length) = default;

 private:
  explicit constexpr Length(std::int64_t count) : nanometres_(count) {}

  std::int64_t nanometres_ = 0;
};

/// The largest magnitude read from text: 1e9 mm. Sums of a few such lengths still fit 64 bits.
inline constexpr Length kLongest = Length::millimetres(1'000'000'000);

/// Reads a length in millimetres, to the nanometre whatever the scale of the syntax. Paths,
/// queries, designations and CSV may have a decimal comma, JSON numbers an exponent, and measured
/// values are rounded.
/// @errors LengthMalformed, LengthTooFine, LengthOutOfRange (beyond ±kLongest).
Result<Length> parse_length_mm(std::string_view text, DecimalSyntax syntax = {});

/// Reads a length in micrometres; otherwise as parse_length_mm.
Result<Length> parse_length_um(std::string_view text, DecimalSyntax syntax = {});

/// The shortest exact decimal in mm (`25.021`) or µm (`-0.75`).
void append_mm(std::string& out, Length length);
void append_um(std::string& out, Length length);
std::string format_mm(Length length);
std::string format_um(Length length);

}  // namespace fitgauge
