#include <sstream>

#include "workshop.hpp"

/// Blocks that say how the tool stands: tool vectors and spatial angles. Which way the tool points
/// on a machine is written down here once more.
namespace fitgauge::interpreter {
namespace {

using machine::Axis;
using machine::Vec3;

double sine(double degrees) { return std::sin(degrees * std::acos(-1.0) / 180); }
double cosine(double degrees) { return std::cos(degrees * std::acos(-1.0) / 180); }

/// A trunnion A that carries a table C, or a fork head C that carries A: either turns the tool on
/// the workpiece by A around X, then by C around Z.
Vec3 tool_at(double a, double c) { return {sine(a) * sine(c), -sine(a) * cosine(c), cosine(a)}; }

std::string vector_words(const Vec3& v) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "TX%+.9f TY%+.9f TZ%+.9f", v.x, v.y, v.z);
  return text.data();
}

class FiveAxes : public Workshop {
 public:
  explicit FiveAxes(machine::AxisMount mount = machine::AxisMount::Table) {
    for (const Axis axis : {Axis::A, Axis::C}) {
      auto& added = setup.machine.axes[machine::index(axis)];
      added.emplace(machine::AxisSetup::of(axis));
      added->mount = mount;
      if (mount == machine::AxisMount::Head) added->centre = {0, 0, 40};
      added->min = -200;
      added->max = 200;
    }
  }

  /// A, B and C after that body, whose last block ends at X+1 Y+2 Z+3.
  Vec3 rotary_after(const std::string& body) {
    path(body);
    CAPTURE(body);
    REQUIRE(outcome(last) == "completed");
    const machine::Position end = machine->state().position();
    CHECK(norm(end.linear - Vec3{1, 2, 3}) < 1e-7);
    return machine->state().nose.rotary;
  }
};

bool is_near(const Vec3& a, const Vec3& b) { return norm(a - b) < 1e-6; }

TEST_CASE("LN stands the tool along its vector, the tip where it is programmed") {
  const std::string begin = "M128\nLN X+1 Y+2 Z+3 F1000 ";
  for (const auto mount : {machine::AxisMount::Table, machine::AxisMount::Head}) {
    FiveAxes mill(mount);
    CHECK(is_near(mill.rotary_after(begin + vector_words(tool_at(30, 40))), {30, 0, 40}));
    // Of (-25, 0, 150) and (25, 0, -30) the second is nearer to 0.
    CHECK(is_near(mill.rotary_after(begin + vector_words(tool_at(-25, 150))), {25, 0, -30}));
    // Upright: C stays.
    CHECK(is_near(mill.rotary_after("L C+70 FMAX\n" + begin + "TX+0 TY+0 TZ+1"), {0, 0, 70}));
  }
  // On from C 170 to 190 rather than back to -170.
  FiveAxes mill;
  CHECK(is_near(mill.rotary_after("L A+20 C+170 FMAX\n" + begin + vector_words(tool_at(20, 190))),
                {20, 0, 190}));
  // The limits: 210 is out of range, -150 is not.
  CHECK(is_near(mill.rotary_after("L A+20 C+190 FMAX\n" + begin + vector_words(tool_at(20, 210))),
                {-20, 0, 30}));
}

TEST_CASE("a vector counts in the tilted, rotated and mirrored system of the block") {
  FiveAxes mill;
  // The plane's X is the workpiece's Y: its vector (s, 0, c) points to (0, s, c).
  CHECK(is_near(mill.rotary_after("PLANE SPATIAL SPA+0 SPB+0 SPC+90 STAY\nM128\n"
                                  "LN X+1 Y+2 Z+3 F1000 " +
                                  vector_words({sine(20), 0, cosine(20)})),
                {-20, 0, 0}));
  CHECK(is_near(mill.rotary_after("TRANS ROTATION ROT+90\nM128\nLN X+1 Y+2 Z+3 F1000 " +
                                  vector_words({sine(20), 0, cosine(20)})),
                {-20, 0, 0}));
  CHECK(is_near(mill.rotary_after("TRANS MIRROR AXIS Y\nM128\nLN X+1 Y+2 Z+3 F1000 " +
                                  vector_words({0, -sine(20), cosine(20)})),
                {-20, 0, 0}));
}

TEST_CASE("AXIS SPAT: A, B and C are spatial angles of the tool") {
  const std::string begin = "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\nL X+1 Y+2 Z+3 F1000 ";
  FiveAxes mill;
  CHECK(is_near(mill.rotary_after(begin + "A+30 B+0 C+0"), {30, 0, 0}));
  CHECK(is_near(mill.rotary_after(begin + "A+30 B+0 C+40"), {30, 0, 40}));
  // Around Y: the tool points to +X.
  CHECK(is_near(mill.rotary_after("L A+5 C+5 FMAX\n" + begin + "A+0 B+25 C+0"), {25, 0, 90}));
  // Around X, then around the fixed Y: (sin b cos a, -sin a, cos b cos a).
  const Vec3 tool{sine(25) * cosine(10), -sine(10), cosine(25) * cosine(10)};
  const Vec3 rotary = mill.rotary_after(begin + "A+10 B+25 C+0");
  CHECK(norm(tool_at(rotary.x, rotary.z) - tool) < 1e-8);
  // What a block leaves out stays; increments add up.
  CHECK(is_near(mill.rotary_after(begin + "A+30 B+0 C+0\nL C+40 F1000"), {30, 0, 40}));
  CHECK(is_near(mill.rotary_after(begin + "A+30 B+0 C+10\nL IC+30 F1000"), {30, 0, 40}));
  // M128 and FUNCTION TCPM AXIS POS: positions of the axes again.
  CHECK(is_near(mill.rotary_after(begin + "A+0 B+25 C+0\nM128\nL A+5 C+6 F1000"), {5, 0, 6}));
  mill.path(begin + "A+30 C+0");
  CHECK(outcome(mill.last).find("B is missing") != std::string::npos);
}

