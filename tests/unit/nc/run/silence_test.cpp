#include "nc/program/cycles.hpp"
#include "nc/program/diagnose.hpp"
#include "workshop.hpp"

/// Each word of a program is executed, leaves a note, or is refused.
namespace fitgauge::interpreter {
namespace {

/// All that a run shows: how it ends, what it says, what the machine does.
std::string shown(Workshop& control, const std::string& body) {
  control.program(body);
  const RunResult result = control.run();
  std::string all = outcome(result) + "\n";
  for (const RunMessage& message : result.messages) all += message.text + "\n";
  for (const std::string& line : control.machine->lines()) all += line + "\n";
  return all;
}

bool says(const RunResult& result, std::string_view text) {
  return std::ranges::any_of(
      result.messages, [&](const RunMessage& m) { return m.text.find(text) != std::string::npos; });
}

/// With tables A and C and a preset that is turned by 30 degrees.
struct Tilting : Workshop {
  Tilting() {
    setup.machine.axes[3] = machine::AxisSetup::of(machine::Axis::A);
    setup.machine.axes[5] = machine::AxisSetup::of(machine::Axis::C);
    setup.machine.presets[0].frame.basic_rotation_deg = {0, 0, 30};
  }
};

TEST_CASE("each M function of the table changes something, says something, or ends one that does") {
  constexpr std::string_view kBefore[] = {"L X+0 Y+0 Z+50 R0 FMAX", "L X+0 Y+0 Z+50 R0 FMAX M3\nM8",
                                          "M136", "M128", "PLANE SPATIAL SPA+20 SPB+0 SPC+0 STAY"};
  for (const MFunction& function : m_functions()) {
    CAPTURE(function.number);
    const std::string block =
        "M" + std::to_string(function.number) + (function.number == 140 ? " MB10" : "");
    if (function.role == MRole::Ends) {
      const MFunction* ended = m_function(std::stoi(std::string(function.text)));
      REQUIRE(ended != nullptr);
      CHECK((ended->role == MRole::Notes || ended->role == MRole::Refuses));
      continue;
    }
    CHECK(function.text.empty() == (function.role == MRole::Does));
    bool changes = false;
    for (const std::string_view before : kBefore) {
      Tilting control;
      std::string text =
          "TOOL CALL 5 Z S1000 F500\nCYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=100 Q202=5 Q210=0 "
          "Q203=0 "
          "Q204=50 Q211=0\n";
      text += std::string(before) + "\n";
      const std::string with =
          shown(control, text + "L X+20 Y+5 Z+40 R0 F100 " + block + "\nL X+30 Z+45");
      const std::string without = shown(control, text + "L X+20 Y+5 Z+40 R0 F100\nL X+30 Z+45");
      if (with == without) continue;
      changes = true;
      const bool names = with.find("M" + std::to_string(function.number)) != std::string::npos;
      if (function.role != MRole::Does) CHECK(names);
      CHECK((with.find("failed") != std::string::npos) == (function.role == MRole::Refuses));
    }
    CHECK(changes);
  }
}

TEST_CASE("M143 deletes the basic rotation, M130 counts in the plane without tilt") {
  Tilting control;
  control.path(
      "FN 18: SYSREAD Q1 = ID210 NR1\nM143\nFN 18: SYSREAD Q2 = ID210 NR1\nL X+20 Y+0 F100");
  check_values(control.last, "Q1=30, Q2=0");
  CHECK(control.machine->state().nose[machine::Axis::X] == doctest::Approx(20));

  control.setup.machine.presets[0].frame.basic_rotation_deg = {};
  control.path("PLANE SPATIAL SPA+20 SPB+0 SPC+0 STAY\nL X+10 Y+20 Z+30 R0 F1000 M130");
  const auto tip = control.machine->position(machine::CoordinateSystem::Machine).linear;
  CHECK(tip.x == doctest::Approx(10));
  CHECK(tip.y == doctest::Approx(20));
  CHECK(tip.z == doctest::Approx(30));
}

TEST_CASE("M136 holds for the feed of its own block") {
  Workshop control;
  control.path("L X+110 F0.5 M136");
  CHECK(control.traced.back().seconds == doctest::Approx(100 / 500.0 * 60));
}

TEST_CASE("I of PATTERN DEF counts from the element before") {
  const std::string hole =
      "CYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=100 Q202=5 Q210=0 Q203=0 Q204=20 Q211=0\n";
  Workshop control;
  control.path(hole +
               "PATTERN DEF POS1 (X+25 Y+33.5 Z+0) POS2 (X+15 IY+6.5 Z+0)\nCYCL CALL PAT FMAX");
  const auto end = control.machine->position().linear;
  CHECK(end.x == doctest::Approx(15));
  CHECK(end.y == doctest::Approx(40));
  control.path(hole + "PATTERN DEF POS1 (IX+25 Y+33.5 Z+0)\nCYCL CALL PAT FMAX");
  CHECK(outcome(control.last).find("the first element has none before it") != std::string::npos);
}

TEST_CASE("what a parser accepts, the run reads") {
  for (const char* refused :
       {"PATTERN DEF ROW1 (X+1 Y+1 D5 NUM2 IROT+5 Z+0)", "PLANE AXIAL IA+10 STAY",
        "PLANE PROJECTED PROPR+1 PROMIN+2 IROT+3 STAY",
        "PLANE SPATIAL SPA+1 SPB+0 SPC+0 STAY SEQ+ SYM-",
        "PLANE SPATIAL SPA+1 SPB+0 SPC+0 STAY SEQ+ SEQ-", "PLANE RELATIV SPA+1 SPB+2 STAY",
        "PLANE SPATIAL SPA+1 SPB+0 SPC+0 STAY TABLE ROT COORD ROT", "CYCL DEF 26.1 X1 ICCX+3",
        "L X+1 M118 IX+1", "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS BANANA",
        "FUNCTION TCPM F TCP F TCP"}) {
    CAPTURE(refused);
    Workshop control;
    control.program(refused);
    CHECK(has_errors(control.diagnostics()));
  }
  for (const char* failing :
       {"CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 IA+10", "L X+1 FT5", "TOOL CALL 5.1 Z S100",
        "FUNCTION MODE TURN", "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT CENTER-CENTER"}) {
    CAPTURE(failing);
    Workshop control;
    control.setup.machine.tools[1].row.r2 = 1;
    control.path(failing);
    CHECK(control.last.status == RunStatus::Failed);
  }
  Tilting control;
  control.path("FUNCTION TCPM F CONT AXIS POS PATHCTRL AXIS REFPNT CENTER-CENTER F500");
  CHECK(control.last.status == RunStatus::Completed);  // R2 is 0: the centre of the ball is the tip
  CHECK(says(control.last, "F CONT"));
  CHECK(says(control.last, "FUNCTION TCPM F:"));
}

TEST_CASE("a cycle that resets a basic rotation says so") {
  Workshop control;
  control.setup.machine.presets[0].frame.basic_rotation_deg = {0, 0, 30};
  control.setup.features = {machine::Block{{-50, -50, -40}, {50, 50, 0}}};
  control.path(
      "TOOL CALL 30 Z\nL Z+50 FMAX\nTCH PROBE 427 MEASURE Q263=1 Q264=1 Q261=0 Q320=0 Q272=3 "
      "Q267=-1 Q260=9 "
      "Q281=0 Q288=1 Q289=-1 Q309=0 Q330=0");
  CHECK(outcome(control.last) == "completed");
  CHECK(says(control.last, "basic rotation of 30 degrees is reset by cycle 427"));
}

TEST_CASE("the next TOOL CALL sees what FN 27 has written into tool.t") {
  Workshop control;
  control.disk.write("TNC:\\table\\tool.t",
                     "BEGIN TOOL .T MM\nT    NAME     L         R\n5    MILL     +100      +4\n40  "
                     "          +0        "
                     "+0\n[END]\n");
  control.path(
      "Q5 = 115.029\nQ6 = 7.516\nFN 26: TABOPEN TNC:\\table\\tool.t\nFN 27: TABWRITE 40/\"L,R\" = "
      "Q5\n"
      "TOOL CALL 40 Z");
  check_completes(control.last, "Q108=7.516, Q114=115.029");
}

TEST_CASE("the datum table of the setup is active at the start") {
  Workshop control;
  control.disk.write(
      "TNC:\\table\\zero.d",
      "BEGIN ZERO .D MM\nNR   X         Y         Z\n1    +10       +20       +0\n[END]\n");
  control.options.datum_table = ControlPath::parse("TNC:\\table\\zero.d").value();
  control.path("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #1\nL X+0 Y+0 F500");
  CHECK(outcome(control.last) == "completed");
  CHECK(control.machine->state().nose[machine::Axis::X] == doctest::Approx(10));
}

TEST_CASE("no cycle that machines has a clearance below 0") {
  for (const MachiningCycle& cycle : machining_cycles()) {
    for (const probing::CycleParameter& parameter : cycle.descriptor.parameters) {
      if (parameter.meaning.find("learance") == std::string_view::npos) continue;
      if (parameter.meaning == "Clearance height") continue;  // a coordinate
      CAPTURE(cycle.descriptor.number);
      CAPTURE(parameter.meaning);
      CHECK(parameter.range.min == 0);
    }
  }
  Workshop control;
  const std::string drill =
      "CYCL DEF 200 DRILLING Q200=2 Q201=-5 Q206=100 Q202=5 Q210=0 Q203=0 Q211=0 Q204=";
  control.program(drill + "-0.001");
  REQUIRE(control.diagnostics().size() == 1);
  CHECK(control.diagnostics()[0].message.find("Q204") != std::string::npos);
  control.path("Q9 = -0.001\n" + drill + "Q9\nCYCL CALL");
  CHECK(outcome(control.last).starts_with("failed line 5: Range exceeded: Q204"));
  control.path(drill + "0\nCYCL CALL");
  CHECK(outcome(control.last) == "completed");
}

TEST_CASE("a tilt on a machine without rotary axes says that the tool does not tilt") {
  for (const std::string tilt :
       {"CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+10 B+0 C+0",
        "PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY", "PLANE VECTOR BX1 BY0 BZ0 NX0 NY0.1 NZ1 STAY"}) {
    CAPTURE(tilt);
    Workshop rigid;
    rigid.path(tilt);
    CHECK(says(rigid.last, "no rotary axes: the coordinates tilt, the tool does not"));
    Tilting tilting;
    tilting.path(tilt);
    CHECK_FALSE(says(tilting.last, "no rotary axes"));
  }
  Workshop level;
  level.path("CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+0 B+0 C+0\nPLANE RESET STAY");
  CHECK(outcome(level.last) == "completed");
  CHECK(level.last.messages.empty());
}

TEST_CASE("words that a run cannot do what they say with are refused or noted") {
  struct Row {
    std::string body;
    std::string_view says;
  };
  const std::string pocket =
      "CYCL DEF 251 RECTANGULAR POCKET Q215=1 Q218=50 Q219=30 Q207=500 Q201=-20 Q202=5 Q206=150 "
      "Q200=2 Q203=0 Q204=50 ";
  const std::string call = "\nCYCL CALL";
  for (const Row& row :
       {Row{"CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X A",
            "only X, Y and Z are mirrored here, not A"},
        Row{"TRANS MIRROR AXIS X B", "only X, Y and Z are mirrored here, not B"},
        Row{"CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T-0.1", "T of cycle 32 is -0.1"},
        Row{"CYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE 361", "cycle 13: 361 degrees"},
        Row{"CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+0 B+0 C+0 F500 ABST50",
            "cycle 19: F and ABST have no effect"},
        Row{"PLANE SPATIAL SPA+0 SPC+0 STAY", "PLANE without SPB, which counts as 0"},
        Row{"PLANE EULER EULPR+0 STAY", "PLANE without EULNU, EULROT, which"},
        Row{"M140", "a retraction needs MB with a length"},
        Row{"L M140 MB-5 F100", "a retraction needs MB with a length"},
        Row{"PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN MB-5 FMAX",
            "a retraction needs MB with a length"},
        Row{"LBL 1\nCALL LBL 1 REP-1", "Range exceeded: REP is less than 0"},
        Row{"TOOL CALL 30 Z S1000\n" + pocket + call,
            "cycle 251 machines with the touch probe, tool 30"},
        Row{pocket + "Q220=15.001" + call, "Rounding radius too large: Q220"},
        Row{pocket + "Q369=20" + call, "Oversize greater than depth: Q369"},
        Row{"CYCL DEF 254 CIRCULAR SLOT Q215=1 Q219=20 Q375=80 Q367=1 Q376=0 Q248=0 Q207=500 "
            "Q201=-20 Q202=5 Q206=150 Q200=2 Q203=0 Q204=50" +
                call,
            "Angular length is undefined: Q248"}}) {
    CAPTURE(row.body);
    Workshop control;
    control.path("M3\n" + row.body);
    CHECK(says(control.last, row.says));
  }
  Workshop fits;
  fits.path("M3\n" + pocket + "Q220=15 Q369=19.999" + call);
  CHECK(outcome(fits.last) == "completed");
  CHECK(fits.last.messages.empty());
  for (const std::string value : {"251 POCKET Q367=5", "254 CIRCULAR SLOT Q367=4",
                                  "254 CIRCULAR SLOT Q377=0", "220 POLAR PATTERN Q241=0"}) {
    fits.program("CYCL DEF " + value);
    REQUIRE(fits.diagnostics().size() == 1);
    CHECK(fits.diagnostics()[0].message.starts_with("Range exceeded: "));
  }
}

TEST_CASE("a lathe tool says that XL does not count in positioning") {
  Workshop control;
  machine::ToolSetup& tool = control.setup.machine.tools.emplace_back();
  tool.row.number = 6;
  tool.row.lathe = machine::LatheTool{.zl = 80, .xl = -40};
  control.path("TOOL CALL 6 Z\nL Z+0 FMAX");
  CHECK(says(control.last, "tool 6 is a lathe tool"));
  CHECK(control.machine->state().nose.linear.z == 80);
  control.path("TOOL CALL 5 Z\nL Z+0 FMAX");
  CHECK(control.last.messages.empty());
}

TEST_CASE("what is written of a lathe tool and has no effect is said") {
  Workshop control;
  machine::ToolSetup& tool = control.setup.machine.tools.emplace_back();
  tool.row.number = 6;
  tool.row.lathe = machine::LatheTool{.zl = 80, .xl = -40};
  const std::string ignored = "tool 6 is a lathe tool: DL has no effect";
  control.path("FN 17: SYSWRITE ID50 NR4 IDX6 = +0.1");
  CHECK(says(control.last, ignored));
  control.path("FN 17: SYSWRITE ID50 NR3 IDX6 = +0.4\nFN 17: SYSWRITE ID50 NR4 IDX5 = +0.1");
  CHECK(control.last.messages.empty());
  const auto write = [&](const std::string& name, const std::string& column) {
    const std::string path = "TNC:\\table\\" + name;
    control.disk.write(path, "BEGIN TOOL .T MM\nT    " + column + "\n6    +0.2\n[END]\n");
    control.path("Q5 = 0.3\nFN 26: TABOPEN " + path + "\nFN 27: TABWRITE 6/\"" + column +
                 "\" = Q5\nTOOL CALL 6 Z");
  };
  write("tool.t", "DL");
  CHECK(says(control.last, ignored));
  write("toolturn.trn", "DZL");
  CHECK(says(control.last, "FN 27 changes the file toolturn.trn"));
}

TEST_CASE("a hole by its countersink names the point angle") {
  Workshop control;
  control.path(
      "CYCL DEF 240 CENTERING Q200=2 Q343=1 Q201=-2 Q344=-10 Q206=100 Q211=0 Q203=0 Q204=20\nCYCL "
      "CALL");
  CHECK(outcome(control.last).find("No point angle defined") != std::string::npos);
}

TEST_CASE("a cycle of HEIDENHAIN that is not there is called that") {
  Workshop control;
  control.program("CYCL DEF 275 TROCHOIDAL SLOT Q223=50\nTCH PROBE 586 X Q1=2");
  const auto findings = control.diagnostics();
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].message.find("a cycle of HEIDENHAIN") != std::string::npos);
  CHECK(findings[1].message.find("the builder of the machine") != std::string::npos);
}

}  // namespace
}  // namespace fitgauge::interpreter
