// Random programs: what is printed reads back as the same program. FITGAUGE_SEED repeats a run.

#include <doctest/doctest.h>

#include <cstdlib>
#include <random>
#include <string>

#include "nc/klartext/parser.hpp"
#include "nc/klartext/printer.hpp"
#include "program_generator.hpp"

namespace fitgauge::klartext {
namespace {

std::uint64_t seed() {
  const char* given = std::getenv("FITGAUGE_SEED");
  const std::uint64_t value =
      given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device()();
  MESSAGE("FITGAUGE_SEED=", value);
  return value;
}

std::string findings(const ParsedProgram& parsed) {
  std::string out;
  for (const Diagnostic& diagnostic : parsed.diagnostics) out += render(diagnostic) + "\n";
  return out;
}

void check_round_trip(const ParsedProgram& parsed) {
  const std::string printed = print_program(parsed.program);
  const ParsedProgram again = parse_program(printed, "printed.h");
  CAPTURE(printed);
  CAPTURE(findings(again));
  REQUIRE_FALSE(again.has_errors());
  REQUIRE(again.program == parsed.program);
  REQUIRE(print_program(again.program) == printed);
}

TEST_CASE("A program without mistakes has no errors and reads back as it was") {
  ProgramGenerator generator(seed());
  for (int i = 0; i < 1000; ++i) {
    const std::string text = generator.program();
    CAPTURE(text);
    const ParsedProgram parsed = parse_program(text, "generated.h");
    CAPTURE(findings(parsed));
    REQUIRE_FALSE(parsed.has_errors());
    check_round_trip(parsed);
  }
}

TEST_CASE("Of damaged programs each finding has its place, and those without errors read back") {
  ProgramGenerator generator(seed());
  for (int i = 0; i < 2000; ++i) {
    const std::string text = generator.damaged(generator.program());
    CAPTURE(text);
    const ParsedProgram parsed = parse_program(text, "damaged.h");
    for (const Diagnostic& diagnostic : parsed.diagnostics) {
      REQUIRE_FALSE(render(diagnostic).empty());
      REQUIRE(parsed.program.line(diagnostic.range.begin.line) == diagnostic.source);
    }
    if (!parsed.has_errors()) check_round_trip(parsed);
  }
}

}  // namespace
}  // namespace fitgauge::klartext
