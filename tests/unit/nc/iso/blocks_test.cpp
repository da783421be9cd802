#include <doctest/doctest.h>

#include "nc/iso/parser.hpp"
#include "nc/klartext/parser.hpp"

namespace fitgauge::iso {
namespace {

/// The Klartext of blocks between the first and the last line of a program.
std::string klartext_of(std::string_view blocks) {
  const auto parsed =
      parse_program("%T G71 *\n" + std::string(blocks) + "\nN99999999 %T G71 *\n", "t.i");
  for (const auto& diagnostic : parsed.diagnostics) MESSAGE(klartext::render(diagnostic));
  CHECK(parsed.diagnostics.empty());
  const std::string printed = klartext::print_program(parsed.program);
  const std::size_t first = printed.find('\n') + 1;
  return printed.substr(first, printed.rfind("\n9999") - first);
}

struct Twin {
  std::string_view iso;
  std::string_view klartext;
};

void check(std::initializer_list<Twin> twins) {
  for (const Twin& twin : twins) {
    CAPTURE(twin.iso);
    CHECK(klartext_of(twin.iso) == twin.klartext);
  }
}

TEST_CASE("The first and the last line give name and unit") {
  const auto parsed = parse_program("%A b-1 G70 *\nN9999 %A b-1 G70 *\nrest", "a.i");
  CHECK_FALSE(parsed.has_errors());
  const auto* begin = parsed.program.blocks().front().as<klartext::BeginProgram>();
  REQUIRE(begin != nullptr);
  CHECK(parsed.program.text(begin->name) == "A b-1");
  CHECK(parsed.program.unit() == klartext::Unit::Inch);
  CHECK(parsed.program.source() == "%A b-1 G70 *\nN9999 %A b-1 G70 *\nrest");
}

TEST_CASE("A text is DIN/ISO by its first block, or by the name of its file") {
  CHECK(is_iso("\xEF\xBB\xBF; a\r\n\r\n%T G71 *", "a.h"));
  CHECK(is_iso("N10 G00 X+1", "a.I"));
  CHECK_FALSE(is_iso("N10 G00 X+1", "a.h"));
  CHECK_FALSE(is_iso("0 BEGIN PGM T MM", "a.i"));
  CHECK_FALSE(is_iso("", "i"));
}

TEST_CASE("Straight lines") {
  check({{"N10 G00 G40 G90 Z+100 M3 *", "10 L Z+100 R0 FMAX M3"},
         {"N20 G01 G41 X+10 Y-5.5 F200 *", "20 L X+10 Y-5.5 RL F200"},
         {"N30 G01 X+1 F200 *\nN40 Y+2", "30 L X+1 F200\n40 L Y+2"},
         {"/N10 G01 G91 X+5 G90 Y+Q1 ; a", "/10 L IX+5 Y+Q1 ; a"},
         {"G00 X+1 F300 M91", "L F300\nL X+1 FMAX M91"},
         {"N5 G07 X+46 G43 F100 *", "5 X+46 R+ F100"},
         {"N5 G01 G44 X+46 F MAX *", "5 L X+46 R- FMAX"},
         {"N5 G40 *\nN6 F250 *\nN7 M3 M8 *", "5 L R0\n6 L F250\n7 M3 M8"},
         {"N5 G00 Z+5 M140 MB50 F200 *", "5 L Z+5 FMAX M140 MB50 F200"},
         {"N5 M3 F200 G01 Y+2 *", "5 L Y+2 M3 F200"},
         {"N5 M128 F200 G00 Y+2 *", "5 L FMAX M128 F200 Y+2"},
         {"N5 G90 *", "5"},
         {"N9 G01 ~\n X+1 ~\n Y+2 *", "9 L X+1 Y+2"}});
}

TEST_CASE("Arcs and polar coordinates") {
  check({{"N10 I+25 J-5 *", "10 CC X+25 Y-5"},
         {"N10 G91 J+2 K+3 *", "10 CC IY+2 IZ+3"},
         {"N10 G29 *", "10 CC"},
         {"N10 G02 X+1 Y+2 I+0 J+0 F100 *", "10 CC X+0 Y+0\n10 C X+1 Y+2 DR- F100"},
         {"N10 G03 X+1 Y+2 R-20 *\nN20 G05 X+5 R+3", "10 CR X+1 Y+2 R-20 DR+\n20 CR X+5 R+3 DR+"},
         {"N10 G06 X+1 Y+2 *", "10 CT X+1 Y+2"},
         {"N10 G02 X+1 M3 R+20 Y+2 *", "10 CR X+1 R+20 Y+2 DR- M3"},
         {"N10 M3 H+45 G11 R+10 *", "10 LP PA+45 PR+10 M3"},
         {"N10 G10 R+10 H+45 *", "10 LP PR+10 PA+45 FMAX"},
         {"N10 G11 G42 R+10 G91 H+45 F90 *", "10 LP PR+10 IPA+45 RR F90"},
         {"N10 G13 G91 H+1080 Z+5 *\nN20 G12 G90 H+0\nN30 G15 H+5",
          "10 CP IPA+1080 IZ+5 DR+\n20 CP PA+0 DR-\n30 CP PA+5 DR-"},
         {"N10 G16 R+30 H+30 *", "10 CTP PR+30 PA+30"},
         {"N10 G24 R5 F50 *", "10 CHF 5 F50"},
         {"N10 G25 R+2.5 *", "10 RND R+2.5"}});
}

TEST_CASE("G26 and G27 give the blocks before and behind them an arc") {
  check({{"N10 G01 G41 X+5 Y+6 F200 *\nN20 G26 R10 * ; in\nN30 X+50 *",
          "10 APPR LCT X+5 Y+6 R+10 RL F200\n20 ; in\n30 L X+50"},
         {"N10 G01 X+5 F90 *\nN20 G27 R3 *\nN30 G00 G40 X-20 Y-20 *",
          "10 L X+5 F90\n20\n30 DEP LCT X-20 Y-20 R+3 FMAX"},
         {"N10 G11 G42 R+5 H+6 F200 *\nN20 G26 R10 *", "10 APPR PLCT PR+5 PA+6 R+10 RR F200\n20"}});
}

TEST_CASE("Tools, blank and stop") {
  check({{"N10 T5 G17 S2000 DL+0.1 DR-0.2 DR2+0.3 F400 *",
          "10 TOOL CALL 5 Z S2000 DL+0.1 DR-0.2 DR2+0.3 F400"},
         {"N10 T\"PROBE\" G19 *\nN20 TQS1\nN30 TQ5",
          "10 TOOL CALL \"PROBE\" X\n20 TOOL CALL QS1 X\n30 TOOL CALL Q5 X"},
         {"N10 T1 G00 Z+5 S100 M3 *", "10 TOOL CALL 1 Z S100\n10 L Z+5 FMAX M3"},
         {"N10 S500 *", "10 TOOL CALL S500"},
         {"N10 G51 T7 *", "10 TOOL DEF 7"},
         {"N10 G99 T1 L+0 R+4 *", "10 TOOL DEF 1 L+0 R+4"},
         {"N10 G30 G17 X+0 Y+0 Z-40 *\nN20 G31 G90 X+100 Y+100 Z+0 *",
          "10 BLK FORM 0.1 Z X+0 Y+0 Z-40\n20 BLK FORM 0.2 X+100 Y+100 Z+0"},
         {"N10 G38 M9 *", "10 STOP M9"}});
}

TEST_CASE("Transformations and the other cycles of words") {
  check({{"N10 G04 F2.5 *", "10 CYCL DEF 9.0 DWELL TIME\n10 CYCL DEF 9.1 DWELL 2.5"},
         {"N10 G28 X Y *", "10 CYCL DEF 8.0 MIRROR IMAGE\n10 CYCL DEF 8.1 X Y"},
         {"N10 G28 *", "10 CYCL DEF 8.0 MIRROR IMAGE\n10 CYCL DEF 8.1"},
         {"N10 G36 S+90 *", "10 CYCL DEF 13.0 ORIENTATION\n10 CYCL DEF 13.1 ANGLE +90"},
         {"N10 G37 P01 1 P02 3 *",
          "10 CYCL DEF 14.0 CONTOUR GEOMETRY\n10 CYCL DEF 14.1 CONTOUR LABEL 1/3"},
         {"N10 G39 TNC:\\A\\LOT31.I *",
          "10 CYCL DEF 12.0 PGM CALL\n10 CYCL DEF 12.1 PGM TNC:\\A\\LOT31.I"},
         {"N10 G39 P01 12 *", "10 CYCL DEF 12.0 PGM CALL\n10 CYCL DEF 12.1 PGM 12"},
         {"N10 G53 P01 5 *", "10 CYCL DEF 7.0 DATUM SHIFT\n10 CYCL DEF 7.1 #5"},
         {"N10 G54 G90 X+25 G91 Y+5 *", "10 CYCL DEF 7.0 DATUM SHIFT\n10 CYCL DEF 7.1 X+25 IY+5"},
         {"N10 G62 T0.05 *", "10 CYCL DEF 32.0 TOLERANCE\n10 CYCL DEF 32.1 T0.05"},
         {"N10 G62 *", "10 CYCL DEF 32.0 TOLERANCE\n10 CYCL DEF 32.1"},
         {"N10 G72 F0.8 *", "10 CYCL DEF 11.0 SCALING\n10 CYCL DEF 11.1 SCL0.8"},
         {"N10 G73 G91 H+35 *", "10 CYCL DEF 10.0 ROTATION\n10 CYCL DEF 10.1 IROT+35"},
         {"N10 G80 A+0 B+30 C-Q5 *",
          "10 CYCL DEF 19.0 WORKING PLANE\n10 CYCL DEF 19.1 A+0 B+30 C-Q5"},
         {"N10 G55 P01 10 P02 X- P03 X+50 Y+0 Z-5 *",
          "10 TCH PROBE 0.0 REF. PLANE Q10 X-\n10 TCH PROBE 0.1 X+50 Y+0 Z-5"},
         {"N10 G79 M3 *\nN20 G79:PAT F100 *", "10 CYCL CALL M3\n20 CYCL CALL PAT F100"},
         {"N10 G79:G01 X+5 Y+6 F100 *", "10 CYCL CALL POS X+5 Y+6 F100"}});
}

TEST_CASE("Cycles stand in one line or in several") {
  const std::string_view probe =
      "10 TCH PROBE 421 MEASURE HOLE ~\n    Q273=+50 ;CENTRE ~\n    Q274=+Q5";
  check({{"N10 G421 MEASURE HOLE Q273=+50 Q274=+Q5 * ;all",
          "10 TCH PROBE 421 MEASURE HOLE ~\n    Q273=+50 ~\n    Q274=+Q5 ;all"},
         {"N10 G421 MEASURE HOLE ~\n Q273=+50 ;CENTRE~\n Q274=+Q5 *", probe},
         {"N10 G421 MEASURE HOLE\nQ273=+50 ;CENTRE\n  Q274=+Q5 * ;", probe},
         {"N10 G421 MEASURE HOLE\n  Q273=+50  ;CENTRE\n  Q274=+Q5\nN20 G00 X+1",
          std::string(probe).append("\n20 L X+1 FMAX")},
         {"N10 G444 Q263=+0 QS400=\"0.4;-0.1\" *",
          "10 TCH PROBE 444 ~\n    Q263=+0 ~\n    QS400=\"0.4;-0.1\""},
         {"N10 G200 Q200=2 *\nQ5 = 1 *", "10 CYCL DEF 200 ~\n    Q200=+2\nQ5 = 1"},
         {"N10 G120 Q1=-20 *", "10 CYCL DEF 20 ~\n    Q1=-20"},
         {"N10 TCH PROBE 421\n Q273=+50 *", "10 TCH PROBE 421 ~\n    Q273=+50"}});
}

TEST_CASE("Labels, repetitions and calls") {
  check({{"N10 G98 L1 *\nN20 G98 L\"UP\" *\nN30 G98 L0 *", "10 LBL 1\n20 LBL \"UP\"\n30 LBL 0"},
         {"N10 L1,0 *\nN20 L1 *\nN30 L\"UP\",3 *\nN40 LQS1,Q5",
          "10 CALL LBL 1\n20 CALL LBL 1\n30 CALL LBL \"UP\" REP3\n40 CALL LBL QS1 REPQ5"},
         {"N10 %UP1 *\nN20 %TNC:\\a\\b.h *\nN30 %:'QS1' *",
          "10 CALL PGM UP1\n20 CALL PGM TNC:\\a\\b.h\n30 CALL PGM :'QS1'"}});
}

TEST_CASE("Parameters and functions") {
  check({{"N10 Q1 = Q2 * 3 + SIN 30 *", "10 Q1 = Q2 * 3 + SIN 30"},
         {"N10 QS1 = \"a;*\" || QS2 * ;x", "10 QS1 = \"a;*\" || QS2 ;x"},
         {"N10 D00 Q5 P01 +60 *", "10 FN 0: Q5 = +60"},
         {"N10 D01 QL1 P01 -Q2 P02 -5 *", "10 FN 1: QL1 = -Q2 + -5"},
         {"N10 D04 Q4 P01 +8 P02 +Q02 *", "10 FN 4: Q4 = +8 DIV +Q2"},
         {"N10 D05 Q20 P01 +4 *\nN20 D13 Q1 P01 +3 P02 +4",
          "10 FN 5: Q20 = SQRT +4\n20 FN 13: Q1 = +3 ANG +4"},
         {"N10 D09 P01 +Q1 P02 +Q3 P03 \"UP 25\" *", "10 FN 9: IF +Q1 EQU +Q3 GOTO LBL \"UP 25\""},
         {"N10 D12 P01 +Q1 P02 +3 P03 5 *", "10 FN 12: IF +Q1 LT +3 GOTO LBL 5"},
         {"N10 D14 P01 1000 *", "10 FN 14: ERROR = 1000"},
         {"N10 D15 P01 Q1 P02 \"text\" *", "10 FN 15: PRINT +Q1/\"text\""},
         {"N10 D16 P01 mask.a / SCREEN: *", "10 FN 16: F-PRINT mask.a / SCREEN:"},
         {"N10 D18: SYSREAD Q25 = ID210 NR4 IDX3 *", "10 FN 18: SYSREAD Q25 = ID210 NR4 IDX3"},
         {"N10 D19 P01 +10 P02 +Q5 *", "10 FN 19: PLC = +10/+Q5"},
         {"N10 D20: WAIT FOR SYNC *", "10 FN 20: WAIT FOR SYNC"},
         {"N10 D26: TABOPEN x.tab *\nN20 D28: TABREAD Q1 = 5/\"X,Y\"",
          "10 FN 26: TABOPEN x.tab\n20 FN 28: TABREAD Q1 = 5/\"X,Y\""},
         {"N10 D37 P01 10 P02 Q5 *", "10 FN 37: EXPORT +10/+Q5"},
         {"N10 D38 P01 \"a %F\" P02 +Q1 *", "10 FN 38: SEND /\"a %F\"/+Q1"},
         {"N10 DECLARE STRING QS1 = \"a\" *", "10 DECLARE STRING QS1 = \"a\""},
         {"N10 PLANE RESET STAY *", "10 PLANE RESET STAY"},
         {"N10 * - part *", "10 * - part"}});
}

}  // namespace
}  // namespace fitgauge::iso
