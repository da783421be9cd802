#include "run_fixture.hpp"

namespace fitgauge::interpreter {
namespace {

TEST_CASE("labels, jumps and loops") {
  Control control;
  const RunResult result = control.run(
      "Q1 = 0\nQ2 = 0\nLBL 1\nQ2 = Q2 + Q1\nQ1 = Q1 + 1\nFN 12: IF +Q1 LT +100 GOTO LBL 1\n"
      "FN 9: IF +Q2 EQU +4950 GOTO LBL \"done\"\nQ3 = 1\nLBL \"DONE\"");
  check_completes(result, "Q2=4950, Q3=undefined");
  // BEGIN, two assignments, 100 passes of four blocks, FN 9, LBL, END.
  CHECK(result.blocks_executed == 3 + 400 + 3);
}

TEST_CASE("a part is run once more than REP says") {
  Control control;
  check_completes(
      control.run("Q1 = 0\nQ2 = 0\nLBL 1\nQ1 = Q1 + 1\nLBL 2\nQ2 = Q2 + 1\nCALL LBL 2 REP 2\n"
                  "CALL LBL 1 REP 3"),
      "Q1=4, Q2=12");
}

TEST_CASE("LBL 0 within a repeated part is passed over") {
  Control control;
  const RunResult result = control.run("Q1 = 0\nLBL 2\nQ1 = Q1 + 1\nLBL 0\nCALL LBL 2 REP14");
  CHECK(value(result, "Q1") == "15");
}

TEST_CASE("subprograms return to their call, also when nested and called by a parameter") {
  Control control;
  check_completes(
      control.run(
          "Q1 = 0\nCALL LBL 5\nQS1 = \"sub\"\nCALL LBL QS1\nQ9 = 5\nCALL LBL Q9\nL X+0 FMAX M30\n"
          "LBL 5\nQ1 = Q1 + 1\nCALL LBL \"SUB\"\nLBL 0\nLBL \"SUB\"\nQ1 = Q1 + 10\nLBL 0"),
      "Q1=32");
}

TEST_CASE("recursion without end is an error of the control") {
  Control control;
  const RunResult result = control.run("LBL 1\nCALL LBL 1\nLBL 0");
  CHECK(outcome(result) ==
        "failed line 3: Excessive nesting: more than 19 subprograms call each other");
  CHECK(result.messages.back().number == 1025);
}

TEST_CASE("a called program has its own QL and shares Q") {
  Control control;
  control.program("Q1 = Q1 + 1\nQL1 = 7\nQ2 = QL1", "sub.h");
  check_completes(
      control.run("Q1 = 1\nQL1 = 3\nCALL PGM sub.h\nCALL PGM TNC:\\nc_prog\\SUB.H\nQ3 = QL1"),
      "Q1=3, Q2=7, Q3=3, QL1=3");
}

TEST_CASE("programs that call themselves end in an error") {
  Control control;
  const RunResult result = control.run("CALL PGM main.h");
  CHECK(outcome(result) ==
        "failed line 2: Excessive nesting: more than 19 programs call each other");
}

TEST_CASE("a text of a cycle is in the unit of the program that contains it") {
  for (const bool main_is_inch : {false, true}) {
    CAPTURE(main_is_inch);
    Control control;
    control.setup.features = {machine::Block{{0, 0, -40}, {100, 80, -0.1}}};
    control.program(
        "TCH PROBE 444 PROBING IN 3-D ~\n Q263=+25 Q264=+25 Q294=+0 Q581=0 Q582=0 Q583=1 Q320=0 "
        "Q260=30 QS400=\"0.01-0.01\" Q309=0",
        "mm.h", false);
    control.program(
        "TCH PROBE 1400 POSITION PROBING ~\n QS1100=\"1\" Q1101=+1 Q1102=+0 Q372=-3 "
        "Q320=0 Q260=+1 Q1125=+0 Q309=0 Q1120=0",
        "inch.h", true);
    control.program("TOOL CALL 30 Z\nCALL PGM mm.h\nQ1 = Q183\nCALL PGM inch.h", "main.h",
                    main_is_inch);
    check_completes(control.run(), "Q1=2, Q950=1, Q951=1");
  }
}

TEST_CASE("M30 in a called program ends the run") {
  Control control;
  control.program("L M30\nQ5 = 1", "sub.h");
  check_completes(control.run("QL2 = 4\nCALL PGM sub.h\nQ1 = 1"),
                  "Q1=undefined, Q5=undefined, QL2=4");
}

TEST_CASE("a missing program is an error where it is called and a warning before") {
  Control control;
  control.program("Q1 = 1\nCALL PGM missing.h");
  const auto found = control.diagnostics();
  REQUIRE(found.size() == 1);
  CHECK(found[0].severity == klartext::Severity::Warning);
  CHECK(found[0].code == klartext::DiagnosticCode::FileMissing);
  CHECK(found[0].range.begin.line == 3);
  CHECK(outcome(control.run()) == "failed line 3: program TNC:\\nc_prog\\missing.h does not exist");
}

TEST_CASE("a program cannot leave the control's disk") {
  Control control;
  CHECK(outcome(control.run("CALL PGM ..\\..\\..\\etc\\passwd")) ==
        "failed line 2: path '..\\..\\..\\etc\\passwd' leaves TNC:\\; only files below it can be "
        "used");
}

TEST_CASE("SEL PGM, CALL SELECTED PGM and cycle 12") {
  Control control;
  control.program("Q1 = Q1 + 1", "sub.h");
  check_completes(
      control.run(
          "Q1 = 0\nSEL PGM \"sub.h\"\nCALL SELECTED PGM\nCYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM "
          "sub.h\nCYCL CALL\nCYCL CALL"),
      "Q1=3");
}

TEST_CASE("conditions compare numbers with a tolerance, strings exactly") {
  Control control;
  check_completes(
      control.run(
          "Q1 = 0.1 + 0.2\nQ2 = 0\nQS1 = \"a\"\nFN 9: IF +Q1 EQU +0.3 GOTO LBL 1\nQ2 = 1\nLBL 1\n"
          "FN 9: IF QS1 EQU \"a\" GOTO LBL 2\nQ2 = 2\nLBL 2\nFN 9: IF Q9 IS UNDEFINED GOTO LBL 3\n"
          "Q2 = 3\nLBL 3\n"
          "FN 10: IF +Q1 NE +0.3 GOTO LBL 4\nQ3 = 1\nLBL 4\nFN 11: IF +1 GT +1 GOTO LBL 5\nQ4 = 1\n"
          "LBL 5"),
      "Q2=0, Q3=1, Q4=1");
}

TEST_CASE("a coordinate without a value is left out, and a note says so") {
  Control control;
  const RunResult result = control.run("TOOL CALL 30 Z\nL X+Q1 Y+5 FMAX\nL X+Q1 FMAX");
  REQUIRE(result.messages.size() == 1);
  CHECK(result.messages[0].kind == MessageKind::Note);
  CHECK(result.messages[0].line == 3);
  CHECK(result.messages[0].text == "X is left out: its parameter is undefined");
}

TEST_CASE("an undefined operand of a comparison is an error") {
  Control control;
  CHECK(outcome(control.run("FN 9: IF +Q7 EQU +1 GOTO LBL 1\nLBL 1")) ==
        "failed line 2: parameter Q7 is undefined; assign it before this block reads it");
  CHECK(outcome(control.run("FN 12: IF +1 LT +Q8 GOTO LBL 1\nLBL 1")) ==
        "failed line 2: parameter Q8 is undefined; assign it before this block reads it");
  CHECK(outcome(control.run("FN 10: IF +Q7 NE +1 GOTO LBL 1\nLBL 1")) ==
        "failed line 2: parameter Q7 is undefined; assign it before this block reads it");
}

TEST_CASE("block skip passes over blocks marked with a slash") {
  Control control;
  control.program("Q1 = 1\n/Q1 = 2\n/ 4 Q2 = 1\nQ3 = 3");
  CHECK(value(control.run(), "Q1") == "2");
  control.options.block_skip = true;
  check_values(control.run(), "Q1=1, Q2=undefined, Q3=3");
}

TEST_CASE("a programmed stop is reported and the run goes on, or ends") {
  Control control;
  control.program("Q1 = 1\nSTOP\nQ2 = 2\nL M0\nQ3 = 3");
  RunResult result = control.run();
  CHECK(result.status == RunStatus::Completed);
  REQUIRE(result.messages.size() == 2);
  CHECK(result.messages[0].kind == MessageKind::Stop);
  CHECK(result.messages[0].line == 3);
  CHECK(value(result, "Q3") == "3");
  control.options.on_stop = OnStop::End;
  result = control.run();
  CHECK(result.status == RunStatus::Stopped);
  CHECK(result.messages.size() == 1);
  CHECK(value(result, "Q2") == "undefined");
}

TEST_CASE("parameters are set before the first block") {
  Control control;
  control.options.parameters = {{{klartext::QSpace::Q, 1}, 25.0},
                                {{klartext::QSpace::Qs, 1}, std::string("H7")},
                                {{klartext::QSpace::Ql, 3}, 4.0}};
  check_values(control.run("Q2 = Q1 + QL3\nQS2 = QS1 || \"!\""), "Q2=29, QS2=H7!");
}

}  // namespace
}  // namespace fitgauge::interpreter
