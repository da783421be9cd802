#pragma once

namespace fitgauge {

/// Fills the span from its front; 0 at the end of the input.
using Read = std::function<Result<std::size_t>(std::span<char>)>;

/// Reads a text from memory. @param text outlives it.
inline Read read_text(std::string_view text) {
  return [text](std::span<char> into) mutable -> Result<std::size_t> {
    const std::size_t count = text.copy(into.data(), into.size());
    text.remove_prefix(count);
    return count;
  };
}

}  // namespace fitgauge

namespace fitgauge::sheet {

enum class Encoding { Detected, Utf8, Utf16, Windows1252 };

/// `auto`, `utf-8`, `utf-16`, `windows-1252` (also `latin-1` and `iso-8859-1`), in either case.
std::optional<Encoding> encoding_from_word(std::string_view word);

/// Removes surrounding blanks and line ends, and joins several blanks to one.
std::string squeezed(std::string_view text);
/// The next line, without its end, from the front of a text.
std::string_view take_text_line(std::string_view& text);

/// Converts a text of a file to UTF-8, unless it is UTF-16. Detects UTF-8 if it is valid; otherwise
/// Windows-1252. @errors TextEncoding with the byte.
Result<std::string> to_utf8(std::string_view bytes, Encoding encoding);

/// Returns the encoding of a text. It is the encoding of its mark. Without a mark it is UTF-16 if
/// every second byte of the beginning is 0, UTF-8 if it is valid, and otherwise Windows-1252. Reads
/// all.
Result<Encoding> detected_encoding(const Read& read);

/// A text of any size as UTF-8 without its mark, in pieces. Not thread-safe; unusable after an
/// error.
class Utf8Input {
 public:
  /// @param first, again two readers of one text: `first` only detects the encoding.
  static Result<Utf8Input> open(const Read& first, Read again, Encoding encoding) {
    if (encoding == Encoding::Detected) encoding = TRY(detected_encoding(first));
    return Utf8Input(std::move(again), encoding);
  }

  /// Appends the next piece. @returns false at the end. @errors TextEncoding with the byte,
  /// counted after a mark.
  Result<bool> append(std::string& out);

 private:
  Utf8Input(Read read, Encoding encoding) : read_(std::move(read)), encoding_(encoding) {}

  /// Reads more after the bytes that are not decoded yet.
  Result<void> fill();

  Read read_;
  Encoding encoding_;
  std::string bytes_{};   ///< that are read and not decoded yet
  std::uint64_t at_ = 0;  ///< their place in the text
  bool is_big_ = false;   ///< of UTF-16
  bool is_begun_ = false;
  bool is_at_end_ = false;
};

}  // namespace fitgauge::sheet
