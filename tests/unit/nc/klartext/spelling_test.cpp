#include <doctest/doctest.h>

#include "parse_support.hpp"

namespace fitgauge::klartext {
namespace {

/// A block as found in programs, and as the printer writes it.
struct Spelling {
  std::string_view written;
  std::string_view canonical;
};

void check(std::initializer_list<Spelling> spellings) {
  for (const Spelling& spelling : spellings) {
    CAPTURE(spelling.written);
    CHECK(canonical(spelling.written) == spelling.canonical);
    CHECK(canonical(spelling.canonical) == spelling.canonical);
  }
}

void check_unchanged(std::initializer_list<std::string_view> blocks) {
  for (const std::string_view block : blocks) check({{block, block}});
}

TEST_CASE("Skip mark, block number and comment are optional and kept") {
  check({{"/80 M30", "/80 M30"},
         {"/ 45 LBL 1", "/45 LBL 1"},
         {"/CALL PGM TNC:\\A.H", "/CALL PGM TNC:\\A.H"},
         {"26  L   X+1   ; a  comment ", "26 L X+1 ; a  comment"},
         {"12", "12"},
         {";whole line", ";whole line"},
         {"7 ;", "7 ;"},
         {"* - text", "* - text"},
         {"*   - text", "*   - text"},
         {"*     - text", "*     - text"},
         {"* text", "* - text"}});
}

TEST_CASE("A block without a number counts on from the one before it") {
  const auto numbers = [](std::string text) {
    std::vector<std::uint32_t> found;
    const ParsedProgram parsed = parse_program(std::move(text), "p.h");
    for (const Block& block : parsed.program.blocks()) found.push_back(block.number);
    return found;
  };
  CHECK(numbers("BEGIN PGM A MM\n\n; x\nL X+1 ~\nY+1\nEND PGM A MM") ==
        std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(numbers("10 BEGIN PGM A MM\n; x\n/26 M30\n26 M30\nEND PGM A MM") ==
        std::vector<std::uint32_t>{10, 11, 26, 26, 27});
  const ParsedProgram bad = parse_program("BEGIN PGM A MM\nGARBAGE\nEND PGM A MM", "p.h");
  REQUIRE(bad.diagnostics.size() == 1);
  CHECK(bad.diagnostics[0].block == 1U);
}

TEST_CASE("A comment wrapped by ~ is one comment") {
  check({{";please modify it~\n under all", ";please modify it under all"},
         {"L X+1 ;a ~\nb", "L X+1 ;a b"},
         {"L X+1 ~  \n  Y+2", "L X+1 Y+2"},
         {"CALL PGM :'QS4' b ~\n", "CALL PGM :'QS4' b"}});
}

TEST_CASE("FN functions in their spellings") {
  check(
      {{"FN 0: Q5 = +Q6", "FN 0: Q5 = +Q6"},
       {"FN0 : Q1 = -200.66", "FN 0: Q1 = -200.66"},
       {"FN 0:Q3=354", "FN 0: Q3 = +354"},
       {"FN 0: Q52 =+3203", "FN 0: Q52 = +3203"},
       {"FN 0: Q5 SET UNDEFINED", "FN 0: Q5 SET UNDEFINED"},
       {"FN 1: Q1 = +Q2 + +5", "FN 1: Q1 = +Q2 + +5"},
       {"FN 2: Q1 = +10 - -Q5", "FN 2: Q1 = +10 - -Q5"},
       {"FN 3: Q2 = +3 * 3", "FN 3: Q2 = +3 * +3"},
       {"FN 4: Q4 = +4 DIV +Q8", "FN 4: Q4 = +4 DIV +Q8"},
       {"FN 5: Q20 = SQRT 4", "FN 5: Q20 = SQRT +4"},
       {"FN 6: Q20 = SIN-Q5", "FN 6: Q20 = SIN -Q5"},
       {"FN 7: Q21 = COS-Q5", "FN 7: Q21 = COS -Q5"},
       {"FN 8: Q10 = +5 LEN +4", "FN 8: Q10 = +5 LEN +4"},
       {"FN 9: IF +1 EQU +1 GOTO LBL 1", "FN 9: IF +1 EQU +1 GOTO LBL 1"},
       {"FN 9: IF Q3 EQU +0 GOTO LBL5", "FN 9: IF +Q3 EQU +0 GOTO LBL 5"},
       {"FN 9: IF Q1 IS UNDEFINED GOTO LBL \"UPR\"", "FN 9: IF +Q1 IS UNDEFINED GOTO LBL \"UPR\""},
       {"FN 9: IF QL1 IS DEFINED GOTO LBL QS5", "FN 9: IF +QL1 IS DEFINED GOTO LBL QS5"},
       {"FN 9: IF QS1 EQU \"a\" GOTO LBL 1", "FN 9: IF QS1 EQU \"a\" GOTO LBL 1"},
       {"FN 10: IF +10 NE -Q5 GOTO LBL 10", "FN 10: IF +10 NE -Q5 GOTO LBL 10"},
       {"FN 11: IF +Q1 GT +10 GOTO LBL QS5", "FN 11: IF +Q1 GT +10 GOTO LBL QS5"},
       {"FN 12: IF +Q5 LT +QR0 GOTO LBL 1", "FN 12: IF +Q5 LT +QR0 GOTO LBL 1"},
       {"FN 13: Q20 = +25 ANG -Q1", "FN 13: Q20 = +25 ANG -Q1"},
       {"FN 14: ERROR = 1000", "FN 14: ERROR = 1000"},
       {"FN 14: ERROR= 1042", "FN 14: ERROR = 1042"},
       {"FN 15: PRINT Q1/Q2/\"text\"", "FN 15: PRINT +Q1/+Q2/\"text\""},
       {"FN 17: SYSWRITE ID50 NR4 IDXQ2 = Q1604", "FN 17: SYSWRITE ID50 NR4 IDXQ2 = +Q1604"},
       {"FN 18: SYSREAD Q1 = ID20 NR1", "FN 18: SYSREAD Q1 = ID20 NR1"},
       {"FN18 : SYSREAD Q1 = ID 503 NR5 IDX1", "FN 18: SYSREAD Q1 = ID503 NR5 IDX1"},
       {"FN 19: PLC=+10/+Q3", "FN 19: PLC = +10/+Q3"},
       {"FN 20: WAIT FOR SYNC", "FN 20: WAIT FOR SYNC"},
       {"FN 20: WAIT FOR I5==1", "FN 20: WAIT FOR I5==1"},
       {"FN 23: Q20 = CDATA Q30", "FN 23: Q20 = CDATA Q30"},
       {"FN 24: Q20 = CDATA Q30", "FN 24: Q20 = CDATA Q30"},
       {"FN 29: PLC=+10/+Q3", "FN 29: PLC = +10/+Q3"},
       {"FN 37: EXPORT QS10", "FN 37: EXPORT QS10"},
       {"FN 38: SEND /\"text %F\" / +Q1", "FN 38: SEND /\"text %F\"/+Q1"}});
}

TEST_CASE("Masks, tables and programs are named bare, in quotes or by QS parameters") {
  check(
      {{"FN 16: F-PRINT TNC:\\MASK\\MASK1.A/ RS232:\\PROT1.A",
        "FN 16: F-PRINT TNC:\\MASK\\MASK1.A / RS232:\\PROT1.A"},
       {"FN 16: F-PRINT \"82552.a\" / SCREEN:", "FN 16: F-PRINT 82552.a / SCREEN:"},
       {"FN 16: F-PRINT :'QS1' / :'QS2'", "FN 16: F-PRINT :'QS1' / :'QS2'"},
       {"FN 16: F-PRINT a.a / TNC:\\log\\:'QS2'.TXT", "FN 16: F-PRINT a.a / TNC:\\log\\:'QS2'.TXT"},
       {"FN 26: TABOPEN TNC:\\dir\\TAB1.TAB", "FN 26: TABOPEN TNC:\\dir\\TAB1.TAB"},
       {"FN 26: TABOPEN 82553_hole.tab", "FN 26: TABOPEN 82553_hole.tab"},
       {"FN 27: TABWRITE 5/\"Radius,Depth,D\" = Q5", "FN 27: TABWRITE 5/\"Radius,Depth,D\" = Q5"},
       {"FN 28: TABREAD Q10 = 6/\"X,Y,D\"", "FN 28: TABREAD Q10 = 6/\"X,Y,D\""},
       {"FN 28: TABREAD Q4 = Q22/QS1", "FN 28: TABREAD Q4 = Q22/QS1"},
       {"FN 28: TABREAD Q4 = Q22/:'QS1'", "FN 28: TABREAD Q4 = Q22/QS1"},
       {"CALL PGM 82551", "CALL PGM 82551"},
       {"CALL PGM \"TNC:\\a b;c.h\"", "CALL PGM \"TNC:\\a b;c.h\""},
       {"CALL PGM QS3", "CALL PGM :'QS3'"},
       {"SEL PGM \"x.h\"", "SEL PGM x.h"},
       {"call selected pgm", "CALL SELECTED PGM"},
       {"SEL TABLE \"x.D\"", "SEL TABLE x.D"}});
}

TEST_CASE("Labels, calls and repeats") {
  check({{"LBL 1", "LBL 1"},
         {"LBL 65534", "LBL 65534"},
         {"LBL \"UP 1\"", "LBL \"UP 1\""},
         {"LBL0", "LBL 0"},
         {"CALL LBL 5", "CALL LBL 5"},
         {"CALL LBL Q0", "CALL LBL Q0"},
         {"CALL LBL QS3", "CALL LBL QS3"},
         {"CALL LBL 5 REP2", "CALL LBL 5 REP2"},
         {"CALL LBL 5 REP 2", "CALL LBL 5 REP2"},
         {"CALL LBL 5 REP 2/2", "CALL LBL 5 REP2"},
         {"CALL LBL 5 REP Q3/Q3", "CALL LBL 5 REPQ3"},
         {"CALL LBL5 REP2", "CALL LBL 5 REP2"},
         {"CALL LBL \"A\" REPQ106", "CALL LBL \"A\" REPQ106"}});
}

TEST_CASE("Texts") {
  check({{"QS10 = \"text ; not a comment\"", "QS10 = \"text ; not a comment\""},
         {"declare string QS10=\"text\"", "DECLARE STRING QS10 = \"text\""},
         {"QS10 = QS12||QS13 || \"x\"", "QS10 = QS12 || QS13 || \"x\""},
         {"QS11 = TOCHAR(DAT+Q50 DECIMALS4)", "QS11 = TOCHAR( DAT+Q50 DECIMALS4 )"},
         {"QS11 = TOCHAR ( DAT-Q50 )", "QS11 = TOCHAR( DAT-Q50 )"},
         {"QS13 = SUBSTR( SRC_QS10 BEG2 LEN4 )", "QS13 = SUBSTR( SRC_QS10 BEG2 LEN4 )"},
         {"Q82 = TONUMB( SRC_QS11 )", "Q82 = TONUMB( SRC_QS11 )"},
         {"Q50 = INSTR( SRC_QS10 SEA_QS13 BEG2 )", "Q50 = INSTR( SRC_QS10 SEA_QS13 BEG2 )"},
         {"Q50 = INSTR( SRC_QS10 SEA_\"x\" )", "Q50 = INSTR( SRC_QS10 SEA_\"x\" )"},
         {"Q52 = STRLEN( SRC_QS15 ) + 1", "Q52 = STRLEN( SRC_QS15 ) + 1"},
         {"Q52 = STRCOMP( SRC_QS12 SEA_QS14 )", "Q52 = STRCOMP( SRC_QS12 SEA_QS14 )"},
         {"QS25 = SYSSTR( ID 10950 NR 1 )", "QS25 = SYSSTR( ID10950 NR1 )"}});
}

TEST_CASE("Positioning blocks") {
  check({{"L X10", "L X+10"},
         {"l x+10 y-q5 r0 fmax m99", "L X+10 Y-Q5 R0 FMAX M99"},
         {"L X1,5", "L X+1.5"},
         {"L X10. Y.5", "L X+10 Y+0.5"},
         {"L IX+10 IZ-QL3", "L IX+10 IZ-QL3"},
         {"L F MAX M99", "L FMAX M99"},
         {"L X+1 F AUTO", "L X+1 FAUTO"},
         {"L X+1 FU0.2", "L X+1 FU0.2"},
         {"L X+1 FZ 0.1", "L X+1 FZ0.1"},
         {"L X+1 FQ5", "L X+1 FQ5"},
         {"L Z+250 R0 FMAX M91", "L Z+250 R0 FMAX M91"},
         {"L Z+250 M140 MB MAX", "L Z+250 M140 MB MAX"},
         {"M140 MB50 F750", "M140 MB50 F750"},
         {"M118 X0.5 Y1", "M118 X+0.5 Y+1"},
         {"M138 A C", "M138 A C"},
         {"M3 M8", "M3 M8"},
         {"L A+Q120 C+Q122", "L A+Q120 C+Q122"},
         {"LN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 F1000", "LN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 F1000"},
         {"CC X+0 IY+5", "CC X+0 IY+5"},
         {"CC", "CC"},
         {"C X+5 Y+5 DR- RL", "C X+5 Y+5 DR- RL"},
         {"C DR+", "C DR+"},
         {"CR X+0 Y+5 R-20 DR-", "CR X+0 Y+5 R-20 DR-"},
         {"CR X+0 Y+5 R20 DR+ R0 F100", "CR X+0 Y+5 R+20 DR+ R0 F100"},
         {"CT X+1 Y+2", "CT X+1 Y+2"},
         {"LP PR+10 IPA+30", "LP PR+10 IPA+30"},
         {"LP IPR+2 PAQ3", "LP IPR+2 PA+Q3"},
         {"CP IPA+9000 Z-30 DR+", "CP IPA+9000 Z-30 DR+"},
         {"CP DR+", "CP DR+"},
         {"CTP PR+10 PA+30", "CTP PR+10 PA+30"},
         {"RND R5 F100", "RND R+5 F100"},
         {"RND RQ5", "RND R+Q5"},
         {"CHF 2", "CHF 2"},
         {"CHF Q2 F50", "CHF Q2 F50"},
         {"APPR LT X+10 Y+20 LEN15 RR F100", "APPR LT X+10 Y+20 LEN15 RR F100"},
         {"APPR LN X+1 Y+2 LEN15 RL", "APPR LN X+1 Y+2 LEN15 RL"},
         {"APPR CT X+1 Y+2 CCA180 R+7 RL", "APPR CT X+1 Y+2 CCA180 R+7 RL"},
         {"APPR LCT X+1 Y+2 R10 RL", "APPR LCT X+1 Y+2 R+10 RL"},
         {"APPR PLT PR+1 PA+2 LEN15 RL", "APPR PLT PR+1 PA+2 LEN15 RL"},
         {"DEP LT LEN12.5 F100", "DEP LT LEN12.5 F100"},
         {"DEP CT CCA180 R+8", "DEP CT CCA180 R+8"},
         {"DEP LCT X+10 Y+12 R+8", "DEP LCT X+10 Y+12 R+8"},
         {"L X+5 R F5000 M13", "L X+5 F5000 M13"},
         {"L X+5 R F M", "L X+5"},
         {"L X+5 R F M ; end", "L X+5 ; end"},
         {"L X+5 R- F500", "L X+5 R- F500"},
         {"L M128. F10000.", "L M128 F10000"},
         {"CR X+1 Y+2 R+ 20 DR+", "CR X+1 Y+2 R+20 DR+"},
         {"X+46 R+ F1000", "X+46 R+ F1000"},
         {"7 Z0.0 B0.0", "7 Z+0 B+0"},
         {"IY-5 R0 FMAX", "IY-5 R0 FMAX"},
         {"C+45 F100", "C+45 F100"},
         {"/X+1", "/X+1"},
         {"STOP", "STOP"},
         {"STOP M6", "STOP M6"}});
}

TEST_CASE("A number may be joined to the word before it") {
  check({{"CYCL DEF9.0 VARAKOZASI IDO", "CYCL DEF 9.0 VARAKOZASI IDO"},
         {"CYCL DEF9.1 V.IDO2", "CYCL DEF 9.1 V.IDO2"},
         {"CYCL DEF9 .0", "CYCL DEF 9.0"},
         {"CYCL DEF 9 .0 DWELL", "CYCL DEF 9.0 DWELL"},
         {"CYCL DEF 12.1 LOT31", "CYCL DEF 12.1 LOT31"},
         {"CYCL DEF200 DRILLING", "CYCL DEF 200 DRILLING"},
         {"TCH PROBE417 TS AXIS", "TCH PROBE 417 TS AXIS"},
         {"TOOL CALL1 Z S1000", "TOOL CALL 1 Z S1000"},
         {"TOOL CALLQ5 Z", "TOOL CALL Q5 Z"},
         {"TOOL DEF1 L+0 R+5", "TOOL DEF 1 L+0 R+5"}});
}

TEST_CASE("Tools and workpiece blanks") {
  check(
      {{"TOOL CALL 30 Z S2000", "TOOL CALL 30 Z S2000"},
       {"TOOL CALL 5.1 Z S2000 F100 DL+0.1 DR-0.2 DR2+0.3",
        "TOOL CALL 5.1 Z S2000 F100 DL+0.1 DR-0.2 DR2+0.3"},
       {"TOOL CALL \"PROBE 1\" Z", "TOOL CALL \"PROBE 1\" Z"},
       {"TOOL CALL QS1 Z", "TOOL CALL QS1 Z"},
       {"TOOL CALL S3000", "TOOL CALL S3000"},
       {"TOOL CALL Y", "TOOL CALL Y"},
       {"TOOL CALL 0", "TOOL CALL 0"},
       {"TOOL DEF 5", "TOOL DEF 5"},
       {"TOOL DEF 1 L+0 R+5", "TOOL DEF 1 L+0 R+5"},
       {"BLK FORM 0.1 Z X+0 Y+0 Z-20", "BLK FORM 0.1 Z X+0 Y+0 Z-20"},
       {"BLK FORM 0.2  X+QR1  IY+100  Z+0", "BLK FORM 0.2 X+QR1 IY+100 Z+0"},
       {"BLK FORM CYLINDER Z R50 L105 DIST+5 RI10", "BLK FORM CYLINDER Z R+50 L+105 DIST+5 RI+10"},
       {"BLK FORM CYLINDER Z D120 L80 DIST-5 DI60", "BLK FORM CYLINDER Z D+120 L+80 DIST-5 DI+60"},
       {"BLK FORM ROTATION Z DIM_R LBL1", "BLK FORM ROTATION Z DIM_R LBL 1"},
       {"BLK FORM FILE \"a.stl\" TARGET \"b.stl\"", "BLK FORM FILE \"a.stl\" TARGET \"b.stl\""}});
}

TEST_CASE("Coordinate transformations and modes") {
  check_unchanged({"TRANS DATUM AXIS X+10 IY-5",
                   "TRANS DATUM RESET",
                   "TRANS DATUM TABLE TABLINE5",
                   "TRANS DATUM TABLE \"a.d\" TABLINE5",
                   "TRANS MIRROR AXIS X Y",
                   "TRANS MIRROR RESET",
                   "TRANS ROTATION ROT+35",
                   "TRANS ROTATION IROT-5",
                   "TRANS ROTATION RESET",
                   "TRANS SCALE SCL+0.99",
                   "TRANS SCALE RESET",
                   "PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN MB50 FMAX SEQ- TABLE ROT",
                   "PLANE SPATIAL SPA+0 SPB+45 SPC+0 MOVE DIST+50 F1000 SYM+ COORD ROT",
                   "PLANE RESET STAY",
                   "PLANE PROJECTED PROPR+24 PROMIN+24 ROT+30 STAY",
                   "PLANE EULER EULPR+45 EULNU+20 EULROT+22 STAY",
                   "PLANE VECTOR BX+0.8 BY-0.4 BZ-0.42 NX+0.2 NY+0.2 NZ+0.92 STAY",
                   "PLANE POINTS P1X+0 P1Y+0 P1Z+20 P2X+30 P2Y+31 P2Z+20 P3X+0 P3Y+41 P3Z+32 STAY",
                   "PLANE RELATIV SPB-45 STAY",
                   "PLANE AXIAL B-45 STAY",
                   "FUNCTION MODE MILL",
                   "FUNCTION MODE MILL \"AC_TABLE\"",
                   "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS",
                   "FUNCTION RESET TCPM"});
}

TEST_CASE("Keywords and letters are read without regard to case, texts are kept") {
  check({{"tch probe 417 Datum in ts axis ~\n q333=+q5 ;Neuer Bezug",
          "TCH PROBE 417 Datum in ts axis ~\n    Q333=+Q5 ;Neuer Bezug"},
         {"lbl \"Up\"", "LBL \"Up\""},
         {"fn 9: if +q1 equ +1 goto lbl 5", "FN 9: IF +Q1 EQU +1 GOTO LBL 5"}});
}

}  // namespace
}  // namespace fitgauge::klartext
