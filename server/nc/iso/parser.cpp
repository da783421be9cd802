#include "nc/iso/parser.hpp"

#include "nc/iso/translation.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::iso {
namespace {

using klartext::Diagnostic;
using klartext::DiagnosticCode;
using klartext::Program;
using klartext::Slice;

/// In a longer line, a finding names the whole block.
constexpr std::size_t kLongestSearched = 1000;

/// The places of a translation's Klartext in the text it was made of.
class Origin {
 public:
  Origin(const std::string& source, const Translation& translation, std::string_view klartext)
      : source_(source), lines_(translation.lines), klartext_(klartext) {
    starts_.reserve(lines_.size() + 1);
    starts_.push_back(0);
    for (std::size_t at = klartext.find('\n'); at != klartext.npos;
         at = klartext.find('\n', at + 1)) {
      starts_.push_back(static_cast<std::uint32_t>(at + 1));
    }
  }

  std::size_t line_of(std::size_t offset) const {
    const auto next = std::upper_bound(starts_.begin() + 1, starts_.end(), offset);
    return static_cast<std::size_t>(next - starts_.begin()) - 1;
  }

  /// Returns the place of the text in this line of the block, else of the whole block.
  Slice<char> place(std::size_t first_line, std::size_t last_line, std::string_view text) const {
    if (lines_.empty()) return {};
    const Slice<char> first = lines_[std::min(first_line, lines_.size() - 1)];
    const Slice<char> last = lines_[std::min(last_line, lines_.size() - 1)];
    if (first_line == last_line && first.count <= kLongestSearched && !text.empty()) {
      const std::size_t found =
          std::string_view(source_).substr(first.first, first.count).find(text);
      if (found != text.npos) {
        return {first.first + static_cast<std::uint32_t>(found),
                static_cast<std::uint32_t>(text.size())};
      }
    }
    return {first.first, last.first + last.count - first.first};
  }
  Slice<char> place(Slice<char> here) const {
    return place(line_of(here.first), line_of(here.first + here.count),
                 klartext_.substr(here.first, here.count));
  }

 private:
  const std::string& source_;
  const std::vector<Slice<char>>& lines_;
  std::string_view klartext_;
  std::vector<std::uint32_t> starts_;
};

/// The parser's messages about the frame of a program, in the words of DIN/ISO.
std::string_view frame_message(DiagnosticCode code) {
  switch (code) {
    case DiagnosticCode::BeginMissing:
      return "a DIN/ISO program begins with %NAME G71 *, or G70 for inch";
    case DiagnosticCode::EndMissing:
      return "the program ends with N99999999 %NAME G71 *, or G70 for inch";
    case DiagnosticCode::TextAfterEnd:
      return "the text after N99999999 %NAME is not part of the program: move it to another file";
    case DiagnosticCode::NameMismatch:
      return "the name or unit differs from the first line, which counts";
    default: return {};
  }
}

void set_place(Diagnostic& diagnostic, const Program& program, Slice<char> place) {
  diagnostic.range = program.range(place);
  diagnostic.remedies.clear();  // in the words of Klartext
  if (diagnostic.range.end.line != diagnostic.range.begin.line)
    diagnostic.range.end = diagnostic.range.begin;
  diagnostic.source = std::string(klartext::shown(program.line(diagnostic.range.begin.line)));
}

/// Several lines of Klartext may be one block. Its first syntax error is its only finding, since
/// the other lines need the line that cannot be read.
void drop_later_findings(std::vector<Diagnostic>& diagnostics,
                         const std::vector<Slice<char>>& lines) {
  const auto line_of = [](const Diagnostic& found) { return found.range.begin.line - 1; };
  const auto block_of = [&](const Diagnostic& found) {
    return line_of(found) < lines.size() ? lines[line_of(found)].first : klartext::kLargestSource;
  };
  std::map<std::size_t, std::size_t> faulty;  // a block and its line with the error
  for (const Diagnostic& found : diagnostics)
    if (found.code == DiagnosticCode::SyntaxError)
      faulty.try_emplace(block_of(found), line_of(found));
  std::erase_if(diagnostics, [&](const Diagnostic& found) {
    const auto block = faulty.find(block_of(found));
    return block != faulty.end() && block->second != line_of(found);
  });
}

klartext::ParsedProgram parse_iso(std::string source, std::string name) {
  Translation translation = translate(source);
  if (translation.is_too_large)
    return {{}, klartext::too_large(klartext::too_much_memory(), std::move(name))};
  auto parsed = klartext::parse_program(std::move(translation.klartext), name);
  const Origin origin(source, translation, parsed.program.source());
  drop_later_findings(parsed.diagnostics, translation.lines);
  std::vector<Slice<char>> places;
  for (Diagnostic& diagnostic : parsed.diagnostics) {
    const auto [begin, end] = diagnostic.range;
    const std::size_t line = begin.line - 1;
    const std::string_view text = parsed.program.line(begin.line);
    places.push_back(origin.place(line, line,
                                  text.substr(std::min<std::size_t>(begin.column - 1, text.size()),
                                              end.column - std::min(begin.column, end.column))));
    if (const auto message = frame_message(diagnostic.code); !message.empty())
      diagnostic.message = message;
    const auto& unreadable = translation.unreadable;
    const auto found = std::ranges::lower_bound(unreadable, line, {}, &Translation::Finding::line);
    if (found == unreadable.end() || found->line != line) continue;
    if (diagnostic.code == DiagnosticCode::TooManyDiagnostics) continue;
    diagnostic.code = found->code;
    diagnostic.message = found->message;
    places.back() = found->place;
  }
  parsed.program =
      std::move(parsed.program).translated(std::move(source), [&origin](Slice<char> place) {
        return origin.place(place);
      });
  for (std::size_t i = 0; i < places.size(); ++i)
    set_place(parsed.diagnostics[i], parsed.program, places[i]);
  for (const Translation::Finding& warning : translation.warnings) {
    Diagnostic diagnostic{.severity = klartext::Severity::Warning,
                          .code = warning.code,
                          .message = warning.message,
                          .program = name};
    set_place(diagnostic, parsed.program, warning.place);
    parsed.diagnostics.push_back(std::move(diagnostic));
  }
  std::stable_sort(parsed.diagnostics.begin(), parsed.diagnostics.end(),
                   [](const auto& a, const auto& b) { return a.range.begin < b.range.begin; });
  return parsed;
}

}  // namespace

bool is_iso(std::string_view text, std::string_view name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  // Comments and empty lines may stand before the first block.
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::string_view line = trim(text.substr(at, end - at));
    at = end;
    if (line.empty() || line.front() == ';') continue;
    if (line.front() == '%') return true;
    return ascii_iequals(name.substr(name.size() - std::min<std::size_t>(name.size(), 2)), ".i") &&
           line.find("BEGIN PGM") == std::string_view::npos;
  }
  return false;
}

klartext::ParsedProgram parse_program(std::string bytes, std::string name) {
  if (bytes.size() > klartext::kLargestSource || !is_iso(bytes, name))
    return klartext::parse_program(std::move(bytes), std::move(name));
  return parse_iso(klartext::decode_source(std::move(bytes)), std::move(name));
}

}  // namespace fitgauge::iso
