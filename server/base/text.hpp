#pragma once

namespace fitgauge {

/// The word of a value of an enumeration that counts from 0.
template <class E, std::size_t size>
constexpr std::string_view word_of(E value, const std::string_view (&words)[size]) {
  return words[static_cast<std::size_t>(value)];
}

/// The value of an enumeration whose words these are, from `first` on.
template <class E>
constexpr std::optional<E> enum_of(std::string_view text, const auto& words, int first = 0) {
  const auto found = std::ranges::find(words, text);
  if (found == std::ranges::end(words)) return std::nullopt;
  return static_cast<E>(found - std::ranges::begin(words) + first);
}

/// Reads a whole text as a number; none for blanks, a plus sign, other text, or out of range.
template <class T>
std::optional<T> read_number(std::string_view text, int base = 10) {
  T value{};
  const char* const end = text.data() + text.size();
  std::from_chars_result read{};
  if constexpr (std::is_floating_point_v<T>) {
    read = std::from_chars(text.data(), end, value);
  } else {
    read = std::from_chars(text.data(), end, value, base);
  }
  return read.ec == std::errc() && read.ptr == end ? std::optional(value) : std::nullopt;
}

/// Offset of the first byte that is not UTF-8 (RFC 3629: no surrogates or overlong forms), or npos.
std::size_t find_invalid_utf8(std::string_view text);

inline bool is_utf8(std::string_view text) {
  return find_invalid_utf8(text) == std::string_view::npos;
}

/// Returns the first characters of `text` in at most `most` bytes, up to the first byte that is not
/// UTF-8. A message with half a character could not be sent as JSON.
inline std::string_view first_characters(std::string_view text, std::size_t most) {
  text = text.substr(0, most);
  return text.substr(0, find_invalid_utf8(text));
}

/// @param point a code point that is no surrogate
void append_utf8(std::string& out, char32_t point);

/// Removes the first character from a text of UTF-8. @pre the text is not empty
char32_t take_character(std::string_view& text);

/// Windows-1252 as UTF-8; its five undefined bytes become the C1 controls of the same number.
std::string utf8_from_windows1252(std::string_view bytes);

/// Text of any program: as it is, or read as Windows-1252 if it is not UTF-8.
inline std::string as_utf8(std::string_view text) {
  return is_utf8(text) ? std::string(text) : utf8_from_windows1252(text);
}

constexpr char ascii_upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr char ascii_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
constexpr bool is_ascii_letter(char c) { return ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z'; }
constexpr bool is_ascii_alphanumeric(char c) {
  return is_ascii_letter(c) || (c >= '0' && c <= '9');
}
std::string ascii_upper(std::string_view text);
std::string ascii_lower(std::string_view text);
bool ascii_iequals(std::string_view a, std::string_view b);

/// Returns the text without leading and trailing blanks and tabs.
std::string_view trim(std::string_view text);

/// Removes the text up to the next separator and the separator. @returns the text before it.
constexpr std::string_view take_field(std::string_view& rest, char separator) {
  const std::string_view text = rest.substr(0, rest.find(separator));
  rest.remove_prefix(std::min(text.size() + 1, rest.size()));
  return text;
}
/// The texts between separators: one more than there are separators.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts(
      static_cast<std::size_t>(std::ranges::count(text, separator)) + 1);
  for (std::string_view& part : parts) part = take_field(text, separator);
  return parts;
}

/// Whether a name is of a pattern with `*` and `?`; letters count in either case.
bool matches_glob(std::string_view pattern, std::string_view name);
/// Whether a name can be of both patterns.
bool globs_overlap(std::string_view one, std::string_view other);

/// Whether XML 1.0 can hold a UTF-8 text: no controls except tab and line ends, no U+FFFE, U+FFFF.
bool is_xml_text(std::string_view text);

/// Escapes `text` as content of an element or an attribute. Tabs and line ends become references,
/// so that readers keep them; characters that XML cannot hold become blanks.
std::string xml_text(std::string_view text);

/// Finds the known word with the spelling nearest to an unknown one, case-insensitively.
class SpellingHint {
 public:
  explicit SpellingHint(std::string_view word);
  void consider(std::string_view known);
  /// The known word; empty when none is near enough.
  const std::string& word() const { return best_; }
  /// "; did you mean CYCL?", or nothing when no word is near enough.
  std::string text() const;

 private:
  std::string word_;
  std::string best_;
  std::size_t distance_;
};

/// A place in a text: line and column count from 1, columns in characters (code points).
struct SourcePosition {
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  friend auto operator<=>(const SourcePosition&, const SourcePosition&) = default;
};

/// A range from `begin` to before `end`.
struct SourceRange {
  SourcePosition begin;
  SourcePosition end;

  friend auto operator<=>(const SourceRange&, const SourceRange&) = default;
};

}  // namespace fitgauge
