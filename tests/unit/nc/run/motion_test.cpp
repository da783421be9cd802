#include "run_fixture.hpp"

namespace fitgauge::interpreter {
namespace {

/// A control with a cutter 5 (length 100, radius 4) and rotary axes A and C.
class Mill : public Control {
 public:
  Mill() {
    add_cutter();
    for (const machine::Axis axis : {machine::Axis::A, machine::Axis::C}) {
      setup.machine.axes[machine::index(axis)] = machine::AxisSetup::of(axis);
      setup.machine.axes[machine::index(axis)]->direction = machine::unit_vector(axis);
    }
  }

  /// The moves of a program that follows TOOL CALL 5, as lines of the trace.
  Lines moves(std::string_view body) {
    program("TOOL CALL 5 Z S1000 F500\n" + std::string(body));
    last = run();
    return traced_lines({"L ", "ARC "}, {" A+0.0000 C+0.0000", ".0000"});
  }

  RunResult last;
};

TEST_CASE("coordinates are absolute or incremental, omitted axes stay") {
  Mill mill;
  CHECK(mill.moves("L X+10 Y+20 Z+30 FMAX\nL IX-5 FMAX\nL IZ+2,5 F100\nL Y+0") ==
        Lines{"L X+10 Y+20 Z+30 FMAX", "L X+5 Y+20 Z+30 FMAX", "L X+5 Y+20 Z+32.5000 F100",
              "L X+5 Y+0 Z+32.5000 F100"});
}

TEST_CASE("FMAX is not modal, F AUTO is the feed of TOOL CALL, FU and FZ follow the spindle") {
  Mill mill;
  CHECK(mill.moves("L X+1 F100\nL X+2 FMAX\nL X+3\nL X+4 F AUTO\nL X+5 FU0.2\nL X+6 FZ0.1") ==
        Lines{"L X+1 Y+0 Z+400 F100", "L X+2 Y+0 Z+400 FMAX", "L X+3 Y+0 Z+400 F100",
              "L X+4 Y+0 Z+400 F500", "L X+5 Y+0 Z+400 F200", "L X+6 Y+0 Z+400 F200"});
}

TEST_CASE("TOOL CALL without a number changes only what it names") {
  Mill mill;
  mill.moves(
      "TOOL CALL DL+0.5 DR+0.1\nQ1 = Q114\nQ2 = Q108\nTOOL CALL S300\nQ3 = Q114\nTOOL CALL DL+0\n"
      "Q4 = Q114\nQ5 = Q108\nTOOL CALL 5\nQ6 = Q108");
  check_completes(mill.last, "Q1=100.5, Q2=4.1, Q3=100.5, Q4=100, Q5=4.1, Q6=4");
  mill.moves("TOOL CALL S-1");
  CHECK(outcome(mill.last) ==
        "failed line 3: Input value incorrect: S of a tool call is 0 or more; DL, DR and DR2 are "
        "numbers");
}

TEST_CASE("an undefined parameter leaves its axis out of a positioning block") {
  Mill mill;
  CHECK(mill.moves("L X+Q1 Y+7 FMAX\nL X-Q2 FMAX") == Lines{"L X+0 Y+7 Z+400 FMAX"});
  CHECK(outcome(mill.last) == "completed");
  mill.moves("L X+1 FQ3");
  CHECK(outcome(mill.last) ==
        "failed line 3: parameter Q3 is undefined; assign it before this block reads it");
}

TEST_CASE("a pole and a datum shift do not take an undefined parameter") {
  const char* text =
      "failed line 2: parameter Q3 is undefined; assign it before this block reads it";
  Control control;
  CHECK(outcome(control.run("CC X+Q3 Y+0")) == text);
  CHECK(outcome(control.run("CC X+1 IY-Q3")) == text);
  CHECK(outcome(control.run("TRANS DATUM AXIS X+Q3")) == text);
}

TEST_CASE("a DIST that ends before the nominal contact is noted") {
  Control control;
  control.setup.machine.probes[0].row.distance = 3;
  control.setup.features = {machine::Block{.min = {0, 0, -40}, .max = {100, 80, 0.1}}};
  const auto measure = [&control](const std::string& clearance) {
    return control.run(
        "TOOL CALL 30 Z\nTCH PROBE 427 MEASURE COORDINATE ~\n Q263=+50 ~\n Q264=+40 ~\n"
        " Q261=+0 ~\n Q272=+3 ~\n Q267=-1 ~\n Q260=+50 ~\n Q320=" +
        clearance);
  };
  CHECK(measure("+1").messages.empty());
  const RunResult result = measure("+1.05");
  CHECK(outcome(result) == "completed");
  REQUIRE(result.messages.size() == 1);
  CHECK(result.messages[0].text.starts_with("DIST (3 mm) is shorter than SET_UP + Q320 (3.05 mm)"));
}

TEST_CASE("an INCH program moves in millimetres") {
  Mill mill;
  mill.program("TOOL CALL 5 Z S1000\nL X+1 FMAX\nL X+2 F20", "main.h", true);
  const RunResult result = mill.run();
  CHECK(outcome(result) == "completed");
  const auto& moves = mill.traced;
  REQUIRE(moves.size() == 2);
  CHECK(moves[0].end[machine::Axis::X] == doctest::Approx(25.4));
  CHECK(moves[1].feed_mm_min == doctest::Approx(50.8));
}

TEST_CASE("M91 positions the spindle nose from the machine datum") {
  Mill mill;
  CHECK(mill.moves("CYCL DEF 7.0 X\nCYCL DEF 7.1 X+10\nL X+50 Z+200 FMAX M91").back() ==
        "L X+40 Y+0 Z+100 FMAX");
}

TEST_CASE("M140 retracts along the tool axis") {
  Mill mill;
  CHECK(mill.moves("L Z+10 FMAX\nL M140 MB50 F300").back() == "L X+0 Y+0 Z+60 F300");
  CHECK(mill.moves("L Z+10 FMAX\nM140 MB MAX").back() == "L X+0 Y+0 Z+400 FMAX");
}

TEST_CASE("arcs") {
  Mill mill;
  CHECK(mill.moves("L X+10 Y+0 Z+0 FMAX\nCC X+0 Y+0\nC X+0 Y+10 DR+ F100").back() ==
        "ARC X+0 Y+10 Z+0 CC X+0 Y+0 Z+0 +90 F100");
  CHECK(mill.moves("L X+10 Y+0 Z+0 FMAX\nCC X+0 Y+0\nC DR- F100").back() ==
        "ARC X+10 Y+0 Z+0 CC X+0 Y+0 Z+0 -360 F100");
  CHECK(mill.moves("L X+10 Y+0 Z+0 FMAX\nCC X+0 Y+0\nCP IPA+3600 IZ-5 DR+ F100").back() ==
        "ARC X+10 Y+0 Z-5 CC X+0 Y+0 Z-5 +3600 F100");
  CHECK(mill.moves("L X+10 Y+0 Z+0 FMAX\nCR X+0 Y+10 R-10 DR- F100").back() ==
        "ARC X+0 Y+10 Z+0 CC X+0 Y+0 Z+0 -270 F100");
}

TEST_CASE("the two axes of CC span the plane of the arcs that follow") {
  Mill mill;
  // From Z towards X, the angle counts from Z (decision 29).
  const Lines zx =
      mill.moves("L X+75 Y+0 Z+0 R0 FMAX\nCC Z+0 X+75\nLP PR+20 PA-90 F500\nCP IPA+90 DR+");
  CHECK(zx[1] == "L X+55 Y+0 Z+0 F500");
  CHECK(zx[2] == "ARC X+75 Y+0 Z+20 CC X+75 Y+0 Z+0 +90 F500");
  CHECK(mill.moves("L X+10 Y+0 Z+0 FMAX\nCC X+0 Z+0\nC X+0 Z+10 DR- F500").back() ==
        "ARC X+0 Y+0 Z+10 CC X+0 Y+0 Z+0 -90 F500");
  CHECK(mill.moves("L X+0 Y+10 Z+0 FMAX\nCC Y+0 Z+0\nC Y+0 Z+10 DR+ F500").back() ==
        "ARC X+0 Y+0 Z+10 CC X+0 Y+0 Z+0 +90 F500");
  CHECK(mill.moves("L X+0 Y+10 Z+0 FMAX\nCR Y+0 Z+10 R+10 DR+ F500").back() ==
        "ARC X+0 Y+0 Z+10 CC X+0 Y+0 Z+0 +90 F500");
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nL X+10 F500\nCT X+15 Z-5").back() ==
        "ARC X+15 Y+0 Z-5 CC X+10 Y+0 Z-5 +90 F500");
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nL X+20 F500\nRND R2\nCC Z+0 X+30\nC Z+0 X+40 DR+").size() ==
        4);
}

