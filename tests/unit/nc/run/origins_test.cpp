#include <fmt/ranges.h>

#include "run_fixture.hpp"

namespace fitgauge::interpreter {
namespace {

using Lines = std::vector<std::string>;

/// Follows every block, as a check on a setup does.
class EveryBlock final : public RunObserver {
 public:
  bool follows_every_block() const override { return true; }
};

const std::string kFace =
    "TCH PROBE 427 MEASURE COORDINATE ~\n Q263=+QL1 ~\n Q264=+40 ~\n Q261=+0 ~\n Q320=+0 ~\n "
    "Q272=+QL3 ~\n Q267=-1 ~\n Q260=+20 ~\n Q281=+0 ~\n Q288=+1 ~\n Q289=-1 ~\n Q309=+0 ~\n "
    "Q330=+0\n";

/// The line of the error, then each place that it names: `5`, `2: QL3 set here`.
Lines origins(std::string_view body, bool is_inch = false, bool has_bore = false) {
  Control control;
  control.setup.features.push_back(machine::Block{{0, 0, -40}, {100, 80, 0}});
  if (has_bore) control.setup.features.push_back(machine::Bore{{50.1, 40}, 0, 30, 30});
  control.program("L X+Q9 FMAX", "other.h");
  control.program("Q8 = 1", "quiet.h");
  control.program(body, "main.h", is_inch);
  EveryBlock observer;
  const auto file = control.programs.get(*control.disk.find(Control::main_path()));
  REQUIRE(file->program != nullptr);
  machine::SimulatedMachine machine(control.setup);
  const auto result =
      run(file->program, {machine, control.disk, control.programs, control.clock, observer}, {});
  const auto found = findings_of(result);
  if (found.empty()) return {};
  Lines all{std::to_string(found[0].range.begin.line)};
  for (const auto& note : found[0].notes)
    all.push_back(note.program + std::to_string(note.range.begin.line) + ": " + note.message);
  return all;
}

TEST_CASE("an error names the blocks that it comes from") {
  struct Case {
    std::string body;
    Lines found;
    bool is_inch = false;
  };
  const std::string jump = "FN 9: IF +1 EQU +2 GOTO LBL 9\n";
  const std::string height = "FN 18: SYSREAD Q1 = ID270 NR1 IDX3\nFN 9: IF +Q1 EQU +";
  const std::string jump_behind = " GOTO LBL 9\nM30\nLBL 9\nFN 14: ERROR = 1000";
  const std::string drilling =
      "CYCL DEF 200 DRILLING ~\n Q200=+2 ~\n Q201=-10 ~\n Q206=+150 ~\n Q202=+5 ~\n Q210=+0 ~\n "
      "Q203=+0 ~\n Q204=+20 ~\n Q211=+0\n";
  const std::string call = "CALL LBL 1\nM30\nLBL 1\n" + kFace + "LBL 0";
  const Case cases[] = {
      // A value of a parameter: the one that the error names, from the call.
      {"QL1 = 50\nQL3 = -3\nTOOL CALL 30 Z\n" + call, {"8", "3: QL3 set here"}},
      {"QL3 = 3\nQL1 = -300\nTOOL CALL 30 Z\n" + call, {"8", "3: QL1 set here", "2: QL3 set here"}},
      // A subprogram that the program has passed through before: what the call has set.
      {"TOOL CALL 30 Z\nQL1 = 50\nQL3 = 3\nLBL 1\n" + kFace + "LBL 0\nQL3 = -3\nCALL LBL 1",
       {"6", "20: QL3 set here"}},
      // The tool.
      {"QL1 = 50\nQL3 = 3\nTOOL CALL 0 Z\n" + kFace, {"5", "4: tool set here"}},
      {"QL1 = 50\nQL3 = 3\n" + kFace, {"4"}},
      // The axes that a block leaves alone; of the others where they have come from.
      {"TOOL CALL 30 Z\nL Z+50 FMAX\nL X+50 Y+40 FMAX\nL Z-5 FMAX", {"5", "4: Y, X set here"}},
      {"TOOL CALL 30 Z\nL X-20 Y+40 FMAX\nL Z-5 FMAX\nTRANS DATUM AXIS X+5\nL X+50 FMAX",
       {"6", "3: Y set here", "4: Z set here", "5: datum set here"}},
      // The unit, where lengths are too long.
      {"TOOL CALL 30 Z\nL Z+100 FMAX", {"3", "1: the lengths are in INCH"}, true},
      // A test by the program itself: the jump, what it reads, and the position read there.
      {"TOOL CALL 30 Z\nL X+20 Y+30 FMAX\nFN 18: SYSREAD Q1 = ID270 NR1 IDX1\n"
       "FN 9: IF +Q1 EQU +20 GOTO LBL 9\nM30\nLBL 9\nFN 14: ERROR = 1000",
       {"8", "5: condition set here", "4: Q1 set here", "2: tool set here", "3: Y, X set here"}},
      // A value that was computed: what it was computed from, and the position when it was read.
      {"TOOL CALL 30 Z\nL X+20 Y+30 FMAX\nFN 18: SYSREAD Q1 = ID270 NR1 IDX1\nL X+50 FMAX\n"
       "Q2 = Q1 - 21\nCALL LBL 1\nM30\nLBL 1\nQ2 = ABS Q2\nFN 11: IF +Q2 GT +0 GOTO LBL 9\n"
       "LBL 0\nLBL 9\nFN 14: ERROR = 1000",
       {"14", "11: condition set here", "10: Q2 set here", "6: Q2 set here", "4: Q1 set here",
        "2: tool set here", "3: Y, X set here"}},
      // A subprogram that was called before: what it has left.
      {"TOOL CALL 30 Z\nL X+20 Y+30 Z+50 FMAX\nCALL LBL 1\nL Z-5 FMAX\nM30\nLBL 1\nL X+50 FMAX\n"
       "Q1 = 2\nLBL 0",
       {"5", "8: X set here", "3: Y set here"}},
      {"TOOL CALL 30 Z\nQ1 = 1\nCALL LBL 1\nL X+20 Y+30 FMAX\nQ2 = 1 / Q1\nM30\nLBL 1\nQ1 = 0\n"
       "LBL 0",
       {"6", "9: Q1 set here"}},
      // A cycle that leaves the axes elsewhere: called, or probing.
      {"TOOL DEF 5 L+50 R+4\nTOOL CALL 5 Z S1000 F100\n" + drilling +
           "L X+20 Y+130 Z+60 FMAX M3\nL X+30 FMAX M99\n" + height + "20" + jump_behind,
       {"19", "16: condition set here", "15: Q1 set here", "3: tool set here",
        "14: Z, Y, X set here", "4: cycle set here"}},
      {"TOOL CALL 30 Z\nL X+20 Y+30 FMAX\nQL1 = 50\nQL3 = 3\n" + kFace + height + "20" +
           jump_behind,
       {"23", "20: condition set here", "19: Q1 set here", "2: tool set here",
        "6: Z, Y, X set here"}},
      // A datum of the preset table: what has written its row.
      {"TOOL CALL 30 Z\nL X+20 Y+30 Z+50 FMAX\nTCH PROBE 417 DATUM IN TS AXIS ~\n Q263=+20 ~\n "
       "Q264=+20 ~\n Q294=+0 ~\n Q320=+0 ~\n Q260=+50 ~\n Q305=+5 ~\n Q333=+3 ~\n Q303=+1\n"
       "CYCL DEF 247 DATUM SETTING ~\n Q339=+5\nL Z+53 FMAX\n" +
           height + "53" + jump_behind,
       {"20", "17: condition set here", "16: Q1 set here", "2: tool set here",
        "4: preset, Y, X set here", "15: Z set here", "13: datum set here"}},
      // An error that comes from no position.
      {"TOOL CALL 30 Z\nL X+20 Y+30 Z+50 FMAX\nCALL PGM GONE", {"4"}},
      {"TOOL CALL 30 Z\nL X+20 Y+30 Z+50 FMAX\nL X+10 F100 M999", {"4"}},
      {"TOOL CALL 30 Z\nQ1 = 0\nL X+20 Y+30 Z+50 FMAX\nQ2 = 1 / Q1", {"5", "3: Q1 set here"}},
      // Another program.
      {"TOOL CALL 30 Z\nQ9 = 900\nCALL PGM OTHER", {"2", "TNC:\\nc_prog\\main.h3: Q9 set here"}},
      // An error behind a call: the last block of the called program is no jump of this one.
      {jump + jump + jump + "CALL PGM QUIET\nFN 14: ERROR = 1000\nLBL 9", {"6"}},
  };
  for (const Case& each : cases) {
    CAPTURE(each.body);
    const Lines found = origins(each.body, each.is_inch);
    CAPTURE(fmt::format("{}", fmt::join(found, ", ")));
    CHECK(found == each.found);
  }
}

TEST_CASE(
    "a size far from its nominal, and a stop at a limit, name where the cycle has its values") {
  const auto hole = [](const std::string& nominal, const std::string& stops) {
    return "TOOL CALL 30 Z\nQL1 = " + nominal +
           "\nQL2 = 0.001\nCALL LBL 1\nM30\nLBL 1\nTCH PROBE 421 MEASURE HOLE ~\n Q273=+50 ~\n "
           "Q274=+40 ~\n Q262=+QL1 ~\n Q325=+0 ~\n Q247=+90 ~\n Q261=-5 ~\n Q320=+2 ~\n Q260=+20 "
           "~\n Q301=+0 ~\n Q275=+0 ~\n Q276=+0 ~\n Q279=+QL2 ~\n Q280=+QL2 ~\n Q281=+0 ~\n "
           "Q309=" +
           stops + " ~\n Q330=+0\nLBL 0";
  };
  CHECK(origins(hole("30", "+0"), false, true) == Lines{});
  CHECK(origins(hole("31", "+0"), false, true) == Lines{"8", "3: QL1 set here", "4: QL2 set here"});
  CHECK(origins(hole("30", "+1"), false, true) == Lines{"8", "3: QL1 set here", "4: QL2 set here"});
}

TEST_CASE("a finding of the check names what it contradicts") {
  Control control;
  control.program("TOOL CALL 30 Z\n" + kFace + "Q5 = Q164");
  const auto unset = control.diagnostics();
  REQUIRE(unset.size() == 1);
  CHECK(unset[0].range.begin.line == 16);
  REQUIRE(unset[0].notes.size() == 1);
  CHECK(unset[0].notes[0].range.begin.line == 3);
  control.program(
      "Q1 = +30\nQ2 = +20\nTCH PROBE 427 MEASURE COORDINATE ~\n Q263=+0 ~\n Q264=+0 ~\n "
      "Q261=+Q1 ~\n Q272=+3 ~\n Q267=-1 ~\n Q260=+Q2\nTOOL CALL 0 Z");
  auto found = control.diagnostics();
  REQUIRE(found.size() == 1);
  CHECK(found[0].range.begin.line == 3);
  REQUIRE(found[0].notes.size() == 2);
  CHECK(found[0].notes[0].range.begin.line == 2);
  CHECK(found[0].notes[1].message == "the cycle that reads it");
  CHECK(found[0].notes[1].range.begin.line == 4);
  const std::string ring = "TCH PROBE 462 CALIBRATION OF A TS IN A RING ~\n Q407=";
  control.program(ring + "+50 ~\n Q320=+0 ~\n Q423=+8 ~\n Q380=+0\nTOOL CALL 0 Z", "main.h", true);
  found = control.diagnostics();
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].notes.size() == 1);
  CHECK(found[0].notes[0].message == "the lengths are in INCH");
  CHECK(found[0].notes[0].range.begin.line == 1);
  control.program(ring + "+500 ~\n Q320=+0 ~\n Q423=+8 ~\n Q380=+0\nTOOL CALL 0 Z", "main.h", true);
  found = control.diagnostics();
  REQUIRE(found.size() == 1);
  CHECK(found[0].notes.empty());
}

}  // namespace
}  // namespace fitgauge::interpreter
