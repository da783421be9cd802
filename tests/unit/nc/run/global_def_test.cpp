#include "run_fixture.hpp"

/// GLOBAL DEF and PREDEF (decision 23).
namespace fitgauge::interpreter {
namespace {

const std::string kPoint =
    "TCH PROBE 427 MEASURE COORDINATE ~\n Q263=+5 ~\n Q264=+5 ~\n Q261=+0 ~\n Q320=PREDEF ~\n"
    " Q272=+3 ~\n Q267=-1 ~\n Q260=PREDEF ~\n Q281=+0\n";

/// The tip's highest and lowest Z of the touch: clearance height, and SET_UP + Q320 over the part.
std::pair<double, double> heights(Control& control) {
  std::pair<double, double> found{-1000, 1000};
  for (const auto& line : control.traced) {
    if (line.kind != machine::MoveKind::Probe) continue;
    found.second = line.start.linear.z;
  }
  found.first = control.machine->position().linear.z;
  return found;
}

}  // namespace

TEST_CASE("PREDEF takes the values of the last GLOBAL DEF") {
  Control control;
  control.setup.features = {machine::Plane{{0, 0, 0}, {0, 0, 1}}};
  const std::string first = "GLOBAL DEF 120 PROBING ~\n Q320=+3 ~\n Q260=+40 ~\n Q301=+1\n";
  auto result = control.run("TOOL CALL 30 Z\n" + first + kPoint);
  REQUIRE(outcome(result) == "completed");
  CHECK(heights(control) == std::pair{40.0, 5.0});
  result = control.run("TOOL CALL 30 Z\n" + first +
                       "GLOBAL DEF 120 PROBING ~\n Q320=+6 ~\n Q260=+70 ~\n Q301=+0\n" + kPoint);
  REQUIRE(outcome(result) == "completed");
  CHECK(heights(control) == std::pair{70.0, 8.0});
}

TEST_CASE("an INCH program's GLOBAL DEF is in inch") {
  Control control;
  control.setup.features = {machine::Plane{{0, 0, 0}, {0, 0, 1}}};
  control.program(
      "TOOL CALL 30 Z\nGLOBAL DEF 120 PROBING ~\n Q320=+0.1 ~\n Q260=+2 ~\n Q301=+1\n" + kPoint,
      "main.h", true);
  REQUIRE(outcome(control.run()) == "completed");
  CHECK(heights(control).first == doctest::Approx(50.8));
  CHECK(heights(control).second == doctest::Approx(2 + 2.54));
}

TEST_CASE("drilling cycles take PREDEF, too") {
  Control control;
  const std::string drill =
      "CYCL DEF 200 DRILLING ~\n Q200=PREDEF ~\n Q201=-10 ~\n Q206=+150 ~\n Q202=+5 ~\n"
      " Q210=PREDEF ~\n Q203=+0 ~\n Q204=PREDEF ~\n Q211=PREDEF\n";
  const auto result = control.run(
      "TOOL CALL 30 Z S100\nGLOBAL DEF 100 GENERAL ~\n Q200=+2 ~\n Q204=+33 ~\n Q253=+750 ~\n"
      " Q208=+999\nGLOBAL DEF 105 DRILLING ~\n Q256=+0.2 ~\n Q210=+0 ~\n Q211=+0\n" +
      drill + "CYCL CALL M3");
  REQUIRE(outcome(result) == "completed");
  CHECK(control.machine->position().linear.z == 33);
}

TEST_CASE("PREDEF without its GLOBAL DEF is an error that names both") {
  Control control;
  control.setup.features = {machine::Plane{{0, 0, 0}, {0, 0, 1}}};
  CHECK(outcome(control.run("TOOL CALL 30 Z\n" + kPoint)) ==
        "failed line 3: CYCL incomplete: Q320 is PREDEF, but GLOBAL DEF 120 PROBING is missing "
        "before "
        "it");
}

TEST_CASE("what GLOBAL DEF cannot say is found before the start") {
  Control control;
  const auto first_finding = [&](std::string_view body) { return control.first_finding(body); };
  CHECK(first_finding("CYCL DEF 200 X ~\n Q201=PREDEF") ==
        "Q201 takes no PREDEF: no GLOBAL DEF has a value for it");
  CHECK(first_finding("GLOBAL DEF 120 PROBING ~\n Q320=PREDEF ~\n Q260=+40 ~\n Q301=+1") ==
        "Q320 takes no PREDEF: GLOBAL DEF gives the value");
  CHECK(first_finding("GLOBAL DEF 120 PROBING ~\n Q320=+1 ~\n Q260=+40").find("Q301") !=
        std::string::npos);
  CHECK(first_finding("GLOBAL DEF 120 PROBING ~\n Q320=+1 ~\n Q260=+40 ~\n Q301=+1 ~\n Q1=+1") ==
        "cycle 120 has no parameter Q1");
  CHECK(first_finding("GLOBAL DEF 120 PROBING ~\n Q320=-1 ~\n Q260=+40 ~\n Q301=+1").find("Q320") !=
        std::string::npos);
  CHECK(first_finding("GLOBAL DEF 121 X ~\n Q320=+1").find("GLOBAL DEF 121 is not available") !=
        std::string::npos);
}

}  // namespace fitgauge::interpreter