TEST_CASE("a CC with one axis keeps the other of the CC before") {
  Mill mill;
  CHECK(mill.moves("L X+17 Y+0 Z+0 FMAX\nCC X+10 Y+0\nC X+3 Y+0 DR+ F100\nL X+30 Y+7\nCC X+30\n"
                   "C X+37 Y+0 DR+")
            .back() == "ARC X+37 Y+0 Z+0 CC X+30 Y+0 Z+0 +270 F100");
  mill.moves("CC X+0 Y+0 Z+0");
  CHECK(outcome(mill.last) == "failed line 3: CC must have the two axes of a plane");
}

TEST_CASE("CHF takes its length from both sides") {
  Mill mill;
  CHECK(mill.moves("L X+50 Y+95 Z+0 FMAX\nL X+95 F100\nCHF 10\nL Y+0") ==
        Lines{"L X+50 Y+95 Z+0 FMAX", "L X+85 Y+95 Z+0 F100", "L X+95 Y+85 Z+0 F100",
              "L X+95 Y+0 Z+0 F100"});
}

TEST_CASE("paraxial blocks, lengthened and shortened by the radius of the tool") {
  Mill mill;
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nX+46 R+ F100\nY+20 R0\nX+0 R-") ==
        Lines{"L X+0 Y+0 Z+0 FMAX", "L X+50 Y+0 Z+0 F100", "L X+50 Y+20 Z+0 F100",
              "L X+4 Y+20 Z+0 F100"});
}

