#include "nc/klartext/diagnostic.hpp"

#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {
namespace {

constexpr std::string_view kIds[] = {
#define KLARTEXT_DIAGNOSTIC(name, id) id,
#include "nc/klartext/diagnostic_codes.inc"
};

/// Returns the line under the source line: carets under the place, with tabs so that they align.
/// Empty if the place is beyond the end of a cut line.
std::string caret_line(const Diagnostic& diagnostic) {
  const auto& [begin, end] = diagnostic.range;
  std::string margin = "\n";
  std::uint32_t column = 1;
  for (const char c : diagnostic.source) {
    if (column >= begin.column) break;
    const bool continues_character = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (continues_character) continue;
    margin += c == '\t' ? '\t' : ' ';
    ++column;
  }
  if (column < begin.column) return {};
  return margin.append(std::max(end.column, begin.column + 1) - begin.column, '^');
}

/// Findings beyond this number are counted, not kept.
constexpr std::size_t kMostDiagnostics = 200;

constexpr std::size_t kLongestShownLine = 1000;

}  // namespace

std::string_view shown(std::string_view line) { return first_characters(line, kLongestShownLine); }

std::string_view word(Severity severity) { return word_of(severity, {"note", "warning", "error"}); }

std::string_view id(DiagnosticCode code) { return word_of(code, kIds); }

bool has_errors(const std::vector<Diagnostic>& diagnostics, bool keeps_unreadable) {
  return std::ranges::any_of(diagnostics, [=](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::Error &&
           !(keeps_unreadable && diagnostic.is_unreadable);
  });
}

std::vector<Diagnostic> too_large(std::string message, std::string name) {
  return {{.code = DiagnosticCode::ProgramTooLarge,
           .message = std::move(message),
           .program = std::move(name)}};
}

std::string render(const Diagnostic& diagnostic) {
  std::string text =
      fmt::format("{}:{}:{}: {}: {} [{}]\n{}{}", diagnostic.program, diagnostic.range.begin.line,
                  diagnostic.range.begin.column, word(diagnostic.severity), diagnostic.message,
                  id(diagnostic.code), diagnostic.source, caret_line(diagnostic));
  for (const DiagnosticNote& note : diagnostic.notes) {
    text += fmt::format("\n{}:{}:{}: note: {}",
                        note.program.empty() ? diagnostic.program : note.program,
                        note.range.begin.line, note.range.begin.column, note.message);
  }
  return text;
}

void DiagnosticList::add(Severity severity, DiagnosticCode code, Slice<char> place,
                         std::string message, std::optional<std::uint32_t> block,
                         bool is_unreadable, const std::string& instead) {
  if (kept_.size() == kMostDiagnostics) {
    ++dropped_;
    worst_dropped_ = std::max(worst_dropped_, severity);
    if (severity == Severity::Error && !is_unreadable) all_dropped_unreadable_ = false;
    return;
  }
  const SourcePosition begin = position_of(source_, line_starts_, place.first);
  SourcePosition end = position_of(source_, line_starts_, std::size_t{place.first} + place.count);
  if (end.line != begin.line) end = begin;
  kept_.push_back({.severity = severity,
                   .code = code,
                   .message = std::move(message),
                   .program = program_,
                   .range = {begin, end},
                   .block = block,
                   .source = std::string(shown(line_of(source_, line_starts_, begin.line))),
                   .is_unreadable = is_unreadable});
  if (!instead.empty())
    kept_.back().remedies.push_back({"Write " + instead, {{kept_.back().range, instead}}});
}

std::vector<Diagnostic> DiagnosticList::take() {
  if (dropped_ > 0) {
    Diagnostic last = kept_.back();
    last.severity = worst_dropped_;
    last.is_unreadable = all_dropped_unreadable_;
    last.code = DiagnosticCode::TooManyDiagnostics;
    last.message = std::to_string(dropped_) + " more findings are not shown; correct these first";
    kept_.push_back(std::move(last));
  }
  return std::move(kept_);
}

}  // namespace fitgauge::klartext