Vec3 machine_rotary(FiveAxes& mill) { return mill.machine->state().nose.rotary; }

/// The ends of the moves: X, Y, Z, A and C.
std::vector<std::array<double, 5>> stops_of(const Lines& moves) {
  std::vector<std::array<double, 5>> stops;
  std::array<double, 5> at{};
  for (const std::string& line : moves) {
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      const auto axis = std::string("XYZAC").find(word[0]);
      if (word.size() > 1 && axis != std::string::npos) at[axis] = std::stod(word.substr(1));
    }
    stops.push_back(at);
  }
  return stops;
}

TEST_CASE("PATHCTRL VECTOR turns the tool evenly in the plane of its first and last direction") {
  for (const auto mount : {machine::AxisMount::Table, machine::AxisMount::Head}) {
    FiveAxes mill(mount);
    const auto along = [&](const std::string& control) {
      const Lines moves =
          mill.path("M128\nL X+0 Y+0 Z+0 A+30 C+0 FMAX\nFUNCTION TCPM F TCP AXIS POS PATHCTRL " +
                    control + "\nL X+10 Y+5 A+40 C+80 F1000");
      REQUIRE(outcome(mill.last) == "completed");
      return stops_of(moves);
    };
    CHECK(along("AXIS").size() == 2);
    const auto stops = along("VECTOR");
    const Vec3 first = tool_at(30, 0);
    const Vec3 last = tool_at(40, 80);
    const Vec3 across = machine::unit(cross(first, last));
    const double whole = std::acos(dot(first, last));
    REQUIRE(stops.size() > 20);
    CHECK(is_near({stops.back()[3], stops.back()[4], 0}, {40, 80, 0}));
    for (std::size_t i = 1; i < stops.size(); ++i) {  // after the first block's end
      const Vec3 tool = tool_at(stops[i][3], stops[i][4]);
      CHECK(std::abs(dot(tool, across)) < 1e-5);
      CHECK(std::abs(std::acos(dot(first, tool)) / whole - stops[i][0] / 10) < 1e-4);
      CHECK(std::abs(stops[i][1] - stops[i][0] / 2) < 1e-3);
    }
  }
  // Over the pole; a tool that keeps its direction; and the same line with RL.
  FiveAxes mill;
  const std::string begin =
      "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR\nL X+0 Y+0 Z+0 A+30 C+0 "
      "FMAX\n";
  CHECK(is_near(mill.rotary_after(begin + "L X+1 Y+2 Z+3 C+180 F1000"), {30, 0, 180}));
  CHECK(is_near(mill.rotary_after(begin + "L A+0 FMAX\nL X+1 Y+2 Z+3 C+180 F1000"), {0, 0, 180}));
  const auto beside = stops_of(mill.path(begin + "L X+0 Y+0 A+0 RL FMAX\nL X+50 A+20 C+30 F1000\n"
                                                 "L X+50 Y+50 R0 FMAX"));
  CHECK(outcome(mill.last) == "completed");
  CHECK(beside[beside.size() / 2][1] == 4);  // the radius of the cutter
}

TEST_CASE("LN moves a larger tool along the normal, and stands it square to the surface") {
  Workshop mill;
  CHECK(mill.path("TOOL CALL 5 Z S1000 DR+0.5\nLN X+1 Y+2 Z+3 NX+3 NY+0 NZ+4 F1000\n"
                  "LN IX+10 NX+0 NY+0 NZ+1\nL Y+7\nL Z+8") ==
        Lines{"L X+1.3000 Y+2 Z+3.4000 F1000", "L X+11 Y+2 Z+3.5000 F1000", "L X+11 Y+7 Z+3 F1000",
              "L X+11 Y+7 Z+8 F1000"});
  CHECK(mill.last.messages.empty());
  FiveAxes five;
  CHECK(is_near(five.rotary_after("M128\nLN X+1 Y+2 Z+3 NX+0 NY-0.5 NZ+0.8660254038 F1000"),
                {30, 0, 0}));
}

