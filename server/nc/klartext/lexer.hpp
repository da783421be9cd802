#pragma once

#include "nc/klartext/diagnostic.hpp"

namespace fitgauge::klartext {

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }
inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') <= 9; }

/// Up to seven digits at the begin of a text.
struct DigitRun {
  std::uint64_t value = 0;
  unsigned count = 0;  ///< 8: eight digits or more
};

/// Reads the digits among the next eight bytes at once, which must exist: each byte is tested for
/// being a digit, then neighbours are joined to numbers of two, four and eight digits.
inline DigitRun scan_digits(const char* at) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, at, sizeof bytes);
  bytes ^= 0x3030303030303030;  // digits become 0 to 9
  const std::uint64_t others = ((bytes + 0x7676767676767676) | bytes) & 0x8080808080808080;
  const auto count = static_cast<unsigned>(std::countr_zero(others)) / 8;
  if (count == 0 || count == 8) return {0, count};
  bytes <<= 64 - 8 * count;  // zeros before the first digit
  bytes = (bytes * 10 + (bytes >> 8)) & 0x00FF00FF00FF00FF;
  bytes = (bytes * 100 + (bytes >> 16)) & 0x0000FFFF0000FFFF;
  bytes = (bytes * 10'000 + (bytes >> 32)) & 0x00000000FFFFFFFF;
  return {bytes, count};
}

/// Scans a number of one to seven digits with at most seven decimals, the usual form. The digits
/// and the power of ten are exact in a double, so their quotient is the double nearest to the
/// literal.
/// @returns the end of the number, or nullptr if it has another form or is near the end.
inline const char* scan_plain_number(const char* at, const char* end, double& value) {
  constexpr std::ptrdiff_t kLongest = 7 + 1 + 8;
  constexpr unsigned kMostDigits = 7;
  constexpr std::uint64_t kPowersOfTen[] = {1,      10,      100,       1'000,
                                            10'000, 100'000, 1'000'000, 10'000'000};
  if (end - at < kLongest) return nullptr;
  const DigitRun whole = scan_digits(at);
  if (whole.count == 0 || whole.count > kMostDigits) return nullptr;
  at += whole.count;
  if (*at == ',') return nullptr;
  if (*at != '.') {
    value = static_cast<double>(whole.value);
    return at;
  }
  const DigitRun fraction = scan_digits(++at);
  if (fraction.count > kMostDigits) return nullptr;
  const std::uint64_t power = kPowersOfTen[fraction.count];
  value = static_cast<double>(whole.value * power + fraction.value) / static_cast<double>(power);
  return at + fraction.count;
}

/// The reason why a block cannot be read. FeatureUnsupported: it is Klartext of real controls that
/// this one cannot run; any other code is an error.
struct Failure {
  DiagnosticCode code = DiagnosticCode::SyntaxError;
  Slice<char> place;
  std::string message;    ///< of FeatureUnsupported: the feature's name
  std::string instead{};  ///< the text that is right in this place, if known
};

/// The value of what cannot be read: empty, and dropped with the block. Not for functions that
/// return std::optional, which would then have a value.
struct Dropped {
  template <class T>
  operator T() const {  // NOLINT: of any type
    return {};
  }
};

/// Reads the characters of one block at a time. Refers to the source, which must end with a NUL
/// like every std::string.
///
/// After `fail` or `refuse` the lexer is at the end of the block and reads nothing more, so callers
/// need not check each step: loops end, and their results are dropped with the block. Only the
/// first failure of a block counts.
class Lexer {
 public:
  explicit Lexer(const std::string& source) : source_(source) {}

  /// Opens the block with these offsets, without its last line end.
  void open(std::size_t begin, std::size_t end);
  /// Extends the block to this offset.
  void extend(std::size_t end) { end_ = source_.data() + end; }

