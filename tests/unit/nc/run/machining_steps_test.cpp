#include "workshop.hpp"

/// The steps of further machining cycles, worked out by hand from the control's manuals.
namespace fitgauge::interpreter {
namespace {

bool has(const Lines& moves, const std::string& line) {
  if (std::count(moves.begin(), moves.end(), line) == 1) return true;
  for (const std::string& move : moves) MESSAGE(move);
  return false;
}

TEST_CASE("3 mills its slot from the tool on, along the first side") {
  Workshop mill;
  const auto slot = [&](const std::string& first, const std::string& second) {
    return mill.path(
        "CYCL DEF 3.0 SLOT MILLING\nCYCL DEF 3.1 SET UP -2\nCYCL DEF 3.2 DEPTH -4\n"
        "CYCL DEF 3.3 PECKG -4 F100\nCYCL DEF 3.4 " +
        first + "\nCYCL DEF 3.5 " + second + "\nCYCL DEF 3.6 F300\nL Z+2 FMAX M99");
  };
  // 30 by 10 and a tool of radius 4: its centre goes 22 mm along the slot, 1 mm beside its middle.
  const Lines along_y = slot("Y+30", "X+10");
  CHECK(has(along_y, "ARC X+10 Y+10 Z-4 CC X+10 Y+11 Z-4 +90 F300"));
  CHECK(has(along_y, "ARC X+9 Y+31 Z-4 CC X+10 Y+31 Z-4 +90 F300"));
  const Lines backwards = slot("X-30", "Y+10");
  CHECK(has(backwards, "ARC X+10 Y+10 Z-4 CC X+9 Y+10 Z-4 +90 F300"));
  CHECK(has(backwards, "ARC X-11 Y+9 Z-4 CC X-11 Y+10 Z-4 +90 F300"));
}

TEST_CASE("4 mills its pocket around the tool") {
  Workshop mill;
  const Lines pocket = mill.path(
      "CYCL DEF 4.0 POCKET MILLING\nCYCL DEF 4.1 SET UP -2\nCYCL DEF 4.2 DEPTH -6\n"
      "CYCL DEF 4.3 PECKG -4 F80\nCYCL DEF 4.4 X+40\nCYCL DEF 4.5 Y+20\n"
      "CYCL DEF 4.6 F300 DR+ RADIUS 6\nL Z+2 FMAX M99");
  for (const std::string depth : {"Z-4", "Z-6"}) {
    CHECK(has(pocket, "L X+10 Y+10 " + depth + " F80"));
    CHECK(has(pocket, "L X+26 Y+14 " + depth + " F300"));
    CHECK(has(pocket, "ARC X+24 Y+16 " + depth + " CC X+24 Y+14 " + depth + " +90 F300"));
    CHECK(has(pocket, "L X-4 Y+16 " + depth + " F300"));
  }
}

TEST_CASE("17 taps at its pitch, 206 at the feed that is programmed") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 17.0 RIGID TAPPING\nCYCL DEF 17.1 SET UP -2\nCYCL DEF 17.2 DEPTH -10\n"
                  "CYCL DEF 17.3 PITCH +1.25\nL Z+2 FMAX") ==
        Lines{"L Z+2 FMAX", "L Z-10 F1250", "L Z+2 F1250"});
  CHECK(mill.hole("CYCL DEF 206 TAPPING Q200=2 Q201=-10 Q206=150 Q211=0.3 Q203=+5 Q204=20") ==
        Lines{"L Z+7 FMAX", "L Z-5 F150", "DWELL 0.3", "L Z+7 F150", "L Z+25 FMAX"});
}

TEST_CASE("225 goes down at its place, 240 to a depth or to a diameter") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 225 ENGRAVING QS500=\"A1\" Q513=10 Q207=300 Q201=-1 Q206=100 Q200=2 "
                  "Q203=+0 Q204=20") ==
        Lines{"L Z+2 FMAX", "L Z-1 F100", "L Z+2 FMAX", "L Z+20 FMAX"});
  const std::string centering = "CYCL DEF 240 CENTERING Q200=2 Q206=250 Q211=0.1 Q203=+0 Q204=20 ";
  CHECK(mill.hole(centering + "Q343=0 Q201=-2") ==
        Lines{"L Z+2 FMAX", "L Z-2 F250", "DWELL 0.1", "L Z+2 FMAX", "L Z+20 FMAX"});
  // A point of 90 degrees is as deep as half its diameter, one of 60 by the square root of 3 more.
  mill.setup.machine.tools.back().row.point_angle = 90;
  CHECK(mill.hole(centering + "Q343=1 Q344=-8")[1] == "L Z-4 F250");
  mill.setup.machine.tools.back().row.point_angle = 60;
  CHECK(mill.hole(centering + "Q343=1 Q344=-8")[1] == "L Z-6.9282 F250");
}

