#pragma once

#include "nc/klartext/parser.hpp"

namespace fitgauge::klartext {

/// A program of these lines between BEGIN PGM and END PGM, so that the first is line 2.
inline ParsedProgram parse_lines(std::string_view lines) {
  std::string text = "BEGIN PGM T MM\n";
  text += lines;
  text += "\nEND PGM T MM\n";
  return parse_program(std::move(text), "t.h");
}

/// All findings, rendered.
inline std::string findings(const ParsedProgram& parsed) {
  std::string out;
  for (const Diagnostic& diagnostic : parsed.diagnostics) out += render(diagnostic) + "\n";
  return out;
}

/// The lines as the printer writes them, or the findings when there are any.
inline std::string canonical(std::string_view lines) {
  const ParsedProgram parsed = parse_lines(lines);
  if (!parsed.diagnostics.empty()) return findings(parsed);
  std::string text = print_program(parsed.program);
  const std::size_t first = text.find('\n') + 1;
  const std::size_t last = text.rfind("\nEND PGM");
  return text.substr(first, last == std::string::npos || last < first ? 0 : last - first);
}

/// The first finding as `line:column code`, or nothing.
inline std::string first_finding(std::string_view lines) {
  const ParsedProgram parsed = parse_lines(lines);
  if (parsed.diagnostics.empty()) return {};
  const Diagnostic& first = parsed.diagnostics.front();
  return std::to_string(first.range.begin.line) + ":" + std::to_string(first.range.begin.column) +
         " " + std::string(id(first.code));
}

/// The statement of the first block between BEGIN PGM and END PGM; fails the test when it is of
/// another kind.
template <class Kind>
const Kind& statement_of(const ParsedProgram& parsed) {
  return std::get<Kind>(parsed.program.blocks()[1].statement);
}

}  // namespace fitgauge::klartext