  const std::optional<Failure>& failure() const { return failure_; }
  Dropped fail(DiagnosticCode code, Slice<char> place, std::string message,
               std::string instead = {});
  /// Fails at the next character: "expected <what>, found 'x'".
  Dropped fail_expected(std::string_view what);
  /// The block uses a feature that only real controls have, named by the code since `begin`.
  Dropped refuse(const char* begin, std::string_view feature);

  /// Passes blanks and wraps (`~` at the end of a physical line). @returns the place behind them.
  const char* skip_blanks() {
    const char* at = at_;
    while (is_blank(*at)) ++at;
    at_ = at;
    if (*at == '~') skip_wraps();
    return at_;
  }
  /// Returns true at the end of the block or a comment.
  bool at_end() {
    skip_blanks();
    return at_ == end_ || *at_ == ';';
  }

  const char* at() const { return at_; }
  const char* end() const { return end_; }
  const char* source_end() const { return source_.data() + source_.size(); }
  void move_to(const char* place) { at_ = place; }
  char peek(std::size_t ahead = 0) const { return at_ + ahead < end_ ? at_[ahead] : '\0'; }
  Slice<char> place(const char* begin, const char* end) const;
  Slice<char> since(const char* begin) const { return place(begin, at_); }
  Slice<char> here() const { return place(at_, at_ < end_ ? at_ + 1 : at_); }

  /// Each of these passes blanks first and stays in place when it does not match.
  bool accept(char c);
  /// A whole word without regard to case: not followed by a letter, a digit or `_`.
  bool accept_word(std::string_view word);
  /// Accepts a word that a number or parameter may follow directly: `DEF` of `DEF9.0`.
  bool accept_joined(std::string_view word);
  /// The first characters of a word: `REP` of `REP2`, `DAT` of `DAT+Q50`, `SRC_` of `SRC_QS1`.
  bool accept_prefix(std::string_view prefix);
  void expect(char c);
  void expect_word(std::string_view word);
  void expect_joined(std::string_view word);
  void expect_prefix(std::string_view prefix);

  /// The letters from here on, at most up to a parameter (`FQ5` gives `F`). Stays in place.
  std::string_view letters();

  /// A number without sign: `10`, `10.5`, `10,5`, `.5`, `10.`
  bool at_number() const {
    return is_digit(*at_) || ((*at_ == '.' || *at_ == ',') && is_digit(at_[1]));
  }
  double number();
  /// Whole digits, for block, label, cycle and function numbers; fails above `largest`.
  std::uint32_t digits(std::uint32_t largest, std::string_view what);

  /// `Q5`, `QL3`, `QR1`, `QS2`: a parameter starts here.
  bool at_parameter() const { return is_parameter(at_); }
  QRef parameter();

  /// The characters between double quotes, in one physical line.
  std::string_view quoted();

  /// Returns the code from here to its end, without surrounding blanks and wraps, and moves to the
  /// end. May contain wraps.
  std::string_view rest();

  /// Returns rest() up to the first of `stop`, which is not consumed.
  std::string_view rest_until(char stop);

 private:
  static bool is_parameter(const char* at) {
    if ((*at | 0x20) != 'q') return false;
    if (is_digit(at[1])) return true;
    const char space = static_cast<char>(at[1] | 0x20);
    return (space == 'l' || space == 'r' || space == 's') && is_digit(at[2]);
  }
  void skip_wraps();
  bool matches(std::string_view text) const;

  const std::string& source_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  std::optional<Failure> failure_;
};

/// A line without the `~` that continues its block.
std::string_view without_wrap(std::string_view text);

/// Code without its wraps: each is a blank.
std::string unwrapped(std::string_view code);

/// Returns the code at the end of a block without its wraps, and without blanks or `~` at the end,
/// which would be a wrap when the block is printed.
std::string free_text(std::string_view code);

/// Returns the text of a comment. The control wraps comments in the middle of words.
std::string comment_text(std::string_view comment);

/// Returns an excerpt for a message, with a limit of bytes.
std::string excerpt(std::string_view text, std::size_t longest = 40);

}  // namespace fitgauge::klartext