TEST_CASE("205 and 241 begin at the deepened starting point, Q200 above it at Q253") {
  Workshop mill;
  CHECK(mill.hole("CYCL DEF 241 SINGLE-LIP Q200=2 Q201=-80 Q206=150 Q211=0.2 Q203=+0 Q204=50 "
                  "Q379=7.5 Q253=750 Q208=1000") == Lines{"L Z+2 FMAX", "L Z-5.5000 F750",
                                                          "L Z-80 F150", "DWELL 0.2", "L Z+2 F1000",
                                                          "L Z+50 FMAX"});
  CHECK(mill.hole("CYCL DEF 205 PECKING Q200=2 Q201=-40 Q206=150 Q202=20 Q203=+0 Q204=0 Q258=0.5 "
                  "Q259=0.5 Q379=7.5 Q253=750") ==
        Lines{"L Z+2 FMAX", "L Z-5.5000 F750", "L Z-27.5000 F150", "L Z+2 FMAX", "L Z-27 FMAX",
              "L Z-40 F150", "L Z+2 FMAX"});
}

TEST_CASE("studs and faces name what cannot be milled") {
  Workshop mill;
  const std::string depth = " Q207=500 Q201=-5 Q202=5 Q206=150 Q200=2 Q203=+0 Q204=20 ";
  const auto error = [&](const std::string& cycle) {
    mill.path("CYCL DEF " + cycle + "\nCYCL CALL");
    return mill.last.messages.empty() ? 0 : mill.last.messages.back().number;
  };
  CHECK(error("257 STUD Q223=30 Q222=30 Q370=1" + depth) == 0);
  CHECK(error("257 STUD Q223=30 Q222=29.9999 Q370=1" + depth) == 1036);
  CHECK(error("256 STUD Q218=60 Q424=60 Q219=40 Q425=39 Q370=1" + depth) == 1098);
  CHECK(error("232 FACE Q227=0 Q386=0 Q218=10 Q219=10") == 0);  // the control does not run it
  CHECK(error("232 FACE Q227=0 Q386=1 Q218=10 Q219=10") == 1016);
  mill.setup.machine.tools.back().row.r = 0;
  CHECK(error("257 STUD Q223=30 Q222=40 Q370=1" + depth) == 1002);
  CHECK(error("232 FACE Q227=1 Q386=0 Q218=10 Q219=10") == 1002);
}

const std::string kThread = " Q335=20 Q239=+1.5 Q201=-6 Q253=750 Q200=2 Q203=+0 Q204=0 Q207=200 ";

/// The helices of a thread.
Lines turns(const Lines& moves) {
  Lines found;
  for (const std::string& line : moves) {
    if (line.starts_with("ARC") && line.find("180 F") == std::string::npos) found.push_back(line);
  }
  return found;
}

TEST_CASE("Q355 of 262: one turn at the depth, the whole depth, or steps") {
  Workshop mill;
  CHECK(turns(mill.path("CYCL DEF 262 THREAD Q355=0" + kThread + "\nCYCL CALL")) ==
        Lines{"ARC X+16 Y+10 Z-4.5000 CC X+10 Y+10 Z-4.5000 +360 F200"});
  CHECK(turns(mill.path("CYCL DEF 262 THREAD Q355=1" + kThread + "\nCYCL CALL")) ==
        Lines{"ARC X+16 Y+10 Z+0 CC X+10 Y+10 Z+0 +1440 F200"});
  CHECK(turns(mill.path("CYCL DEF 262 THREAD Q355=2" + kThread + "\nCYCL CALL")) ==
        Lines{"ARC X+16 Y+10 Z-4.5000 CC X+10 Y+10 Z-4.5000 +360 F200",
              "ARC X+16 Y+10 Z-1.5000 CC X+10 Y+10 Z-1.5000 +360 F200"});
  // Up-cut goes down into the hole.
  CHECK(turns(mill.path("CYCL DEF 262 THREAD Q355=1 Q351=-1" + kThread + "\nCYCL CALL")) ==
        Lines{"ARC X+16 Y+10 Z-6 CC X+10 Y+10 Z-6 -1440 F200"});
}

