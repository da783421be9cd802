#include <doctest/doctest.h>

#include "parse_support.hpp"
#include "support/same_program.hpp"

namespace fitgauge::klartext {
namespace {

const CycleParameter& parameter(const ParsedProgram& parsed, std::size_t i) {
  return parsed.program.view(statement_of<Cycle>(parsed).parameters)[i];
}

std::vector<Word> part_words(const ParsedProgram& parsed) {
  const auto words = parsed.program.view(statement_of<CyclePart>(parsed).words);
  return {words.begin(), words.end()};
}

std::vector<Word> part_words(std::string_view line) {
  const ParsedProgram parsed = parse_lines(line);
  CAPTURE(findings(parsed));
  REQUIRE(parsed.diagnostics.empty());
  return part_words(parsed);
}

TEST_CASE("A cycle in Q-form is one block of its parameters, the dialog text is kept") {
  const ParsedProgram parsed = parse_lines(
      "12 TCH PROBE 421 MEASURE HOLE ~\n"
      "    Q273=+50    ;CENTER IN 1ST AXIS ~\n"
      "    Q274=-QL3   ;Q275=+9 IS TEXT~\n"
      "    Q330=+0");
  REQUIRE(parsed.diagnostics.empty());
  const Cycle& cycle = statement_of<Cycle>(parsed);
  CHECK(cycle.family == CycleFamily::TchProbe);
  CHECK(cycle.number == 421);
  CHECK(parsed.program.text(cycle.dialog) == "MEASURE HOLE");
  REQUIRE(cycle.parameters.count == 3);
  CHECK(parameter(parsed, 0).parameter == QRef{QSpace::Q, 273});
  CHECK(parameter(parsed, 0).value == Expr(50.0));
  CHECK(parsed.program.text(parameter(parsed, 0).comment) == "CENTER IN 1ST AXIS");
  CHECK(parsed.program.text(parameter(parsed, 1).comment) == "Q275=+9 IS TEXT");
  CHECK(parsed.program.written(parameter(parsed, 1).written) == "Q274=-QL3");
  const SourceRange place = parsed.program.range(parameter(parsed, 1).written);
  CHECK(place.begin == SourcePosition{4, 5});
  CHECK(place.end == SourcePosition{4, 14});
  CHECK(parsed.program.line(4) == "    Q274=-QL3   ;Q275=+9 IS TEXT~");
}

TEST_CASE("Values of cycle parameters") {
  const ParsedProgram parsed = parse_lines(
      "CYCL DEF 200 DRILLING Q200=2 ;SET-UP CLEARANCE~\n"
      "Q206=FMAX~\nQ207=MAX ~\nQ208= AUTO\t~\nQ209=F MAX~\nQ253=PREDEF~\nQ211=FU0.2~\nQ212=FZ "
      "0,1~\n"
      "QS400=\"0.1-0.1\"~\nQ330=QS5");
  CAPTURE(findings(parsed));
  REQUIRE(parsed.diagnostics.empty());
  CHECK(parameter(parsed, 1).kind == CycleValue::Max);
  CHECK(parameter(parsed, 2).kind == CycleValue::Max);
  CHECK(parameter(parsed, 3).kind == CycleValue::Auto);
  CHECK(parameter(parsed, 4).kind == CycleValue::Max);
  CHECK(parameter(parsed, 5).kind == CycleValue::Predef);
  CHECK(parameter(parsed, 6).kind == CycleValue::Fu);
  CHECK(parameter(parsed, 6).value == Expr(0.2));
  CHECK(parameter(parsed, 7).kind == CycleValue::Fz);
  CHECK(parameter(parsed, 7).value == Expr(0.1));
  CHECK(parameter(parsed, 8).parameter == QRef{QSpace::Qs, 400});
  CHECK(parsed.program.text(std::get<Text>(parameter(parsed, 8).value)) == "0.1-0.1");
  CHECK(parameter(parsed, 9).value == Expr(QRef{QSpace::Qs, 5}));
}

TEST_CASE("The first parameter may stand on the header line") {
  const ParsedProgram parsed = parse_lines("CYCL DEF 247 INIT. PT DE REF. ~    Q339=+15 ;NO.");
  // The `~` within the line ends the dialog text.
  REQUIRE(parsed.diagnostics.empty());
  CHECK(parsed.program.text(statement_of<Cycle>(parsed).dialog) == "INIT. PT DE REF.");
  CHECK(parameter(parsed, 0).value == Expr(15.0));
}

TEST_CASE("Old controls give the parameters as indented lines without ~") {
  const ParsedProgram parsed = parse_lines(
      "4 CYCL DEF 200 BOHREN\n"
      "     Q200=2    ;SICHERHEITS-ABST.\n"
      "     Q201=-20  ;TIEFE\n"
      "5 L X+1\n"
      "Q5 = 3");
  REQUIRE(parsed.diagnostics.size() == 1);
  CHECK(parsed.diagnostics[0].severity == Severity::Note);
  CHECK(statement_of<Cycle>(parsed).parameters.count == 2);
  CHECK(parsed.program.blocks().size() == 5);
  CHECK(parsed.program.range(parsed.program.blocks()[1].written).end.line == 4);
  CHECK(std::holds_alternative<Assignment>(parsed.program.blocks()[3].statement));
}

TEST_CASE("Dotted cycles are blocks of their own") {
  using W = std::vector<Word>;
  CHECK(part_words("CYCL DEF 7.0 DATUM SHIFT").empty());
  CHECK(part_words("12 CYCL DEF 7.1 X+60") == W{{.value = 60.0, .letter = Letter::X}});
  CHECK(part_words("CYCL DEF 7.2 IY-5") ==
        W{{.value = -5.0, .letter = Letter::Y, .incremental = true}});
  CHECK(part_words("CYCL DEF 7.1 #5") == W{{.value = 5.0, .letter = Letter::Row}});
  CHECK(part_words("CYCL DEF 8.1 X Y") == W{{.letter = Letter::X}, {.letter = Letter::Y}});
  CHECK(part_words("CYCL DEF 8.1").empty());
  CHECK(part_words("CYCL DEF 9.1 DWELL 0.5") == W{{.value = 0.5, .letter = Letter::Value}});
  CHECK(part_words("CYCL DEF 9.1 V.ZEIT0.5") == W{{.value = 0.5, .letter = Letter::Value}});
  CHECK(part_words("CYCL DEF 10.1 ROT+35") == W{{.value = 35.0, .letter = Letter::Rot}});
  CHECK(part_words("CYCL DEF 10.1 IROT-5") ==
        W{{.value = -5.0, .letter = Letter::Rot, .incremental = true}});
  CHECK(part_words("CYCL DEF 11.1 SCL 0.99") == W{{.value = 0.99, .letter = Letter::Scl}});
  CHECK(part_words("CYCL DEF 26.1 X1.4 Y0.6 CCX+15 CCY+20") ==
        W{{.value = 1.4, .letter = Letter::X},
          {.value = 0.6, .letter = Letter::Y},
          {.value = 15.0, .letter = Letter::Ccx},
          {.value = 20.0, .letter = Letter::Ccy}});
  CHECK(part_words("CYCL DEF 13.1 ANGLE 180") == W{{.value = 180.0, .letter = Letter::Value}});
  CHECK(part_words("CYCL DEF 14.1 CONTOUR LABEL 1 /2") ==
        W{{.value = 1.0, .letter = Letter::Value}, {.value = 2.0, .letter = Letter::Value}});
  CHECK(part_words("CYCL DEF 19.1 A+0 B+45 C-Q5 F1000 ABST50")[1] ==
        Word{.value = 45.0, .letter = Letter::B});
  CHECK(part_words("CYCL DEF 32.1 T0.05") == W{{.value = 0.05, .letter = Letter::T}});
  CHECK(part_words("CYCL DEF 32.2 HSC-MODE:1 TA5") ==
        W{{.value = 1.0, .letter = Letter::Value}, {.value = 5.0, .letter = Letter::Ta}});
  CHECK(part_words("CYCL DEF 1.5 F80") == W{{.value = 80.0, .letter = Letter::F}});
  const ParsedProgram call = parse_lines("CYCL DEF 12.1 PGM TNC:\\x\\y.h");
  CHECK(call.program.text(std::get<Text>(part_words(call)[0].value)) == "TNC:\\x\\y.h");
}

TEST_CASE("A wrap separates words of code, also in a dotted cycle") {
  const ParsedProgram parsed = parse_lines("TCH PROBE 3.2 X~\nANGLE: +15");
  REQUIRE(parsed.diagnostics.empty());
  CHECK(parsed.program.text(statement_of<CyclePart>(parsed).text) == "X ANGLE: +15");
  CHECK(part_words(parsed).size() == 2);
}

TEST_CASE("Dotted touch probe cycles") {
  using W = std::vector<Word>;
  CHECK(part_words("TCH PROBE 0.0 REF. PLANE Q5 X-") ==
        W{{.value = QRef{QSpace::Q, 5}, .letter = Letter::Result},
          {.value = -1.0, .letter = Letter::X}});
  CHECK(part_words("TCH PROBE 0.1 X+5 Y+0 Z-5").size() == 3);
  CHECK(part_words("TCH PROBE 1.1 X ANGLE: +30") ==
        W{{.letter = Letter::X}, {.value = 30.0, .letter = Letter::Value}});
  CHECK(part_words("TCH PROBE 3.1 Q1") ==
        W{{.value = QRef{QSpace::Q, 1}, .letter = Letter::Result}});
  CHECK(part_words("TCH PROBE 3.3 ABST +10 F100 MB1 REFERENCE SYSTEM: 0") ==
        W{{.value = 10.0, .letter = Letter::Value},
          {.value = 100.0, .letter = Letter::F},
          {.value = 1.0, .letter = Letter::Mb},
          {.value = 0.0, .letter = Letter::Value}});
  CHECK(part_words("TCH PROBE 4.3 ABST.5 F,5 MB.1") == W{{.value = 0.5, .letter = Letter::Value},
                                                         {.value = 0.5, .letter = Letter::F},
                                                         {.value = 0.1, .letter = Letter::Mb}});
  CHECK(part_words("CYCL DEF 9.1 V. ZEIT .5") == W{{.value = 0.5, .letter = Letter::Value}});
  CHECK(part_words("TCH PROBE 3.4 ERRORMODE1") == W{{.value = 1.0, .letter = Letter::Value}});
  CHECK(part_words("TCH PROBE 4.2 IX+0 IY+0 IZ-1")[2] ==
        Word{.value = -1.0, .letter = Letter::Z, .incremental = true});
  CHECK(part_words("TCH PROBE 4.3 ABST+45 F100 MB50 REFERENCE SYSTEM:0").size() == 4);
}

TEST_CASE("Words that follow an M function with arguments belong to it") {
  const ParsedProgram parsed = parse_lines("L X+1 F500 M128 F1000");
  REQUIRE(parsed.diagnostics.empty());
  const auto words = parsed.program.view(statement_of<Motion>(parsed).words);
  REQUIRE(words.size() == 4);
  CHECK_FALSE(words[1].argument);
  CHECK(words[3] == Word{.value = 1000.0, .letter = Letter::F, .argument = true});
}

}  // namespace
}  // namespace fitgauge::klartext