TEST_CASE("CALL LBL REP before its label jumps forward") {
  Control control;
  control.program("Q1 = 0\nCALL LBL 1 REP3\nQ1 = 5\nLBL 1\nQ1 = Q1 + 1");
  REQUIRE(control.diagnostics().size() == 1);
  CHECK(control.diagnostics()[0].severity == klartext::Severity::Warning);
  CHECK(value(control.run(), "Q1") == "1");
}

TEST_CASE("TABLE ROT turns a free axis of the table") {
  Mill mill;
  const auto q122 = [&](const std::string& words) {
    mill.moves("PLANE SPATIAL " + words + "\nQ1 = Q122\nQ2 = Q120");
    return value(mill.last, "Q1") + " " + value(mill.last, "Q2");
  };
  CHECK(q122("SPA+0 SPB+0 SPC+20 STAY TABLE ROT") == "20 0");
  CHECK(q122("SPA+0 SPB+0 SPC+180 STAY TABLE ROT") == "180 0");
  CHECK(q122("SPA+0 SPB+0 SPC-20 STAY TABLE ROT") == "-20 0");
  CHECK(q122("SPA+0 SPB+0 SPC+20 STAY COORD ROT") == "0 0");
  CHECK(q122("SPA+0 SPB+0 SPC+20 STAY") == "0 0");
  // Turned so, the plane's main axis lies along the machine's: 10 mm in X move X alone.
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+20 TURN FMAX TABLE ROT\n"
                   "L X+0 Y+0 FMAX\nFN 18: SYSREAD Q1 = ID240 NR1 IDX2\nL X+10 FMAX\n"
                   "FN 18: SYSREAD Q2 = ID240 NR1 IDX2\nQ3 = Q2 - Q1")
            .size() > 2);
  CHECK(std::abs(number_of(mill.last, "Q3")) < 1e-9);
}