TEST_CASE("263 to 267 countersink or drill, and mill their thread") {
  Workshop mill;
  const Lines sunk = mill.path("CYCL DEF 263 THREAD Q356=-8 Q254=150" + kThread + "\nCYCL CALL");
  CHECK(has(sunk, "L X+10 Y+10 Z-8 F150"));
  CHECK(turns(sunk) == Lines{"ARC X+16 Y+10 Z-4.5000 CC X+10 Y+10 Z-4.5000 +360 F200"});

  // 264 drills Q356, not the depth of the thread.
  const Lines drilled =
      mill.path("CYCL DEF 264 THREAD Q356=-9 Q202=5 Q258=0.5 Q206=150" + kThread + "\nCYCL CALL");
  CHECK(has(drilled, "L X+10 Y+10 Z-5 F150"));
  CHECK(has(drilled, "L X+10 Y+10 Z-9 F150"));
  CHECK(turns(drilled) == Lines{"ARC X+16 Y+10 Z-4.5000 CC X+10 Y+10 Z-4.5000 +360 F200"});

  CHECK(turns(mill.path("CYCL DEF 265 THREAD" + kThread + "\nCYCL CALL")) ==
        Lines{"ARC X+16 Y+10 Z-6 CC X+10 Y+10 Z-6 -1440 F200"});

  // Outside the tool goes around the bolt: 10 + 4 mm from its axis.
  const Lines outside = mill.path("CYCL DEF 267 THREAD Q355=1" + kThread + "\nCYCL CALL");
  // Climb milling turns clockwise there: a right-hand thread goes down.
  CHECK(has(outside, "ARC X+24 Y+10 Z-6 CC X+10 Y+10 Z-6 -1440 F200"));
  CHECK(outside.back() == "L X+10 Y+10 Z+2 FMAX");
  const auto helix = [&](const std::string& hand) {
    return turns(mill.path("CYCL DEF 267 THREAD Q355=1 Q335=20 Q201=-6 Q253=750 Q200=2 Q203=+0 "
                           "Q204=0 Q207=200 " +
                           hand + "\nCYCL CALL"))
        .front();
  };
  CHECK(helix("Q239=+1.5 Q351=-1") == "ARC X+24 Y+10 Z+0 CC X+10 Y+10 Z+0 +1440 F200");
  CHECK(helix("Q239=-1.5 Q351=+1") == "ARC X+24 Y+10 Z+0 CC X+10 Y+10 Z+0 -1440 F200");
  CHECK(helix("Q239=-1.5 Q351=-1") == "ARC X+24 Y+10 Z-6 CC X+10 Y+10 Z-6 +1440 F200");
}

TEST_CASE("DR- of the old pockets turns clockwise") {
  Workshop mill;
  const std::string begin =
      "CYCL DEF 5.0 CIRCULAR POCKET\nCYCL DEF 5.1 SET UP -2\nCYCL DEF 5.2 "
      "DEPTH -3\nCYCL DEF 5.3 PECKG -3 F80\nCYCL DEF 5.4 RADIUS 15\n";
  CHECK(has(mill.path(begin + "CYCL DEF 5.5 F100 DR-\nL Z+2 FMAX M99"),
            "ARC X+21 Y+10 Z-3 CC X+10 Y+10 Z-3 -360 F100"));
  const Lines pocket = mill.path(
      "CYCL DEF 4.0 POCKET MILLING\nCYCL DEF 4.1 SET UP -2\nCYCL DEF 4.2 DEPTH -4\n"
      "CYCL DEF 4.3 PECKG -4 F80\nCYCL DEF 4.4 X+40\nCYCL DEF 4.5 Y+20\n"
      "CYCL DEF 4.6 F300 DR- RADIUS 6\nL Z+2 FMAX M99");
  CHECK(has(pocket, "ARC X+24 Y+4 Z-4 CC X+24 Y+6 Z-4 -90 F300"));
}

TEST_CASE("1 stops a fiftieth of the hole above what is drilled, from 0.6 to 7 mm") {
  Workshop mill;
  const auto hole = [&](const std::string& depth, const std::string& infeed) {
    return mill.hole("CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP -2\nCYCL DEF 1.2 DEPTH " + depth +
                     "\nCYCL DEF 1.3 PECKG " + infeed +
                     "\nCYCL DEF 1.4 DWELL 0\n"
                     "CYCL DEF 1.5 F100\nL Z+2 FMAX");
  };
  CHECK(has(hole("-30", "-20"), "L Z-19.4000 FMAX"));
  CHECK(has(hole("-60", "-40"), "L Z-38.8000 FMAX"));
  CHECK(has(hole("-400", "-300"), "L Z-293 FMAX"));
}

TEST_CASE("254: Q376 is the angle of the place on which the tool stands") {
  Workshop mill;
  // 90 degrees of a pitch circle of 80, the tool over its X+10 Y+10.
  const auto slot = [&](const std::string& place) {
    return mill.path(
        "CYCL DEF 254 SLOT Q219=10 Q375=80 Q376=90 Q248=90 Q207=300 Q206=100 Q201=-4 "
        "Q202=4 Q200=2 Q203=+0 Q204=0 Q367=" +
        place + "\nCYCL CALL");
  };
  // The tool always stands 40 mm above the centre, at X+10 Y-30; the slot lies around it.
  CHECK(has(slot("1"), "ARC X-31 Y-30 Z-4 CC X+10 Y-30 Z-4 +90 F300"));
  CHECK(has(slot("3"), "ARC X+10 Y+11 Z-4 CC X+10 Y-30 Z-4 +90 F300"));
  CHECK(has(slot("2"), "ARC X-18.9914 Y-1.0086 Z-4 CC X+10 Y-30 Z-4 +90 F300"));
}

}  // namespace
}  // namespace fitgauge::interpreter
