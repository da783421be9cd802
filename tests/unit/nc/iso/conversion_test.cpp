#include <doctest/doctest.h>

#include "nc/iso/parser.hpp"

namespace fitgauge::iso {
namespace {

std::string framed(const std::string& blocks) {
  return "BEGIN PGM P MM\n" + blocks + "END PGM P MM\n";
}

/// The blocks between the first line and the last one.
std::string iso_of(const std::string& blocks) {
  const auto parsed = parse_program(framed(blocks), "p.h");
  REQUIRE_FALSE(parsed.has_errors());
  const auto converted = to_iso(parsed.program, ".H");
  for (const auto& found : converted.findings) {
    CAPTURE(klartext::render(found));
    CHECK(found.severity != klartext::Severity::Error);
  }
  const std::string& text = converted.text;
  const std::size_t begin = text.find('\n') + 1;
  return text.substr(begin, text.rfind("N99999999") - begin);
}

TEST_CASE("each kind of block has its codes") {
  const std::pair<std::string, std::string> kBlocks[] = {
      {"L X+1 IY+2 Z+3 RL F100 M3\n", "G01 G90 X+1 G91 Y+2 G90 Z+3 G41 F100 M3 *\n"},
      {"L Z+100 R0 FMAX\n", "G00 G90 Z+100 G40 *\n"},
      {"5 CC X+10 Y+20\n", "N5 G90 I+10 J+20 *\n"},
      {"CC\n", "G29 *\n"},
      {"C X+1 Y+2 DR-\n", "G02 G90 X+1 Y+2 *\n"},
      {"CR X+1 Y+2 R+20 DR+\n", "G03 G90 X+1 Y+2 R+20 *\n"},
      {"CT X+1 Y+2\n", "G06 G90 X+1 Y+2 *\n"},
      {"LP PR+20 IPA+30\n", "G11 G90 R+20 G91 H+30 *\n"},
      {"CP IPA+90 DR+\n", "G13 G91 H+90 *\n"},
      {"CHF 3\n", "G24 R3 *\n"},
      {"RND R5 F200\n", "G25 R+5 F200 *\n"},
      {"X+46 R+ F1000\n", "G07 G90 X+46 G43 F1000 *\n"},
      {"APPR LT X+1 Y+2 LEN5 RL\n", "APPR LT X+1 Y+2 LEN5 RL *\n"},
      {"TOOL CALL 5 Z S1000 F500 DL+0.1\n", "T5 G17 S1000 F500 DL+0.1 *\n"},
      {"TOOL CALL \"MILL\" Y\n", "T\"MILL\" G18 *\n"},
      {"TOOL CALL S2000\n", "S2000 *\n"},
      {"TOOL CALL 5 S2000\n", "TOOL CALL 5 S2000 *\n"},
      {"TOOL DEF 7\n", "G51 T7 *\n"},
      {"BLK FORM 0.1 Z X+0 Y+0 Z-20\n", "G30 G17 G90 X+0 Y+0 Z-20 *\n"},
      {"STOP M0\n", "G38 M0 *\n"},
      {"M140 MB MAX\n", "M140 MB MAX *\n"},
      {"LBL \"A\"\nLBL 0\n", "G98 L\"A\" *\nG98 L0 *\n"},
      {"LBL 1\nLBL 0\nCALL LBL 1\nCALL LBL 1 REP 2\n", "G98 L1 *\nG98 L0 *\nL1,0 *\nL1,2 *\n"},
      {"CALL PGM TNC:\\SUB\n", "%TNC:\\SUB.H *\n"},
      {"CALL PGM SUB.I ;called\n", "%SUB.I * ;called\n"},
      {"CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5\n", "G54 G90 X+5 *\n"},
      {"CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 IROT+5\n", "G73 G91 H+5 *\n"},
      {"CYCL DEF 9.0 VERWEILZEIT\nCYCL DEF 9.1 V.ZEIT 2\n",
       "CYCL DEF 9.0 VERWEILZEIT *\nCYCL DEF 9.1 V.ZEIT 2 *\n"},
      {"CYCL DEF 26.0 AXIS-SPECIFIC SCALING\nCYCL DEF 26.1 X2 Y1 CCX+0 CCY+0\n",
       "CYCL DEF 26.0 AXIS-SPECIFIC SCALING *\nCYCL DEF 26.1 X2 Y1 CCX+0 CCY+0 *\n"},
      {"TCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5\n",
       "G55 P01 Q5 P02 X- P03 X+5 Y+0 Z-5 *\n"},
      {"CYCL CALL M3\nCYCL CALL POS X+1 Y+2 Z+3\n", "G79 M3 *\nG79:G01 G90 X+1 Y+2 Z+3 *\n"},
      {"TCH PROBE 417 REF PT ;probe ~\n Q263=+1 ;POINT; ~\n Q333=+0 ;DATUM\n",
       "G417 REF PT ;probe ~\n    Q263=+1 ;POINT; ~\n    Q333=+0 * ;DATUM\n"},
      {"CYCL DEF 20 CONTOUR DATA ~\n Q1=-5\n", "G120 CONTOUR DATA ~\n    Q1=-5 *\n"},
      {"FN 0: Q5 = +7 ;seven\n", "D00 Q5 P01 +7 * ;seven\n"},
      {"FN 4: Q5 = +Q1 DIV -2\n", "D04 Q5 P01 +Q1 P02 -2 *\n"},
      {"LBL 3\nFN 9: IF +Q1 EQU +2 GOTO LBL 3\n", "G98 L3 *\nD09 P01 +Q1 P02 +2 P03 3 *\n"},
      {"FN 15: PRINT +1/+Q5\n", "D15 P01 +1 P02 +Q5 *\n"},
      {"FN 18: SYSREAD Q1 = ID20 NR1\n", "D18: SYSREAD Q1 = ID20 NR1 *\n"},
      {"Q5 = 2 * ( Q1 + 3 )\nQS1 = \"a*;b\" || QS2\n",
       "Q5 = 2 * ( Q1 + 3 ) *\nQS1 = \"a*;b\" || QS2 *\n"},
      {"/7 L X+1 ;skipped\n", "/N7 G01 G90 X+1 * ;skipped\n"},
      {"; alone\n* - Part *\n", "; alone\n* - Part * *\n"},
  };
  for (const auto& [klartext, iso] : kBlocks) CHECK(iso_of(klartext) == iso);
}

TEST_CASE("each block has its own G90 and G91") {
  CHECK(iso_of("L IX+1\nL X+2\nLBL 1\nL X+3\nLBL 0\nCALL LBL 1\nL X+4\n") ==
        "G01 G91 X+1 *\nG01 G90 X+2 *\nG98 L1 *\nG01 G90 X+3 *\nG98 L0 *\nL1,0 *\nG01 G90 X+4 *\n");
}

TEST_CASE("a block without a form is an error at its line, and a call by a parameter a note") {
  const auto parsed = parse_program(framed("L X+1\nC X+2 Y+2\nCALL PGM QS1\n"), "p.h");
  REQUIRE_FALSE(parsed.has_errors());
  const auto converted = to_iso(parsed.program, ".H");
  REQUIRE(converted.findings.size() == 2);
  CHECK(converted.findings[0].severity == klartext::Severity::Error);
  CHECK(converted.findings[0].range.begin.line == 3);
  CHECK(converted.findings[1].severity == klartext::Severity::Note);
  CHECK(converted.findings[1].range.begin.line == 4);
}

TEST_CASE("DIN/ISO becomes numbered Klartext, and its calls keep their files") {
  const auto parsed =
      parse_program("%P G70 *\nN10 G00 X+1 M3 * ;go\nN20 %SUB *\nN99 %P G70 *\n", "p.i");
  CHECK(to_klartext(parsed.program, ".I").text ==
        "0 BEGIN PGM P INCH\n1 L X+1 FMAX M3 ;go\n2 CALL PGM SUB.I\n3 END PGM P INCH\n");
}

}  // namespace
}  // namespace fitgauge::iso
