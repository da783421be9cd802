#include "nc/klartext/mask_file.hpp"

#include "base/text.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/lexer.hpp"
#include "nc/klartext/mask_format.hpp"
#include "nc/klartext/source_text.hpp"

namespace fitgauge::klartext {
namespace {

constexpr std::uint32_t kMostKilobytes = 1'000'000;

struct ControlName {
  std::string_view name;
  MaskControlKind kind;
};

constexpr ControlName kControls[] = {
    {"M_CLOSE", MaskControlKind::Close},          {"M_APPEND", MaskControlKind::Append},
    {"M_TRUNCATE", MaskControlKind::Truncate},    {"M_EMPTY_HIDE", MaskControlKind::EmptyHide},
    {"M_EMPTY_SHOW", MaskControlKind::EmptyShow},
};

/// In the order of MaskLanguage.
constexpr std::string_view kLanguages[] = {
    "L_ENGLISH",   "L_GERMAN",   "L_CZECH",   "L_FRENCH",       "L_ITALIAN",   "L_SPANISH",
    "L_PORTUGUE",  "L_SWEDISH",  "L_DANISH",  "L_FINNISH",      "L_DUTCH",     "L_POLISH",
    "L_HUNGARIA",  "L_RUSSIAN",  "L_CHINESE", "L_CHINESE_TRAD", "L_SLOVENIAN", "L_KOREAN",
    "L_NORWEGIAN", "L_ROMANIAN", "L_SLOVAK",  "L_TURKISH",      "L_ALL"};

std::variant<MaskFormat, MaskControl, MaskLanguage> parse_keyword(Lexer& in) {
  for (const ControlName& row : kControls) {
    if (in.accept_word(row.name)) return MaskControl{.kind = row.kind};
  }
  if (in.accept_prefix("M_APPEND_MAX")) {
    const std::uint32_t kilobytes = in.digits(kMostKilobytes, "the number of kilobytes");
    return MaskControl{.kind = MaskControlKind::AppendMax,
                       .kilobytes = static_cast<int>(kilobytes)};
  }
  for (std::size_t i = 0; i < std::size(kLanguages); ++i) {
    if (in.accept_word(kLanguages[i])) return static_cast<MaskLanguage>(i);
  }
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
  if (bytes.size() > kLargestMask) {
    ParsedMask refused;
    refused.diagnostics.push_back(
        {.code = DiagnosticCode::ProgramTooLarge,
         .message = fmt::format("the mask has more than {} bytes", kLargestMask),
         .program = std::move(name)});
    return refused;
  }
  return MaskParser(decode_source(std::move(bytes)), std::move(name)).parse();
}

}  // namespace fitgauge::klartext
