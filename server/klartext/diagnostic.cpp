#include "klartext/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fitgauge::klartext {
namespace {

constexpr std::string_view kIds[] = {
#define KLARTEXT_DIAGNOSTIC(name, id) id,
#include "klartext/diagnostic_codes.inc"
#undef KLARTEXT_DIAGNOSTIC
};

/// As wide as the columns before `column`; tabs stay tabs, so that the caret lines up.
std::string margin(std::string_view line, std::uint32_t column) {
  std::string out;
  for (const char c : line) {
    const bool continues_character = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (continues_character) continue;
    if (out.size() + 1 >= column) break;
    out += c == '\t' ? '\t' : ' ';
  }
  out.resize(column - 1, ' ');
  return out;
}

}  // namespace

std::string_view id(DiagnosticCode code) { return kIds[static_cast<std::size_t>(code)]; }

std::string render(const Diagnostic& diagnostic) {
  const auto& [begin, end] = diagnostic.range;
  const std::uint32_t length =
      end.line == begin.line && end.column > begin.column ? end.column - begin.column : 1;
  return fmt::format("{}:{}:{}: {}: {} [{}]\n{}\n{}{}", diagnostic.program, begin.line,
                     begin.column, diagnostic.severity == Severity::Error ? "error" : "warning",
                     diagnostic.message, id(diagnostic.code), diagnostic.source,
                     margin(diagnostic.source, begin.column), std::string(length, '^'));
}

}  // namespace fitgauge::klartext
