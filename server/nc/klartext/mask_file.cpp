#include "nc/klartext/mask_file.hpp"

#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {
namespace {

constexpr int kLargestWidth = 255;
constexpr int kMostDecimals = 16;

// The words of each enumeration, in its order.
constexpr std::string_view kKeywords[] = {"CALL_PATH", "HOUR",      "MIN",   "SEC",  "DAY",
                                          "MONTH",     "STR_MONTH", "YEAR2", "YEAR4"};
constexpr std::string_view kControls[] = {"M_CLOSE",    "M_APPEND",     "",  // M_APPEND_MAX20
                                          "M_TRUNCATE", "M_EMPTY_HIDE", "M_EMPTY_SHOW"};
constexpr std::string_view kLanguages[] = {
    "L_ENGLISH", "L_GERMAN",    "L_DUTCH",    "L_ITALIAN",  "L_POLISH",       "L_ALL",
    "L_CZECH",   "L_FRENCH",    "L_SPANISH",  "L_PORTUGUE", "L_SWEDISH",      "L_DANISH",
    "L_FINNISH", "L_HUNGARIA",  "L_RUSSIAN",  "L_CHINESE",  "L_CHINESE_TRAD", "L_SLOVENIAN",
    "L_KOREAN",  "L_NORWEGIAN", "L_ROMANIAN", "L_SLOVAK",   "L_TURKISH"};

/// A value and whether it is a text.
struct Argument {
  MaskValue value{};
  bool text = false;
  Slice<char> place{};
};

/// Reads the text between the quotes: escapes, placeholders and plain characters.
class FormatReader {
 public:
  FormatReader(Lexer& in, MaskFormat& format) : in_(in), format_(format) {}

  /// Reads from the opening quote to the closing one.
  void read() {
    const char* opening = in_.at() - 1;
    while (in_.at() != in_.end() && in_.peek() != '"') {
      const char c = in_.peek();
      if (c == '\\') {
        read_escape();
      } else if (c == '%') {
        read_placeholder();
      } else {
        take();
        literal_ += c;
      }
    }
    flush();
    if (in_.at() == in_.end()) {
      in_.fail(DiagnosticCode::StringUnterminated, in_.place(opening, in_.end()),
               "the text has no closing double quote");
      return;
    }
    take();
  }

 private:
  char take() {
    const char c = in_.peek();
    in_.move_to(in_.at() + 1);
    return c;
  }

  /// `\n`, `\"`, `\\`; a backslash before another character is one, as in a path.
  void read_escape() {
    take();
    switch (in_.peek()) {
      case 'n': literal_ += '\n'; break;
      case '"': literal_ += '"'; break;
      case '\\': literal_ += '\\'; break;
      default: literal_ += '\\'; return;
    }
    take();
  }

  void flush() {
    if (!literal_.empty()) format_.pieces.emplace_back(std::exchange(literal_, {}));
  }

  void read_placeholder() {
    const char* begin = in_.at();
    take();
    if (in_.peek() == '%') {
      literal_ += take();
      return;
    }
    MaskPlaceholder placeholder;
    read_flags(placeholder);
    const bool in_range = read_count(placeholder.width, kLargestWidth) &&
                          (in_.peek() != '.' || (take(), read_decimals(placeholder)));
    if (!in_range || !read_conversion(placeholder)) {
      in_.fail(DiagnosticCode::MaskPlaceholderMalformed,
               in_.place(begin, std::max(in_.at(), begin + 1)),
               "not a placeholder such as %9.4LF, %D, %S or %RS; a percent sign is written %%");
      return;
    }
    flush();
    format_.pieces.emplace_back(placeholder);
  }

  void read_flags(MaskPlaceholder& placeholder) {
    for (;; take()) {
      switch (in_.peek()) {
        case '+': placeholder.plus = true; break;
        case '-': placeholder.left = true; break;
        case '0': placeholder.zero = true; break;
        default: return;
      }
    }
  }

  bool read_count(int& count, int largest) {
    for (; is_digit(in_.peek()); take()) {
      count = count * 10 + (in_.peek() - '0');
      if (count > largest) return false;
    }
    return true;
  }

  bool read_decimals(MaskPlaceholder& placeholder) {
    placeholder.decimals = 0;
    return read_count(placeholder.decimals, kMostDecimals);
  }

  bool read_conversion(MaskPlaceholder& placeholder) {
    if (in_.at() == in_.end()) return false;
    const char first = ascii_upper(in_.peek());
    const char second = ascii_upper(in_.peek(1));
    if (first == 'R' && second == 'S') {
      take();
      take();
      placeholder.conversion = MaskConversion::RawString;
      return true;
    }
    if (first == 'L' && (second == 'F' || second == 'D' || second == 'I')) take();
    switch (ascii_upper(take())) {
      case 'F': placeholder.conversion = MaskConversion::Float; return true;
      case 'D':
      case 'I': placeholder.conversion = MaskConversion::Integer; return true;
      case 'S': placeholder.conversion = MaskConversion::String; return true;
      case 'C': placeholder.conversion = MaskConversion::Character; return true;
      default: return false;
    }
  }

