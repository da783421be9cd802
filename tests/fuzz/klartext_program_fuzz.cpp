// Any bytes as a program of either dialect: every finding has its place, and a program without
// errors, printed as Klartext and as DIN/ISO, reads back as the same.

#include "../support/same_program.hpp"
#include "nc/iso/parser.hpp"
#include "nc/klartext/parser.hpp"
#include "target.hpp"

using namespace fitgauge::klartext;

void take(std::string_view bytes) {
  const ParsedProgram parsed = fitgauge::iso::parse_program(std::string(bytes), "fuzz.h");
  for (const Diagnostic& diagnostic : parsed.diagnostics) {
    require(!render(diagnostic).empty() && !(diagnostic.range.end < diagnostic.range.begin));
  }
  const std::string printed = print_program(parsed.program);
  if (parsed.has_errors()) return;
  const ParsedProgram again = parse_program(printed, "printed.h");
  require(!again.has_errors() && again.program == parsed.program);
  // A block without a form in DIN/ISO is an error of the conversion.
  const auto converted = fitgauge::iso::to_iso(parsed.program, {});
  if (has_errors(converted.findings)) return;
  const ParsedProgram there = fitgauge::iso::parse_program(converted.text, "printed.i");
  require(!there.has_errors());
  require(format_program(there.program) == format_program(parsed.program));
}
