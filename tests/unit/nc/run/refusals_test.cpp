#include <algorithm>

#include "nc/run/plane_geometry.hpp"
#include "workshop.hpp"

/// What contradicts itself is refused by the run, and named by the check.
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
                "line 6: Incorrect sign: IPA"));
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

}  // namespace
}  // namespace fitgauge::interpreter
