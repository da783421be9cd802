#include "nc/run/cutter_path.hpp"
#include "workshop.hpp"

/// The run refuses contradictions, and the check names them.
namespace fitgauge::interpreter {
namespace {

/// How a body ends that follows `TOOL CALL` and a move to X+10 Y+10 Z+50.
std::string ended(const std::string& body) {
  Workshop control;
  control.path(body);
  return outcome(control.last);
}

bool fails(const std::string& body, std::string_view text) {
  const std::string end = ended(body);
  INFO(end);
  CHECK(end.starts_with("failed"));
  return end.find(text) != std::string::npos;
}

/// The findings of the check that have this text, as `warning 3`.
std::vector<std::string> findings(std::string_view body, std::string_view text) {
  Control control;
  control.program(body);
  std::vector<std::string> found;
  for (const auto& each : control.diagnostics()) {
    if (each.message.find(text) == std::string::npos) continue;
    found.push_back(std::string(word(each.severity)) + " " + std::to_string(each.range.begin.line));
  }
  return found;
}

using Found = std::vector<std::string>;

/// How many arcs were run; each must end where its sweep turns its start.
std::size_t arcs_that_close(const Workshop& control) {
  std::size_t arcs = 0;
  for (const machine::TracedMove& move : control.traced) {
    if (!move.arc) continue;
    ++arcs;
    const machine::Vec3 from = move.start.linear - move.arc->centre;
    const Vec2 end = turned({from.x, from.y}, move.arc->sweep_deg);
    CHECK(move.end.linear.x - move.arc->centre.x == doctest::Approx(end.x).epsilon(1e-9));
    CHECK(move.end.linear.y - move.arc->centre.y == doctest::Approx(end.y).epsilon(1e-9));
  }
  return arcs;
}

TEST_CASE("IPA and DR turn the same way, and the end is the start turned by the sweep") {
  const std::string start = "L X+9 Y+0 Z+5 R0 FMAX M3\nCC X+0 Y+0\n";
  for (const char* angle : {"-60", "+60", "-400", "+400", "+360"}) {
    const std::string by = angle;
    const std::string with = by.front() == '+' ? "DR+" : "DR-";
    const std::string against = by.front() == '+' ? "DR-" : "DR+";
    CAPTURE(by);
    // Written as parameters, so that the check does not refuse the program before it runs.
    CHECK(fails("Q1 = " + by + "\n" + start + "CP IPA+Q1 " + against + " F100",
                "line 7: Incorrect sign: IPA"));
    CHECK(findings(start + "CP IPA" + by + " " + against + " F100", "IPA") == Found{"error 4"});
    CHECK(findings(start + "CP IPA" + by + " " + with + " F100", "IPA").empty());

    Workshop control;
    control.path("Q1 = " + by + "\n" + start + "CP IPA+Q1 " + with + " F100");
    REQUIRE(outcome(control.last) == "completed");
    CHECK(arcs_that_close(control) == 1);
    CHECK(control.traced.back().arc->sweep_deg == doctest::Approx(std::stod(by)));
  }
  Workshop control;
  control.path(start +
               "C X-9 Y+0 DR- F100\nC DR+\nCP PA+10 DR-\nCP IPA-700 IZ-1 DR-\nCR X+0 Y+0 R+30 "
               "DR+\nL X+20\nCT X+30 Y+10\nL Y+40\nRND R3\nL X+0\nCTP PR+10 PA+45");
  REQUIRE(outcome(control.last) == "completed");
  CHECK(arcs_that_close(control) == 8);
}

TEST_CASE("where the axes of the plane are scaled differently there are no arcs") {
  const std::string scaled =
      "L X+9 Y+0 Z+5 R0 FMAX M3\nCYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X2 Y1 CCX+0 "
      "CCY+0\n";
  const auto cycle = [&](const std::string& numbers, const std::string& head) {
    return scaled + head + numbers + "\nL X+20 Y+20 R0 FMAX M99";
  };
  for (const std::string& body :
       {scaled + "CC X+0 Y+0\nCP IPA+60 DR+ F100", scaled + "CR X+0 Y+9 R+10 DR+ F100",
        scaled + "L X+20 Y+0 F100\nRND R3\nL Y+20", scaled + "L X+20 Y+0 F100\nCT X+30 Y+10",
        cycle(" Q215=0 Q218=40 Q219=30 Q220=0 Q207=500 Q201=-5 Q202=5 Q206=100", "CYCL DEF 251"),
        cycle(" Q215=0 Q223=30 Q207=500 Q201=-5 Q202=5 Q206=100", "CYCL DEF 252"),
        cycle(" Q223=30 Q222=40 Q207=500 Q201=-5 Q202=5 Q206=100", "CYCL DEF 257"),
        cycle(" Q335=20 Q201=-5 Q206=100 Q334=1", "CYCL DEF 208"),
        cycle(" Q389=2 Q225=0 Q226=0 Q227=0 Q386=-1 Q218=40 Q219=30 Q202=1 Q207=500",
              "CYCL DEF 232")}) {
    CAPTURE(body);
    CHECK(fails(body, "Scaling factors not equal"));
  }
  // Lines, holes, and arcs in a plane that is scaled evenly.
  CHECK(ended(scaled + "L X+20 Y+0 F100\nCHF 2\nL Y+20") == "completed");
  CHECK(ended(cycle(" Q201=-5 Q206=100 Q202=5", "CYCL DEF 200 DRILLING")) == "completed");
  CHECK(ended("CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X2 Y2 Z1 CCX+0 CCY+0\nCC X+0 "
              "Y+0\nCP IPA+60 DR+ F100") == "completed");
}

TEST_CASE("values of a machining cycle that contradict each other end the run and are found") {
  struct Case {
    std::string cycle;
    std::string values;
    std::string message;
  };
  const std::string pocket = " Q207=500 Q201=-5 Q202=5 Q206=100";
  const Case cases[] = {
      {"205 ", "Q201=-80 Q202=5 Q206=100 Q379=200", "Q379 = 200"},
      {"205 ", "Q201=-80 Q202=5 Q206=100 Q379=80", "Q379 = 80"},
      {"241 ", "Q201=-80 Q206=100 Q379=90", "Q379 = 90"},
      {"256 ", "Q218=60 Q424=59 Q219=40 Q425=40" + pocket, "Q424 = 59"},
      {"256 ", "Q218=60 Q424=60 Q219=40 Q425=39" + pocket, "Q425 = 39"},
      {"257 ", "Q223=40 Q222=39" + pocket, "Q222 = 39"},
      {"253 ", "Q218=20 Q219=21" + pocket, "Q218 = 20"},
      {"232 ", "Q389=2 Q225=0 Q226=0 Q227=0 Q386=1 Q218=40 Q219=30 Q202=1 Q207=500", "Q386 = 1"},
      {"200 ", "Q201=0 Q206=100 Q202=5", "Q201 = 0"},
      {"252 ", "Q223=30 Q207=500 Q201=0 Q202=5 Q206=100", "Q201 = 0"},
      {"252 ", "Q223=30 Q207=0 Q201=-5 Q202=5 Q206=100", "Q207 = 0"},
      {"200 ", "Q201=-5 Q206=0 Q202=5", "Q206 = 0"},
      {"262 ", "Q335=20 Q239=0 Q201=-5 Q207=500", "Q239 = 0"},
      {"208 ", "Q335=20 Q334=0 Q201=-5 Q206=100", "Q334 = 0"},
      {"251 ", "Q218=40 Q219=30 Q220=15.1" + pocket, "Q220 = 15.1"},
      {"251 ", "Q218=40 Q219=30 Q369=5" + pocket, "Q369 = 5"},
      {"254 ", "Q219=20 Q375=80 Q248=0" + pocket, "Q248 = 0"},
      {"200 ", "Q201=5 Q206=100 Q202=5", "Q201 = 5 must have a minus"},
      {"207 ", "Q201=5 Q239=1", "Q201 = 5 must have"},
      {"208 ", "Q335=20 Q334=1 Q201=5 Q206=100", "Q201 = 5 must have"},
      {"240 ", "Q343=0 Q201=5 Q206=100", "Q201 = 5 must have"},
      {"256 ", "Q218=60 Q424=60 Q219=40 Q425=40 Q207=500 Q201=5 Q206=100", "Q201 = 5 must have"},
      {"263 ", "Q335=20 Q239=1 Q201=-5 Q356=8 Q207=500", "Q356 = 8 must have"},
      {"264 ", "Q335=20 Q239=1 Q201=-5 Q356=8 Q206=100 Q207=500", "Q356 = 8 must have"},
  };
  for (const auto& [cycle, values, message] : cases) {
    CAPTURE(cycle);
    CAPTURE(message);
    const std::string body = "CYCL DEF " + cycle + values + "\nL X+20 Y+20 R0 FMAX M99";
    CHECK(findings(body, message) == Found{"warning 2"});
    CHECK(fails("L Z+50 R0 FMAX M3\n" + body, message));
  }
  const std::string deepened = "CYCL DEF 205 Q201=-80 Q202=5 Q206=100 Q379=79";
  CHECK(findings(deepened, "Q379").empty());
  CHECK(ended(deepened + "\nL X+20 Y+20 R0 FMAX M3 M99") == "completed");
  // The data of contours at their own block, cycles in sub-lines at their call.
  const std::string minus = "must have a minus";
  CHECK(fails("CYCL DEF 20 CONTOUR DATA Q1=+20",
              "line 4: Enter depth as negative: Q1 = 20 " + minus));
  for (const std::string cycle : {"1", "2", "4", "17"}) {
    CAPTURE(cycle);
    CHECK(fails("CYCL DEF " + cycle + ".0\nCYCL DEF " + cycle + ".1 2\nCYCL DEF " + cycle +
                    ".2 +20\nCYCL CALL",
                "line 7: Enter depth as negative: the depth 20 " + minus));
  }
  // A diameter instead of the depth (240), a surface that is already milled (232).
  for (const std::string depth : {"0", "5"}) {
    const std::string centre = "CYCL DEF 240 Q343=1 Q201=" + depth + " Q344=-5 Q206=100";
    CHECK(findings(centre, "Q201").empty());
  }
  CHECK(findings("CYCL DEF 232 Q227=0 Q386=0 Q218=40 Q219=30 Q207=500", "Q386").empty());
}

TEST_CASE("a corner radius beyond half of the shorter side leaves a note, or is an error") {
  const std::string values = " Q207=500 Q201=-5 Q202=5 Q206=100\nL X+100 Y+100 R0 FMAX M3 M99";
  const auto notes = [](const std::string& body) {
    Workshop control;
    control.path(body);
    return std::ranges::count_if(control.last.messages, [](const RunMessage& message) {
      return message.text.find("Q220") != std::string::npos;
    });
  };
  CHECK(notes("CYCL DEF 256 Q218=60 Q424=62 Q219=40 Q425=42 Q220=100" + values) == 1);
  CHECK(notes("CYCL DEF 251 Q218=60 Q219=40 Q220=50" + values) == 1);
  CHECK(notes("CYCL DEF 251 Q218=60 Q219=40 Q220=20" + values) == 0);
}

TEST_CASE("a parameter of a cycle has a number or a text, not both") {
  const std::string position =
      "TCH PROBE 1400 Q1100=+30 Q1101=+40 Q1102=0 QS1102=\"0+0.1\" Q372=-3";
  CHECK(findings(position, "this parameter is repeated in the cycle") == Found{"error 2"});
}

TEST_CASE("M104 is of the control: it leaves a note") {
  Workshop control;
  control.path("M104");
  REQUIRE(outcome(control.last) == "completed");
  CHECK(control.last.messages.back().text.starts_with("M104: "));
}

TEST_CASE("a program that probes without a TOOL CALL gets one note") {
  const std::string probe = "TCH PROBE 1400 Q1100=+30 Q1101=+40 Q1102=0 Q372=-3\n";
  CHECK(findings(probe + probe, "no TOOL CALL") == Found{"note 2"});
  CHECK(findings(probe + "TOOL CALL 30 Z", "no TOOL CALL").empty());
  CHECK(findings("CALL PGM tool.h\n" + probe, "no TOOL CALL").empty());
  CHECK(findings("Q1 = 5", "no TOOL CALL").empty());
}

TEST_CASE("a polar position needs a radius and an angle since its pole") {
  const std::string start = "L X+9 Y+0 Z+5 R0 FMAX\n";
  for (const char* block : {"LP IPA+60 F100", "LP PA+90 F100", "CTP PA+90 F100"}) {
    CAPTURE(block);
    CHECK(fails(start + "L X+9.5 F100\nCC X+0 Y+0\n" + block, "the polar radius PR is missing"));
  }
  CHECK(fails(start + "CC X+0 Y+0\nLP PR+9 F100", "the polar angle PA is missing"));
  CHECK(fails(start + "CC X+0 Y+0\nLP PR+9 PA+5 F100\nCC X+1 Y+0\nLP PA+10", "PR is missing"));

  Workshop control;
  // From 5 degrees on a radius of 9: 14 mm from the pole at 25 degrees.
  CHECK(control.path(start + "CC X+0 Y+0\nLP PR+9 PA+5 F100\nCC X+0 Y+0\nLP IPR+5 IPA+20").back() ==
        "L X+12.6883 Y+5.9167 Z+5 F100");
  // After a Cartesian block the angle and the radius count from the position: 10 at 90 degrees.
  CHECK(control.path(start + "CC X+0 Y+0\nLP PR+9 PA+5 F100\nL X+0 Y+10\nLP IPR+2 IPA-90").back() ==
        "L X+12 Y+0 Z+5 F100");
  CHECK(control.path(start + "CC X+0 Y+0\nLP PR+9 PA+0 F100\nLP IPA+60\nLP PA+180").back() ==
        "L X-9 Y+0 Z+5 F100");
}

}  // namespace
}  // namespace fitgauge::interpreter
