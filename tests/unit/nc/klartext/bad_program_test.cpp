#include <doctest/doctest.h>

#include "parse_support.hpp"

namespace fitgauge::klartext {
namespace {

TEST_CASE("Each kind of mistake is named with its line and column") {
  struct Bad {
    std::string_view lines;
    std::string_view finding;
  };
  for (const Bad& bad : std::initializer_list<Bad>{
           {"14 CALL LBL", "2:12 syntax.error"},
           {"L X+", "2:5 syntax.error"},
           {"L X+1 X+2", "2:7 word.repeated"},
           {"L X+1 R0 RL", "2:10 word.repeated"},
           {"L X+1 F100 FMAX", "2:12 word.repeated"},
           {"L X+1 FMAX F100", "2:12 word.repeated"},
           {"L X+1 FU0.2 FAUTO", "2:13 word.repeated"},
           {"L X+1 Q5", "2:7 syntax.error"},
           {"L X+1 KEN5", "2:7 syntax.error"},
           {"L PR+5", "2:3 syntax.error"},
           {"FOO X+1", "2:1 block.unknown"},
           {"Q2000 = 1", "2:1 parameter.out_of_range"},
           {"QL500 = 1", "2:1 parameter.out_of_range"},
           {"Q99999999999 = 1", "2:1 parameter.out_of_range"},
           {"Q1 = 1000000000", "2:6 number.out_of_range"},
           {"Q1 = (1 + 2", "2:12 syntax.error"},
           {"Q1 = 1 +", "2:9 syntax.error"},
           {"Q1 = 1 2", "2:8 syntax.error"},
           {"Q1 1", "2:4 syntax.error"},
           {"QS1 = \"open", "2:7 string.unterminated"},
           {"LBL 65535", "2:5 number.out_of_range"},
           {"LBL \"\"", "2:5 label.malformed"},
           {"LBL Q5", "2:5 label.malformed"},
           {"LBL \"123456789012345678901234567890123\"", "2:5 string.too_long"},
           {"LBL name", "2:5 syntax.error"},
           {"FN 9: IF +1 EQU +1 GOTO", "2:24 syntax.error"},
           {"FN 9: IF +1 GT +1 GOTO LBL 1", "2:13 syntax.error"},
           {"FN 0 Q1 = 5", "2:6 syntax.error"},
           {"FN 99: Q1 = 5", "2:4 number.out_of_range"},
           {"TCH PROBE 421 X ~\n Q273=+1 ~\n Q273=+2", "4:2 cycle.parameter_repeated"},
           {"TCH PROBE 421 X ~\n Q273=", "3:7 syntax.error"},
           {"TCH PROBE 0.0 REF. PLANE", "2:25 syntax.error"},
           {"CYCL DEF 7.1 FOO+1", "2:14 syntax.error"},
           {"PLANE FOO", "2:7 syntax.error"},
           {"PLANE SPATIAL TURN MOVE", "2:24 word.repeated"},
           {"TOOL CAL 5", "2:6 syntax.error"},
           {"BLK FORM 0.3", "2:10 syntax.error"},
           {"BEGIN PGM T MM", "2:1 syntax.error"},
           {"L X+1 ~ Y+2", "2:7 syntax.error"},
           {"L X+1 \x01", "2:7 text.control_character"},
           {"1234567890 L X+1", "2:1 number.out_of_range"},
       }) {
    CAPTURE(bad.lines);
    CHECK(first_finding(bad.lines) == bad.finding);
  }
}

TEST_CASE("A column counts characters, in UTF-8 and in Windows-1252") {
  CHECK(first_finding("QS1 = \"\xC3\x84\xE2\x82\xAC\" X") == "2:12 syntax.error");
  CHECK(first_finding("QS1 = \"\xC4\x80\x80\" X") == "2:13 syntax.error");
  CHECK(first_finding("QS1 = \"\xC4\" X") == "2:11 syntax.error");
}

TEST_CASE("Parsing goes on at the next block and reports everything") {
  const ParsedProgram parsed = parse_lines("1 L X+\n2 L X+1\n3 FOO\n4 Q1 = (\n5 L Y+2");
  REQUIRE(parsed.diagnostics.size() == 3);
  CHECK(parsed.has_errors());
  CHECK(parsed.diagnostics[0].block == 1);
  CHECK(parsed.diagnostics[1].block == 3);
  CHECK(parsed.diagnostics[2].block == 4);
  CHECK(parsed.diagnostics[2].range.begin.line == 5);
  CHECK(parsed.diagnostics[2].source == "4 Q1 = (");
  const auto blocks = parsed.program.blocks();
  REQUIRE(blocks.size() == 7);
  CHECK(std::holds_alternative<Motion>(blocks[2].statement));
  CHECK(std::holds_alternative<ErrorBlock>(blocks[3].statement));
  CHECK(std::holds_alternative<Motion>(blocks[5].statement));
}

TEST_CASE("A program has one BEGIN PGM and one END PGM") {
  const auto finding = [](std::string text) {
    const ParsedProgram parsed = parse_program(std::move(text), "t.h");
    return parsed.diagnostics.empty() ? std::string()
                                      : std::string(id(parsed.diagnostics.front().code));
  };
  CHECK(finding("BEGIN PGM T MM\nEND PGM T MM\n").empty());
  CHECK(finding(";comment\nBEGIN PGM T MM\nEND PGM T MM\n\n  \n").empty());
  const ParsedProgram more = parse_program("BEGIN PGM T MM\nEND PGM T MM\nL X+1\nL X+2", "t.h");
  REQUIRE(more.not_printed() != nullptr);
  CHECK(id(more.not_printed()->code) == "program.text_after_end");
  CHECK(more.not_printed()->range.begin.line == 3);
  CHECK_FALSE(more.has_errors());
  CHECK(finding("L X+1\nEND PGM T MM\n") == "program.begin_missing");
  CHECK(finding("BEGIN PGM T MM\nL X+1\n") == "program.end_missing");
  CHECK(finding("") == "program.end_missing");
  CHECK(finding("BEGIN PGM T\nEND PGM T MM") == "syntax.error");
  CHECK(finding("BEGIN PGM T MM\nL X+1 ~") == "block.continuation_missing");
  CHECK(finding("BEGIN PGM T MM\nEND PGM U MM\n") == "program.name_mismatch");
  CHECK_FALSE(parse_program("BEGIN PGM T MM\nEND PGM U MM\n", "t.h").has_errors());
}

TEST_CASE("What only real controls can do is kept as a block that fails when it is reached") {
  for (const std::string_view line :
       {"FL X+10 Y+5", "FC DR- R15", "FPOL X+0 Y+0", "SQL BIND Q881 \"TAB.COL\"",
        "QS1 = CFGREAD( KEY_QS11 TAG_QS12 ATR_QS13 )", "FUNCTION PARAXCOMP DISPLAY X",
        "SEL PATTERN \"A\"", "FN 25: PRESET = X/+5"}) {
    CAPTURE(line);
    const ParsedProgram parsed = parse_lines(line);
    REQUIRE(parsed.diagnostics.size() == 1);
    CHECK(parsed.diagnostics[0].code == DiagnosticCode::FeatureUnsupported);
    CHECK_FALSE(parsed.has_errors());
    CHECK(parsed.program.text(statement_of<Unsupported>(parsed).text) == line);
  }
  const ParsedProgram parsed = parse_lines("13 ERROR = 13 TOOL CALL ;x");
  CHECK(parsed.program.text(statement_of<ErrorBlock>(parsed).text) == "13 TOOL CALL ;x");
  REQUIRE(parsed.diagnostics.size() == 1);
  CHECK(parsed.diagnostics[0].code == DiagnosticCode::ErrorBlockPresent);
  CHECK_FALSE(parsed.has_errors());
}

TEST_CASE("A flood of mistakes is counted, and an error among them is not lost") {
  std::string lines;
  for (int i = 0; i < 1000; ++i) lines += "FL X+1\n";
  CHECK_FALSE(parse_lines(lines).has_errors());
  const ParsedProgram parsed = parse_lines(lines + "FOO");
  CHECK(parsed.diagnostics.size() == 201);
  CHECK(parsed.diagnostics.back().code == DiagnosticCode::TooManyDiagnostics);
  CHECK(parsed.has_errors());
}

TEST_CASE("Binary garbage gives findings") {
  std::string bytes;
  std::uint32_t state = 1;
  for (int i = 0; i < 100'000; ++i) {
    state = state * 1'664'525 + 1'013'904'223;
    bytes += static_cast<char>(state >> 24);
  }
  const ParsedProgram parsed = parse_program(bytes, "x.h");
  CHECK(parsed.has_errors());
  for (const Diagnostic& diagnostic : parsed.diagnostics) CHECK(!render(diagnostic).empty());
}

TEST_CASE("A program beyond the limits is refused") {
  std::string many;
  for (std::size_t i = 0; i <= kMostBlocks; ++i) many += "L\n";
  CHECK(parse_lines(many).diagnostics.back().code == DiagnosticCode::ProgramTooLarge);
  for (const std::string& text :
       {std::string(kLargestSource + 1, ' '), std::string(kMostLines, '\n')}) {
    const ParsedProgram parsed = parse_program(text, "t.h");
    REQUIRE(parsed.diagnostics.size() == 1);
    CHECK(parsed.diagnostics[0].code == DiagnosticCode::ProgramTooLarge);
  }
  std::string words;
  for (std::size_t i = 0; i < kMostBlocks / 2; ++i) words += "L X1Y1Z1A1B1C1U1V1W1\n";
  const Diagnostic heavy = parse_lines(words).diagnostics.back();
  CHECK(heavy.code == DiagnosticCode::ProgramTooLarge);
  CHECK(heavy.message == too_much_memory());
  const std::string lines = std::string(kMostLines - 2, '\n');
  CHECK_FALSE(parse_program("BEGIN PGM T MM\n" + lines + "END PGM T MM", "t.h").has_errors());
}

}  // namespace
}  // namespace fitgauge::klartext