  Lexer& in_;
  MaskFormat& format_;
  std::string literal_;
};

Argument parse_argument(Lexer& in) {
  const char* begin = in.skip_blanks();
  if (const auto keyword = accept_name<MaskKeyword>(in, kKeywords)) {
    const bool is_text = *keyword == MaskKeyword::CallPath || *keyword == MaskKeyword::MonthName;
    return {*keyword, is_text, in.since(begin)};
  }
  if (!in.at_parameter()) return in.fail_expected("a Q parameter or a keyword such as HOUR");
  const QRef parameter = in.parameter();
  return {parameter, parameter.is_string(), in.since(begin)};
}

bool shows_text(MaskConversion conversion) {
  return conversion == MaskConversion::String || conversion == MaskConversion::RawString;
}

void bind(Lexer& in, MaskPlaceholder& placeholder, const Argument& argument) {
  if (shows_text(placeholder.conversion) != argument.text) {
    in.fail(DiagnosticCode::MaskValueType, argument.place,
            argument.text ? "a text needs %S or %RS" : "a number needs %F or %D");
  }
  placeholder.value = argument.value;
}

/// Reads `"text %9.4LF", Q1`: the text with its placeholders and the value of each.
/// @param unused the place of the first value that no placeholder shows.
MaskFormat parse_mask_format(Lexer& in, std::optional<Slice<char>>& unused) {
  MaskFormat format;
  in.expect('"');
  FormatReader(in, format).read();
  for (MaskPiece& piece : format.pieces) {
    auto* placeholder = std::get_if<MaskPlaceholder>(&piece);
    if (placeholder == nullptr) continue;
    if (!in.accept(',')) {
      in.fail(DiagnosticCode::MaskValueMissing, in.here(),
              "the text has more placeholders than values: name one for each");
      break;
    }
    bind(in, *placeholder, parse_argument(in));
  }
  while (in.accept(',')) {
    // A comma may end the line.
    if (in.at_end()) break;
    const Argument argument = parse_argument(in);
    if (!unused) unused = argument.place;
  }
  return format;
}

constexpr std::uint32_t kMostKilobytes = 1'000'000;

std::variant<MaskFormat, MaskControl, MaskLanguage> parse_keyword(Lexer& in) {
  if (const auto kind = accept_name<MaskControlKind>(in, kControls)) return MaskControl{*kind};
  if (in.accept_prefix("M_APPEND_MAX")) {
    const std::uint32_t kilobytes = in.digits(kMostKilobytes, "the number of kilobytes");
    return MaskControl{.kind = MaskControlKind::AppendMax,
                       .kilobytes = static_cast<int>(kilobytes)};
  }
  if (const auto language = accept_name<MaskLanguage>(in, kLanguages))
    return std::min(*language, MaskLanguage::Other);
  const char* begin = in.at();
  const std::string_view word = in.rest();
  in.fail(DiagnosticCode::MaskKeywordUnknown, in.place(begin, begin + word.size()),
          fmt::format("'{}' is neither a text in double quotes nor a keyword such as L_ENGLISH or "
                      "M_CLOSE",
                      excerpt(word)));
  return MaskControl{};
}

/// Splits a mask into its physical lines and makes an entry of each.
class MaskParser {
 public:
  MaskParser(std::string source, std::string name)
      : source_(std::move(source)), in_(source_), diagnostics_(source_, line_starts_, name) {
    parsed_.mask.file_name = std::move(name);
  }

  ParsedMask parse() && {
    for (std::size_t begin = 0; begin < source_.size();) {
      line_starts_.push_back(static_cast<std::uint32_t>(begin));
      const std::size_t end = std::min(source_.find('\n', begin), source_.size());
      parse_line(begin, end);
      begin = end + 1;
    }
    parsed_.diagnostics = diagnostics_.take();
    return std::move(parsed_);
  }

 private:
  void parse_line(std::size_t begin, std::size_t end) {
    in_.open(begin, end);
    if (in_.at_end() || in_.peek() == '*') return;
    MaskLine line{.line = static_cast<std::uint32_t>(line_starts_.size())};
    std::optional<Slice<char>> unused;
    if (in_.peek() == '"') {
      line.content = parse_mask_format(in_, unused);
    } else {
      line.content = parse_keyword(in_);
    }
    if (!in_.at_end()) in_.fail_expected("';' or the end of the line");
    if (const auto& failure = in_.failure()) {
      diagnostics_.add(Severity::Error, failure->code, failure->place, failure->message);
      return;
    }
    if (unused) {
      diagnostics_.add(Severity::Warning, DiagnosticCode::MaskValueUnused, *unused,
                       "the text has no placeholder for this value");
    }
    parsed_.mask.lines.push_back(std::move(line));
  }

  std::string source_;
  std::vector<std::uint32_t> line_starts_;
  Lexer in_;
  DiagnosticList diagnostics_;
  ParsedMask parsed_;
};

}  // namespace

ParsedMask parse_mask(std::string bytes, std::string name) {
  if (bytes.size() > kLargestMask)
    return {
        {},
        too_large(fmt::format("the mask has more than {} bytes", kLargestMask), std::move(name))};
  return MaskParser(decode_source(std::move(bytes)), std::move(name)).parse();
}

}  // namespace fitgauge::klartext
