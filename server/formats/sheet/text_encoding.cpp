#include "formats/sheet/text_encoding.hpp"

namespace fitgauge::sheet {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
constexpr std::string_view kLittleMark = "\xFF\xFE";
constexpr std::string_view kBigMark = "\xFE\xFF";
constexpr std::size_t kLooked = 64;           ///< bytes of the beginning
constexpr std::size_t kLongestCharacter = 4;  ///< of UTF-8
constexpr std::size_t kPiece = std::size_t{1} << 16;

/// Reads the next piece and appends it. @returns its number of bytes; 0 at the end
Result<std::size_t> read_on(const Read& read, std::string& bytes) {
  const std::size_t size = bytes.size();
  bytes.resize(size + kPiece);
  auto count = read(std::span(bytes).subspan(size));
  bytes.resize(size + (count ? *count : 0));
  return count;
}

/// Returns the number of zero bytes at even or odd places of the beginning.
std::size_t zeros(std::string_view bytes, std::size_t parity) {
  std::size_t count = 0;
  for (std::size_t i = parity; i < std::min(bytes.size(), kLooked); i += 2) {
    if (bytes[i] == '\0') ++count;
  }
  return count;
}

bool looks_like_utf16(std::string_view bytes) {
  const std::size_t half = std::min(bytes.size(), kLooked) / 2;
  return half >= 2 && std::max(zeros(bytes, 0), zeros(bytes, 1)) * 4 >= half * 3;
}

Error no_utf16(std::uint64_t at) {
  return {ErrorCode::TextEncoding, fmt::format("byte {} is not UTF-16", at)};
}

Error no_utf8(std::uint64_t at) {
  return {ErrorCode::TextEncoding,
          fmt::format("byte {} is not UTF-8: name the encoding, such as windows-1252", at)};
}

bool has_utf16_mark(std::string_view bytes) {
  return bytes.starts_with(kLittleMark) || bytes.starts_with(kBigMark);
}

bool is_big_endian(std::string_view bytes) {
  if (has_utf16_mark(bytes)) return bytes.starts_with(kBigMark);
  return zeros(bytes, 0) > zeros(bytes, 1);
}

/// Appends the whole characters at the front of a text. @param at place of the text, for the error
/// @returns their number of bytes.
Result<std::size_t> append_utf16(std::string& out, std::string_view bytes, bool is_big,
                                 std::uint64_t at) {
  const auto unit = [&](std::size_t place) {
    const auto first = static_cast<std::uint8_t>(bytes[place]);
    const auto second = static_cast<std::uint8_t>(bytes[place + 1]);
    return static_cast<std::uint32_t>(is_big ? first << 8 | second : second << 8 | first);
  };
  std::size_t done = 0;
  while (done + 1 < bytes.size()) {
    std::uint32_t point = unit(done);
    if (point >= 0xDC00 && point < 0xE000) return no_utf16(at + done);
    if (point >= 0xD800 && point < 0xDC00) {
      if (done + 3 >= bytes.size()) break;
      const std::uint32_t low = unit(done + 2);
      if (low < 0xDC00 || low >= 0xE000) return no_utf16(at + done);
      point = 0x10000 + ((point - 0xD800) << 10) + (low - 0xDC00);
      done += 2;
    }
    append_utf8(out, point);
    done += 2;
  }
  return done;
}

/// Number of bytes of whole characters at the front of a text; the rest of a character may follow.
std::size_t valid_utf8(std::string_view bytes) {
  return std::min(find_invalid_utf8(bytes), bytes.size());
}

}  // namespace

std::string squeezed(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!is_blank) out += c;
    if (is_blank && !out.empty() && out.back() != ' ') out += ' ';
  }
  return std::string(trim(out));
}

std::string_view take_text_line(std::string_view& text) {
  std::string_view line = take_field(text, '\n');
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::optional<Encoding> encoding_from_word(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Encoding>, 6> kWords = {
      {{"auto", Encoding::Detected},
       {"utf-8", Encoding::Utf8},
       {"utf-16", Encoding::Utf16},
       {"windows-1252", Encoding::Windows1252},
       {"latin-1", Encoding::Windows1252},
       {"iso-8859-1", Encoding::Windows1252}}};
  for (const auto& [known, encoding] : kWords) {
    if (ascii_iequals(word, known)) return encoding;
  }
  return std::nullopt;
}

Result<std::string> to_utf8(std::string_view bytes, Encoding encoding) {
  const bool is_detected = encoding == Encoding::Detected && !is_utf8(bytes);
  if (encoding == Encoding::Windows1252 || is_detected) return utf8_from_windows1252(bytes);
  if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
  if (const std::size_t at = valid_utf8(bytes); at < bytes.size()) return no_utf8(at);
  return std::string(bytes);
}

Result<Encoding> detected_encoding(const Read& read) {
  std::string bytes;
  bool is_begun = false;
  for (;;) {
    const auto count = TRY(read_on(read, bytes));
    const bool is_at_end = count == 0;
    if (!is_begun && !is_at_end && bytes.size() < kLooked) continue;
    if (!std::exchange(is_begun, true) && (has_utf16_mark(bytes) || looks_like_utf16(bytes)))
      return Encoding::Utf16;
    bytes.erase(0, valid_utf8(bytes));
    if (bytes.size() >= kLongestCharacter || (is_at_end && !bytes.empty()))
      return Encoding::Windows1252;
    if (is_at_end) return Encoding::Utf8;
  }
}

Result<void> Utf8Input::fill() {
  do {
    const auto count = TRY(read_on(read_, bytes_));
    is_at_end_ = count == 0;
  } while (!is_begun_ && !is_at_end_ && bytes_.size() < kLooked);
  if (std::exchange(is_begun_, true)) return {};
  is_big_ = is_big_endian(bytes_);
  if (encoding_ == Encoding::Utf16 && has_utf16_mark(bytes_)) bytes_.erase(0, kBigMark.size());
  if (encoding_ == Encoding::Utf8 && bytes_.starts_with(kUtf8Mark))
    bytes_.erase(0, kUtf8Mark.size());
  return {};
}

Result<bool> Utf8Input::append(std::string& out) {
  if (is_at_end_) return false;
  TRY(fill());
  std::size_t done = bytes_.size();
  if (encoding_ == Encoding::Utf16) {
    done = TRY(append_utf16(out, bytes_, is_big_, at_));
    if (is_at_end_ && done < bytes_.size()) return no_utf16(at_ + done);
  } else if (encoding_ == Encoding::Windows1252) {
    out += utf8_from_windows1252(bytes_);
  } else {
    done = valid_utf8(bytes_);
    const bool is_cut = !is_at_end_ && bytes_.size() - done < kLongestCharacter;
    if (done < bytes_.size() && !is_cut) return no_utf8(at_ + done);
    out.append(bytes_, 0, done);
  }
  bytes_.erase(0, done);
  at_ += done;
  return true;
}

}  // namespace fitgauge::sheet
