#include <doctest/doctest.h>

#include <fstream>

#include "nc/iso/parser.hpp"
#include "nc/iso/translation.hpp"

namespace fitgauge::iso {
namespace {

/// The first finding of blocks between the first and the last line, as `line:column code: message`.
std::string finding(std::string_view blocks) {
  const auto parsed =
      parse_program("%T G71 *\n" + std::string(blocks) + "\nN99999999 %T G71 *\n", "t.i");
  if (parsed.diagnostics.empty()) return {};
  const klartext::Diagnostic& first = parsed.diagnostics.front();
  return std::to_string(first.range.begin.line) + ":" + std::to_string(first.range.begin.column) +
         " " + std::string(klartext::id(first.code)) + ": " + first.message;
}

TEST_CASE("A code that is not available says what to use instead") {
  CHECK(finding("N10 G83 P01 2 *") == "2:5 syntax.error: G83 is not available; use cycle G200");
  CHECK(finding("N10 G57 P01 2 *") == "2:5 syntax.error: G57 is not available; use cycle G122");
  CHECK(finding("N10 G50 *") ==
        "2:5 syntax.error: G50 is not available; leave it out: it protects a file");
  CHECK(finding("N10 G21 *") ==
        "2:5 syntax.error: G21 is unknown to these controls; docs/reference/language.md lists "
        "their codes");
}

TEST_CASE("A finding stands at its place in the DIN/ISO text") {
  CHECK(finding("N10 G00 X+1 *\nN20 G01 X+1 X+2 *") ==
        "3:13 word.repeated: X is repeated in this block");
  CHECK(finding("N10 G421 ~\n  Q273=+1 ;A ~\n  Q273=+2 ;B *") ==
        "4:3 cycle.parameter_repeated: this parameter is repeated in the cycle");
  CHECK(finding("N10 Q1 = 5 / *").starts_with("2:"));
  CHECK(finding("N10 G01 X+Q9999 *").starts_with("2:11 parameter.out_of_range"));
}

TEST_CASE("A word between the number of a cycle and its parameters is not a title") {
  const auto refused = [](std::string_view place, std::string_view word) {
    return fmt::format(
        "{} syntax.error: {} must not be in the block of a cycle: write it into another block",
        place, word);
  };
  CHECK(finding("N10 G247 M5 Q339=1 *") == refused("2:10", "M5"));
  CHECK(finding("N10 G200 X+10 Q200=2 Q201=-5 *") == refused("2:10", "X+10"));
  CHECK(finding("N10 G200 G91 ~\n Q200=2 ~\n Q201=-5 *") == refused("2:10", "G91"));
  CHECK(finding("N10 G200 DRILLING F.5Q200=2") == refused("2:19", "F.5"));
  CHECK(finding("N10 G00 Z+5 *\nN20 G421T5 *").starts_with("3:9 syntax.error: T5 must not"));
  CHECK(finding("N10 G203 UNIVERSAL DRILLING ;M5 ~\n Q200=2 ;X+1 *").empty());
  CHECK(finding("N10 G444 PROBING IN 3-D *").empty());
  CHECK(finding("N10 G256 RECHTECKZAPFEN AUSSEN Q218=+5 *").empty());
}

TEST_CASE("G07 moves one axis") {
  CHECK(finding("N10 G07 X+5 Y+5 F100 *") ==
        "2:1 syntax.error: G07 moves one axis: write G01 for several");
  CHECK(finding("N10 G07 X+5 F100 *\nN20 Y+5 M118 X0.5 Y1 *").empty());
}

TEST_CASE("A dotted cycle is Klartext") {
  CHECK(finding("N10 G126.0 AXIS-SPECIFIC SCALING *").starts_with("2:"));
  CHECK(finding("N10 CYCL DEF 26.0 SCALING *\nN20 CYCL DEF 26.1 X2 Y1 CCX+0 CCY+0 *").empty());
}

TEST_CASE("The table of the reference names the functions that have P01") {
  std::ifstream in(FITGAUGE_SOURCE_DIR "/docs/reference/language.md");
  std::string row;
  while (std::getline(in, row) && row.find("with P01, P02") == row.npos) {
  }
  REQUIRE(row.starts_with("| D00 to D16, "));
  for (unsigned number = 0; number < 39; ++number) {
    CAPTURE(number);
    const std::string name = (number < 10 ? "D0" : "D") + std::to_string(number);
    const bool is_named = number <= 16 || row.find(name) != row.npos;
    CHECK(is_named == !function_pattern(number).empty());
  }
}

TEST_CASE("A block says what is missing or does not belong to it") {
  CHECK(
      finding("N10 X+5 *") ==
      "2:1 syntax.error: the block has no path function: write G00 or G01 before its coordinates");
  CHECK(finding("N10 G04 *") == "2:1 syntax.error: F is missing in this block");
  CHECK(finding("N10 G04 F1 X+5 *") == "2:1 syntax.error: X+5 is not allowed in a block of G04");
  CHECK(finding("N10 G04 F1 G28 X *") ==
        "2:12 syntax.error: G28 must not be in the block of G04: write it into another block");
  CHECK(finding("N10 G00 G01 X+5 F100 *") ==
        "2:9 syntax.error: G00 and G01 contradict each other: leave one of them out");
  CHECK(finding("N10 G01 G41 X+5 G42 F100 *") ==
        "2:17 syntax.error: G41 and G42 contradict each other: leave one of them out");
  CHECK(finding("N10 T5 G17 G18 S100 *") ==
        "2:12 syntax.error: G17 and G18 contradict each other: leave one of them out");
  CHECK(finding("N10 G01 G01 G91 X+5 G90 Y+5 F100 *").empty());
  CHECK(finding("N10 D01 Q1 P01 +5 *") == "2:1 syntax.error: P02 is missing");
  CHECK(finding("N10 D00 Q1 *") == "2:1 syntax.error: P01 is missing");
  CHECK(finding("N10 D00 Q1 P01 +5 P02 +6 *") ==
        "2:1 syntax.error: P02 is not allowed in this block");
  CHECK(finding("N10 G62 T0.1 P01 1 *") == "2:1 syntax.error: P01 is not allowed in this block");
  CHECK(finding("N10 D00 P01 +5 *") ==
        "2:1 syntax.error: a Q parameter is missing after the function");
  CHECK(finding("N10 G26 R5 *") ==
        "2:1 syntax.error: G26 must follow the block of the first contour point, which has G41 "
        "or G42");
  CHECK(finding("N10 G27 R5 *\nN20 G98 L1 *") ==
        "3:1 syntax.error: G27 needs the end point in the next block, with G40");
  CHECK(finding("N10 G27 R5 *").starts_with("3:1 syntax.error: G27 needs the end point"));
  CHECK(finding("N10 G05 X+5 R+3 *") ==
        "2:1 syntax.error: the arc has no direction: write G02 or G03, or G12 or G13");
  CHECK(finding("N10 T1 G17 *\nN20 G18 G40 *") ==
        "3:1 syntax.error: the tool axis changes with the tool: write G17, G18 or G19 after T");
  CHECK(finding("N10 G70 *") ==
        "2:5 syntax.error: G70 is not available; the unit of the program stands in its first line");
  CHECK(finding("N10 G90 G421 Q273=+1 *") ==
        "2:1 syntax.error: a cycle must be the first word of its block");
}

TEST_CASE("A mode that holds on over a label is named at its use") {
  const std::string text = "N10 G00 G90 X+1 *\nN20 L1,0 *\nN30 X+5 *\nN40 M30 *\nN50 G98 L1 *\n";
  CHECK(finding(text + "N60 G01 G90 X+1 *\nN70 G98 L0 *") ==
        "4:1 block.modal_state_assumed: after a label or a call the block has no path function: "
        "G00 of an earlier block counts; write the code into this block");
  CHECK(finding("N10 G00 G90 X+1 *\nN20 L1,0 *\nN30 G00 X+5 *\nN50 G98 L1 *\nN60 G01 G91 X+1 "
                "*\nN70 G98 L0 *") ==
        "4:1 block.modal_state_assumed: after a label or a call the block has no G90 or G91: G90 "
        "of an earlier block counts; write the code into this block");
}

TEST_CASE("The first syntax error of a block is its only finding") {
  for (const std::string block : {"N10 G55 P01 10 P02 Z P03 X+50 Y+10 Z+5 *",
                                  "N10 G55 P01 10 P02 Z- P03 X+50 Y+ Z+5 *", "N10 G54 X+ *"}) {
    CAPTURE(block);
    const auto parsed = parse_program("%T G71 *\n" + block + "\nN99999999 %T G71 *\n", "t.i");
    REQUIRE(parsed.diagnostics.size() == 1);
    CHECK(parsed.diagnostics[0].code == klartext::DiagnosticCode::SyntaxError);
  }
  CHECK(finding("N10 G55 P01 10 P02 Z P03 X+50 Y+10 Z+5 *") ==
        "2:1 syntax.error: P02 must be an axis with its direction, such as X-");
}

TEST_CASE("A program has a first and a last line") {
  const auto first = [](std::string text) {
    const auto parsed = parse_program(std::move(text), "t.i");
    return parsed.diagnostics.empty() ? std::string() : parsed.diagnostics.front().message;
  };
  CHECK(first("%T *\nN99999999 %T G71 *").starts_with("the first line must be %NAME G71 *"));
  CHECK(first("%T G71 *\nN10 M3 *") ==
        "the program ends with N99999999 %NAME G71 *, or G70 for inch");
  CHECK(first("N10 M3 *\n%T G71 *\nN99999999 %T G71 *") ==
        "a DIN/ISO program begins with %NAME G71 *, or G70 for inch");
  CHECK(parse_program("N10 M3 *\nN99999999 %T G71 *\n", "t.i").diagnostics.size() == 1);
  CHECK(first("%T G71 *\nN99999999 %U G71 *") ==
        "the name or unit differs from the first line, which counts");
}

TEST_CASE("A damaged program is bounded") {
  std::string text = "%T G71 *\n";
  for (int i = 0; i < 260'000; ++i) text += "G54X1*\n";
  CHECK(parse_program(text, "t.i").has_errors());
  std::string line(2'000'000, 'X');
  CHECK(parse_program("%T G71 *\nG01 " + line + "\n", "t.i").has_errors());
  CHECK(parse_program("%T G71 *\nG200 " + std::string(1'000'000, '~') + "\n", "t.i").has_errors());
  CHECK(parse_program("%", "t.i").has_errors());
  CHECK(parse_program("%T G71 *\nN10 \"~\n;", "t.i").has_errors());
}

TEST_CASE("A block has a bounded number of words, a program one of lines") {
  std::string words;
  for (int i = 0; i < 1001; ++i) words += "X1 ";
  const auto block = parse_program("%T G71 *\n" + words + "\nN99 %T G71 *\n", "t.i");
  REQUIRE_FALSE(block.diagnostics.empty());
  CHECK(block.diagnostics.front().message == "a block must have at most 1000 words");
  const auto lines = parse_program("%T G71 *\n" + std::string(klartext::kMostLines, '\n'), "t.i");
  REQUIRE(lines.diagnostics.size() == 1);
  CHECK(lines.diagnostics.front().code == klartext::DiagnosticCode::ProgramTooLarge);
}

}  // namespace
}  // namespace fitgauge::iso
