#include "nc/klartext/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fitgauge::klartext {
namespace {

constexpr std::string_view kIds[] = {
#define KLARTEXT_DIAGNOSTIC(name, id) id,
#include "nc/klartext/diagnostic_codes.inc"
#undef KLARTEXT_DIAGNOSTIC
};

/// The line below the source line: carets under the place, tabs kept so that they line up. Without
/// one when the place lies beyond a line that was cut.
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

}  // namespace

std::string_view id(DiagnosticCode code) { return kIds[static_cast<std::size_t>(code)]; }

bool contains_error(const std::vector<Diagnostic>& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::Error;
  });
}

std::string render(const Diagnostic& diagnostic) {
  std::string text = fmt::format(
      "{}:{}:{}: {}: {} [{}]\n{}{}", diagnostic.program, diagnostic.range.begin.line,
      diagnostic.range.begin.column, diagnostic.severity == Severity::Error ? "error" : "warning",
      diagnostic.message, id(diagnostic.code), diagnostic.source, caret_line(diagnostic));
  for (const DiagnosticNote& note : diagnostic.notes) {
    text += fmt::format("\n{}:{}:{}: note: {}", diagnostic.program, note.range.begin.line,
                        note.range.begin.column, note.message);
  }
  return text;
}

}  // namespace fitgauge::klartext