TEST_CASE("arcs that are none are errors") {
  Mill mill;
  const auto outcome_of = [&](std::string_view body) {
    mill.moves(body);
    return outcome(mill.last);
  };
  CHECK(outcome_of("C X+1 Y+1 DR+") == "failed line 3: an arc needs a centre: write CC before it");
  CHECK(outcome_of("L X+10 FMAX\nCC X+0 Y+0\nC X+0 Y+11 DR+") ==
        "failed line 5: the end of the arc is 1.0000 mm outside its circle in the plane XY: CC "
        "gives the centre, and its two axes give the plane");
  CHECK(outcome_of("CR X+30 Y+0 R+10 DR+") ==
        "failed line 3: CR: no arc of radius 10 mm joins two points 30.0000 mm apart");
  CHECK(outcome_of("LP PR+5 PA+3") ==
        "failed line 3: polar coordinates need a pole: write CC before them");
  CHECK(outcome_of("L X+10 FMAX\nRND R50\nL Y+10 FMAX") ==
        "failed line 5: Rounding radius too large: it does not fit between the two blocks");
  CHECK(outcome_of("L X+10 FMAX\nRND R5\nM8") ==
        "failed line 5: Rounding-off undefined: RND or CHF must be followed by a contour element");
}

TEST_CASE("a rounding between a line and an arc is tangential to both") {
  Mill mill;
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nL X+20 F100\nRND R2\nCC X+10 Y+0\nC X+0 Y+0 DR+\nL Y-5") ==
        Lines{"L X+0 Y+0 Z+0 FMAX", "L X+17.7460 Y+0 Z+0 F100",
              "ARC X+19.6825 Y+2.5000 Z+0 CC X+17.7460 Y+2 Z+0 +104.4775 F100",
              "ARC X+0 Y+0 Z+0 CC X+10 Y+0 Z+0 +165.5225 F100", "L X+0 Y-5 Z+0 F100"});
}

TEST_CASE("elements that follow each other tangentially have no corner to round") {
  Mill mill;
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nL X+20 F100\nRND R2\nCC X+20 Y-20\nC X+40 Y-20 DR-\n"
                   "L Y-50")
            .size() == 4);
  CHECK(outcome(mill.last) == "completed");
  mill.moves("L X+0 Y+0 Z+0 FMAX\nL X+20 F100\nRND R2\nCC X+20 Y+20\nC X+20 Y+40 DR-\nL X+30");
  CHECK(mill.last.messages.back().number == 1023);  // the arc goes back along the line
}

TEST_CASE("APPR and DEP by lines and arcs") {
  Mill mill;
  mill.setup.machine.tools.back().row.r = 0;  // the path is the contour
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nAPPR LN X+10 Y+10 LEN5 RL F100\nL X+30\nDEP LN LEN6") ==
        Lines{"L X+0 Y+0 Z+0 FMAX", "L X+10 Y+15 Z+0 FMAX", "L X+10 Y+10 Z+0 F100",
              "L X+30 Y+10 Z+0 F100", "L X+30 Y+16 Z+0 F100"});
  CHECK(mill.moves("L X+0 Y+0 Z+0 FMAX\nAPPR CT X+10 Y+10 CCA90 R5 RL F100\nL X+30\n"
                   "DEP CT CCA90 R5") == Lines{"L X+0 Y+0 Z+0 FMAX", "L X+5 Y+15 Z+0 FMAX",
                                               "ARC X+10 Y+10 Z+0 CC X+10 Y+15 Z+0 +90 F100",
                                               "L X+30 Y+10 Z+0 F100",
                                               "ARC X+35 Y+15 Z+0 CC X+30 Y+15 Z+0 +90 F100"});
  CHECK(mill.moves("L X+0 Y+30 Z+0 FMAX\nAPPR LCT X+10 Y+10 R5 RL F100\nL X+30\n"
                   "DEP LCT X+35 Y+40 R5") ==
        Lines{"L X+0 Y+30 Z+0 FMAX", "L X+5.2337 Y+13.4892 Z+0 F100",
              "ARC X+10 Y+10 Z+0 CC X+10 Y+15 Z+0 +72.4120 F100", "L X+30 Y+10 Z+0 F100",
              "ARC X+35 Y+15 Z+0 CC X+30 Y+15 Z+0 +90 F100", "L X+35 Y+40 Z+0 F100"});
  // The way to the auxiliary point runs at the feed of the block before, that of LCT at its own.
  CHECK(mill.moves("L X+0 Y+0 Z+0 F700\nAPPR LT X+10 Y+10 LEN5 RL F100\nL X+30")[1] ==
        "L X+5 Y+10 Z+0 F700");
}

