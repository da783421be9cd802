// Random programs: what is printed reads back as the same program. FITGAUGE_SEED repeats a run.

#include <doctest/doctest.h>

#include <random>

#include "nc/iso/parser.hpp"
#include "nc/klartext/parser.hpp"
#include "program_generator.hpp"
#include "support/same_program.hpp"

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

TEST_CASE("What converts to DIN/ISO is the same program there") {
  ProgramGenerator generator(seed());
  std::size_t converted = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string text = generator.program();
    const ParsedProgram parsed = parse_program(text, "generated.h");
    const auto conversion = iso::to_iso(parsed.program, ".H");
    CAPTURE(text);
    CAPTURE(conversion.text);
    if (has_errors(conversion.findings)) continue;
    ++converted;
    const ParsedProgram there = iso::parse_program(conversion.text, "generated.i");
    REQUIRE_FALSE(there.has_errors());
    REQUIRE(iso::to_iso(there.program, ".H").text == conversion.text);
    const ParsedProgram back =
        parse_program(iso::to_klartext(there.program, ".I").text, "generated.h");
    REQUIRE_FALSE(back.has_errors());
    REQUIRE(format_program(back.program) == format_program(there.program));
  }
  MESSAGE(converted, " of 200 have a form in DIN/ISO");
  CHECK(converted > 0);
}

}  // namespace
}  // namespace fitgauge::klartext