/// The examples that the manual of the iTNC 530 tabulates for a table C on a tilting table A.
TEST_CASE("PLANE takes the solution of the manual's examples") {
  struct Example {
    double min, max;
    std::string start, side;
    double a, c;
  };
  for (const auto& [min, max, start, side, a, c] : {Example{-200, 200, "+0", "", 45, 90},
                                                    {-200, 200, "+0", " SEQ+", 45, 90},
                                                    {-200, 200, "+0", " SEQ-", -45, -90},
                                                    {-200, 200, "-105", "", -45, -90},
                                                    {-200, 200, "-105", " SEQ+", 45, 90},
                                                    {-200, 200, "-105", " SEQ-", -45, -90},
                                                    {-90, 10, "+0", "", -45, -90},
                                                    {-200, 200, "-135", " SEQ+", 45, 90},
                                                    {-100, 0, "+0", " SYM-", 0, 0},
                                                    {-100, 0, "+0", " SYM+", -45, -90}}) {
    CAPTURE(start + side);
    FiveAxes mill;
    mill.setup.machine.axes[machine::index(Axis::A)]->min = min;
    mill.setup.machine.axes[machine::index(Axis::A)]->max = max;
    mill.path("L A+0 C" + start + " FMAX\nPLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN FMAX" + side);
    if (a == 0) {
      CHECK(mill.last.messages.back().number == 1013);
      continue;
    }
    CHECK(is_near(machine_rotary(mill), {a, 0, c}));
  }
  FiveAxes mill;
  mill.setup.machine.axes[machine::index(Axis::A)]->max = 10;
  mill.path("PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN FMAX SEQ+");
  CHECK(mill.last.messages.back().number == 1013);
}

TEST_CASE("PLANE RESET brings all rotary axes home where it turns them") {
  FiveAxes mill;
  const std::string tilted = "PLANE SPATIAL SPA+20 SPB+0 SPC+30 TURN FMAX\nL X+1 Y+2 Z+3 FMAX\n";
  mill.path(tilted + "PLANE RESET STAY\nQ1 = Q122");
  CHECK(norm(machine_rotary(mill)) > 30);
  CHECK(value(mill.last, "Q1") == "0");
  mill.path(tilted + "PLANE RESET TURN FMAX");
  CHECK(is_near(machine_rotary(mill), {}));
}

TEST_CASE("PLANE MOVE keeps the tip where it is on the workpiece, TURN where the axes are") {
  // X, Y, Z of the plane A+20, C+30 in the workpiece.
  const auto in_workpiece = [](const Vec3& p) {
    const Vec3 tilted{p.x, p.y * cosine(20) - p.z * sine(20), p.y * sine(20) + p.z * cosine(20)};
    return Vec3{tilted.x * cosine(30) - tilted.y * sine(30),
                tilted.x * sine(30) + tilted.y * cosine(30), tilted.z};
  };
  for (const auto mount : {machine::AxisMount::Table, machine::AxisMount::Head}) {
    FiveAxes mill(mount);
    const std::string begin = "L X+50 Y+40 Z+30 FMAX\nPLANE SPATIAL SPA+20 SPB+0 SPC+30 ";
    const auto position = [&] { return mill.machine->state().position().linear; };
    mill.path(begin + "MOVE DIST0 FMAX");
    REQUIRE(outcome(mill.last) == "completed");
    CHECK(norm(in_workpiece(position()) - Vec3{50, 40, 30}) < 1e-7);
    // DIST20: the point 20 mm before the tip keeps its place, the tip swings around it.
    mill.path(begin + "MOVE DIST20 FMAX");
    CHECK(norm(in_workpiece(position() - Vec3{0, 0, 20}) - Vec3{50, 40, 10}) < 1e-7);
    // MB retracts along the tool before.
    mill.path(begin + "MOVE DIST0 MB15 FMAX");
    CHECK(norm(in_workpiece(position()) - Vec3{50, 40, 45}) < 1e-7);
    mill.path(begin + "TURN MB MAX FMAX");
    CHECK(mill.machine->state().nose.linear.z == mill.setup.machine.axes[2]->max);
    mill.path(begin + "TURN FMAX");
    CHECK(norm(mill.machine->state().nose.linear - Vec3{50, 40, 130}) < 1e-7);
    mill.path(begin + "TURN FMAX\nL X+1 Y+2 Z+3 FMAX\nPLANE RESET MOVE DIST0 FMAX");
    CHECK(is_near(machine_rotary(mill), {}));
    CHECK(norm(position() - in_workpiece({1, 2, 3})) < 1e-7);
  }
}

TEST_CASE("what the rotary axes do not reach, and vectors that turn nothing, are said") {
  FiveAxes mill;
  mill.path("M128\nLN X+1 Y+2 Z+3 TX+0 TY+0 TZ+0 F1000");
  CHECK(outcome(mill.last).find("has no length") != std::string::npos);
  mill.path("LN X+1 Y+2 Z+3 TX+0.1 TY+0 TZ+0.995 F1000");
  REQUIRE(mill.last.messages.size() == 1);
  CHECK(mill.last.messages[0].text.find("M128 or FUNCTION TCPM only") != std::string::npos);
  Workshop three_axes;
  three_axes.path("M128\nLN X+1 Y+2 Z+3 TX+0.1 TY+0 TZ+0.995 F1000");
  CHECK(three_axes.last.messages.back().number == 1013);
}

}  // namespace
}  // namespace fitgauge::interpreter