TEST_CASE("PLANE turns the axes and the coordinates") {
  Mill mill;
  mill.moves(
      "PLANE SPATIAL SPA+0 SPB+0 SPC+0 STAY\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX\n"
      "FN 18: SYSREAD Q1 = ID210 NR5 IDX1\nFN 18: SYSREAD Q2 = ID210 NR6\nQ3 = Q120\n"
      "PLANE RESET TURN FMAX\nFN 18: SYSREAD Q4 = ID210 NR6\n"
      "FN 18: SYSREAD Q5 = ID240 NR1 IDX4");
  check_completes(mill.last, "Q1=30, Q2=-1");
  CHECK(std::abs(number_of(mill.last, "Q3")) == doctest::Approx(30));
  check_values(mill.last, "Q4=0, Q5=0");
}

TEST_CASE("Q120 to Q122 and PLANE AXIAL count from the zero of each rotary axis") {
  Mill mill;
  mill.setup.machine.presets[0].frame.rotary_offsets_deg = {0, 0, 10};
  const auto axes_after = [&](const std::string& blocks) {
    mill.moves("TRANS DATUM AXIS C+5\n" + blocks +
               "\nFN 18: SYSREAD Q1 = ID240 NR1 IDX4\nFN 18: SYSREAD Q2 = ID240 NR1 IDX6");
    return value(mill.last, "Q1") + " " + value(mill.last, "Q2");
  };
  const std::string plane = "PLANE SPATIAL SPA+30 SPB+0 SPC+0 ";
  CHECK(axes_after(plane + "TURN FMAX") == "30 0");
  CHECK(axes_after(plane + "STAY\nL A+Q120 C+Q122 FMAX") == "30 0");
  CHECK(axes_after("PLANE AXIAL A+30 C+20 TURN FMAX") == "30 35");
  CHECK(axes_after("L C+20 FMAX\nPLANE AXIAL A+30 STAY\nL A+Q120 C+Q122 FMAX") == "30 35");
}

TEST_CASE("the datum shift before a tilted plane is its origin and comes back with PLANE RESET") {
  Mill mill;
  mill.moves(
      "TRANS DATUM AXIS X+10 Y+5\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\n"
      "FN 18: SYSREAD Q1 = ID220 NR2 IDX1\nTRANS DATUM AXIS X+2\nPLANE RESET STAY\n"
      "FN 18: SYSREAD Q2 = ID220 NR2 IDX1");
  check_completes(mill.last, "Q1=0, Q2=10");
}

TEST_CASE("machine faults are errors of the run with their place") {
  Mill mill;
  mill.moves("L X+1000 FMAX");
  CHECK(mill.last.status == RunStatus::Failed);
  CHECK(mill.last.messages.back().line == 3);
  mill.moves("L U+1 FMAX");
  CHECK(mill.last.status == RunStatus::Failed);
}

TEST_CASE("a note is given once for what the simulation leaves out") {
  Mill mill;
  mill.moves("FN 19: PLC=+1/+0\nFN 19: PLC=+2/+0\nL X+3 R0 F100");
  CHECK(mill.last.messages.size() == 1);
  CHECK(mill.last.messages[0].kind == MessageKind::Note);
}

TEST_CASE("a cycle call without a cycle is an error") {
  Mill mill;
  mill.moves("CYCL CALL");
  CHECK(mill.last.messages.back().number == 1027);
}

}  // namespace
}  // namespace fitgauge::interpreter
