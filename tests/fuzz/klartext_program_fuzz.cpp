// Any bytes as a program of either dialect: every finding has its place, and a program without
// errors, printed as Klartext and as DIN/ISO, reads back as the same.

#include "../support/same_program.hpp"
#include "nc/iso/parser.hpp"
#include "nc/klartext/parser.hpp"

using namespace fitgauge::klartext;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ParsedProgram parsed = fitgauge::iso::parse_program(
      std::string(reinterpret_cast<const char*>(data), size), "fuzz.h");
  for (const Diagnostic& diagnostic : parsed.diagnostics) {
    if (render(diagnostic).empty() || diagnostic.range.end < diagnostic.range.begin) std::abort();
  }
  const std::string printed = print_program(parsed.program);
  if (parsed.has_errors()) return 0;
  const ParsedProgram again = parse_program(printed, "printed.h");
  if (again.has_errors() || !(again.program == parsed.program)) std::abort();
  // A block without a form in DIN/ISO is an error of the conversion.
  const auto converted = fitgauge::iso::to_iso(parsed.program, {});
  if (contains_error(converted.findings)) return 0;
  const ParsedProgram there = fitgauge::iso::parse_program(converted.text, "printed.i");
  if (there.has_errors()) std::abort();
  if (format_program(there.program) != format_program(parsed.program)) std::abort();
  return 0;
}
