#include <algorithm>

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
  CHECK(has(outside, "ARC X+24 Y+10 Z+0 CC X+10 Y+10 Z+0 +1440 F200"));
  CHECK(outside.back() == "L X+10 Y+10 Z+2 FMAX");
}

TEST_CASE("21, 23 and 24 go to the first point of each contour") {
  Workshop mill;
  const auto cycle = [&](const std::string& called) {
    return mill.path(
        "CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\n"
        "CYCL DEF 20 CONTOUR DATA Q1=-10 Q5=+1 Q6=2 Q7=+50\nCYCL DEF " +
        called + "\nCYCL CALL\nL M2\nLBL 1\nL X+20 Y+30 RL\nL X+40\nLBL 0");
  };
  const std::string above = "L X+20 Y+30 Z+3 FMAX";
  CHECK(cycle("21 PILOT DRILLING Q10=-6 Q11=100") ==
        Lines{"L X+20 Y+30 Z+50 FMAX", above, "L X+20 Y+30 Z-5 F100", "L X+20 Y+30 Z-9 F100",
              "L X+20 Y+30 Z+50 FMAX"});
  CHECK(cycle("23 FLOOR FINISHING Q11=100 Q12=350") ==
        Lines{"L X+20 Y+30 Z+50 FMAX", above, "L X+20 Y+30 Z-9 F100", "L X+20 Y+30 Z+50 FMAX"});
  CHECK(cycle("24 SIDE FINISHING Q9=+1 Q10=-5 Q11=100 Q12=350") ==
        Lines{"L X+20 Y+30 Z+50 FMAX", above, "L X+20 Y+30 Z-4 F100", "L X+20 Y+30 Z-9 F100",
              "L X+20 Y+30 Z+50 FMAX"});
}

}  // namespace
}  // namespace fitgauge::interpreter
