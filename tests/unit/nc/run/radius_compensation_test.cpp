#include <random>
#include <sstream>

#include "run_fixture.hpp"

/// RL and RR: centre paths worked out by hand, and random contours whose distance to the path is
/// measured point by point.
namespace fitgauge::interpreter {
namespace {

/// A control with a cutter 5 of the given radius.
class ContourMill : public Control {
 public:
  explicit ContourMill(double radius = 4) { add_cutter(radius); }

  /// The moves behind the first, at Z+0.
  Lines path(const std::string& body) {
    program("TOOL CALL 5 Z S1000 F500\nL X+0 Y+0 Z+0 FMAX\n" + body);
    last = run();
    Lines moves = traced_lines({"L ", "ARC "}, {" Z+0.0000", ".0000"});
    if (!moves.empty()) moves.erase(moves.begin());
    return moves;
  }

  RunResult last;
};

TEST_CASE("RL goes around outer corners on an arc of the tool's radius") {
  ContourMill mill;
  CHECK(mill.path("L X+10 Y+10 RL F100\nL Y+30\nL X+30\nL Y+10\nL X+10\nL X+0 Y+0 R0") ==
        Lines{"L X+6 Y+10 F100", "L X+6 Y+30 F100", "ARC X+10 Y+34 CC X+10 Y+30 -90 F100",
              "L X+30 Y+34 F100", "ARC X+34 Y+30 CC X+30 Y+30 -90 F100", "L X+34 Y+10 F100",
              "ARC X+30 Y+6 CC X+30 Y+10 -90 F100", "L X+10 Y+6 F100", "L X+0 Y+0 F100"});
  CHECK(outcome(mill.last) == "completed");
  CHECK(mill.last.messages.empty());
}

TEST_CASE("scaling scales the contour, not the tool") {
  ContourMill mill;
  // In the machine: a contour of 20 mm to 60 mm, the path 4 mm beside it; the moves show input.
  CHECK(mill.path("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2\nL X+10 Y+10 RR F100\nL Y+30\n"
                  "L X+30\nL X+30 Y+0 R0") ==
        Lines{"L X+12 Y+10 F100", "L X+12 Y+28 F100", "L X+30 Y+28 F100", "L X+30 Y+0 F100"});
  CHECK(mill.machine->state().nose.linear.x == 60);
  CHECK(mill.path("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2\nCYCL DEF 252 CIRCULAR POCKET "
                  "Q223=20 Q201=-1 Q202=1 Q207=100 Q206=100 Q200=1\nCYCL CALL")[2] ==
        "L X+8 Y+0 Z-1 F100");
  mill.path("CYCL DEF 26.0 SCALING\nCYCL DEF 26.1 X2 Y3 CCX+0 CCY+0\nL X+10 Y+10 RR F100\nL Y+30");
  CHECK(mill.last.messages.back().number == 1108);
}

TEST_CASE("RR meets inner corners where the offset lines cross") {
  ContourMill mill;
  CHECK(mill.path("L X+10 Y+10 RR F100\nL Y+30\nL X+30\nL Y+10\nL X+10\nL X+0 Y+0 R0") ==
        Lines{"L X+14 Y+10 F100", "L X+14 Y+26 F100", "L X+26 Y+26 F100", "L X+26 Y+14 F100",
              "L X+10 Y+14 F100", "L X+0 Y+0 F100"});
}

TEST_CASE("arcs keep their centre and change their radius by that of the tool") {
  ContourMill mill;
  CHECK(mill.path("CC X+40 Y+0\nL X+20 Y+0 RL F100\nC X+20 Y+0 DR+\nL X+40 Y+0 R0") ==
        Lines{"L X+24 Y+0 F100", "ARC X+24 Y+0 CC X+40 Y+0 +360 F100", "L X+40 Y+0 F100"});
  CHECK(mill.path("CC X+40 Y+0\nL X+20 Y+0 RR F100\nC X+60 Y+0 DR+\nL X+90 Y+0 R0")[1] ==
        "ARC X+64 Y+0 CC X+40 Y+0 +180 F100");
  // DR of TOOL CALL belongs to the radius.
  CHECK(mill.path("TOOL CALL 5 Z S1000 F500 DR+1\nL X+10 Y+10 RL F100\nL Y+30\nL X-9 R0")[1] ==
        "L X+5 Y+30 F100");
}

TEST_CASE("a move of the tool axis within a contour is made at its corner") {
  ContourMill mill;
  CHECK(mill.path("L X+10 Y+10 RL F100\nL Z-5\nL Y+30\nL Z+2\nL X+30\nL X+40 R0") ==
        Lines{"L X+6 Y+10 F100", "L X+6 Y+10 Z-5 F100", "L X+6 Y+30 Z-5 F100",
              "L X+6 Y+30 Z+2 F100", "ARC X+10 Y+34 Z+2 CC X+10 Y+30 Z+2 -90 F100",
              "L X+30 Y+34 Z+2 F100", "L X+40 Y+30 Z+2 F100"});
}

TEST_CASE("incremental words count from the programmed contour") {
  ContourMill mill;
  CHECK(mill.path("L X+10 Y+10 RL F100\nL IY+20\nL IX+20\nL IX+10 R0").back() ==
        "L X+40 Y+30 F100");
}

TEST_CASE("APPR and DEP begin and end beside the contour") {
  ContourMill mill;
  CHECK(mill.path("APPR LT X+10 Y+10 LEN5 RL F100\nL X+30\nDEP LT LEN6") ==
        Lines{"L X+5 Y+14 FMAX", "L X+10 Y+14 F100", "L X+30 Y+14 F100", "L X+36 Y+14 F100"});
  CHECK(mill.path("APPR LN X+10 Y+10 LEN5 RR F100\nL X+30\nDEP LN LEN6") ==
        Lines{"L X+10 Y+1 FMAX", "L X+10 Y+6 F100", "L X+30 Y+6 F100", "L X+30 Y+0 F100"});
  CHECK(mill.path("APPR CT X+10 Y+10 CCA90 R5 RL F100\nL X+30\nDEP CT CCA90 R5") ==
        Lines{"L X+5 Y+19 FMAX", "ARC X+10 Y+14 CC X+10 Y+19 +90 F100", "L X+30 Y+14 F100",
              "ARC X+35 Y+19 CC X+30 Y+19 +90 F100"});
  CHECK(mill.path("APPR CT X+10 Y+10 CCA90 R5 RR F100\nL X+30\nL X+50\nDEP LT LEN1").back() ==
        "L X+51 Y+6 F100");
}

TEST_CASE("RL and RR do not follow each other") {
  ContourMill mill;
  mill.path("L X+0 Y+0 RL F100\nL X+10 RR\nL Y+10");
  CHECK(outcome(mill.last).find("a block between RL and RR moves in the plane with R0") !=
        std::string::npos);
  mill.path("L X+0 Y+0 RL F100\nL X+10\nL X+20 R0\nL Y+10 RR\nL X+0\nL X-10 R0");
  CHECK(outcome(mill.last) == "completed");
}

TEST_CASE("what the tool does not fit into is an error with its place") {
  ContourMill mill;
  mill.path("L X+10 Y+10 RR F100\nL Y+30\nL X+13\nL Y+10\nL X+0 R0");
  CHECK(mill.last.messages.back().number == 1003);
  CHECK(outcome(mill.last).find("a tool of radius 4.0000 mm does not fit into the corner at") !=
        std::string::npos);
  mill.path("CC X+13 Y+0\nL X+10 Y+0 RL F100\nC X+10 Y+0 DR+\nL X+0 R0");
  CHECK(mill.last.messages.back().number == 1003);
  mill.path("CC X+20 Y+0\nL X+10 Y+0 F100\nC X+30 Y+0 DR+ RL\nL X+0 R0");
  CHECK(mill.last.messages.back().number == 1021);
  mill.path("CC X+0 Z+0\nL X+10 Z+0 RL F100\nC X-10 Z+0 DR+\nL X+0 R0");
  CHECK(outcome(mill.last).find("RL and RR work only in the working plane") != std::string::npos);
}

struct ContourPoint {
  double x = 0;
  double y = 0;
};

double to_segment(ContourPoint p, ContourPoint a, ContourPoint b) {
  const double length2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  double t = length2 == 0 ? 0 : ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length2;
  t = std::min(1.0, std::max(0.0, t));
  return std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y));
}

double to_polygon(ContourPoint p, const std::vector<ContourPoint>& polygon) {
  double least = 1e9;
  for (std::size_t i = 0; i + 1 < polygon.size(); ++i) {
    least = std::min(least, to_segment(p, polygon[i], polygon[i + 1]));
  }
  return least;
}

/// Points along a line of the trace that begins at `from`, which moves on to its end.
std::vector<ContourPoint> sample(const std::string& line, ContourPoint& from) {
  ContourPoint end = from;
  ContourPoint centre;
  std::istringstream words(line);
  double sweep = 0;
  ContourPoint* target = &end;
  for (std::string word; words >> word;) {
    if (word == "CC") target = &centre;
    if (word[0] == 'X') target->x = std::stod(word.substr(1));
    if (word[0] == 'Y') target->y = std::stod(word.substr(1));
    if ((word[0] == '+' || word[0] == '-')) sweep = std::stod(word);
  }
  std::vector<ContourPoint> points;
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    if (line.starts_with("ARC")) {
      const double angle = sweep * t * std::acos(-1.0) / 180;
      const ContourPoint arm{from.x - centre.x, from.y - centre.y};
      points.push_back({centre.x + arm.x * std::cos(angle) - arm.y * std::sin(angle),
                        centre.y + arm.x * std::sin(angle) + arm.y * std::cos(angle)});
    } else {
      points.push_back({from.x + (end.x - from.x) * t, from.y + (end.y - from.y) * t});
    }
  }
  from = end;
  return points;
}

/// The least and the largest distance of the path from a random star-shaped polygon, closed.
std::pair<double, double> distances(ContourMill& mill, std::mt19937& random, const char* side) {
  std::uniform_real_distribution<double> radius(45, 90);
  std::vector<ContourPoint> polygon;
  constexpr int kCorners = 12;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2 * std::acos(-1.0) * (i % kCorners) / kCorners;
    const double r = i == kCorners ? 0 : radius(random);
    polygon.push_back(
        {std::round(r * std::cos(angle) * 1e3) / 1e3, std::round(r * std::sin(angle) * 1e3) / 1e3});
  }
  polygon.back() = polygon.front();
  std::ostringstream body;
  body << "L X" << polygon[0].x << " Y" << polygon[0].y << " " << side << " F100\n";
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    body << "L X" << polygon[i].x << " Y" << polygon[i].y << "\n";
  }
  body << "L X0 Y0 R0";
  Lines moves = mill.path(body.str());
  REQUIRE(outcome(mill.last) == "completed");
  ContourPoint at;
  sample(moves.front(), at);
  double least = 1e9;
  double largest = 0;
  // The ends stand square to the contour, across its last corner: they are not looked at.
  for (std::size_t i = 2; i + 2 < moves.size(); ++i) {
    if (i == 2) sample(moves[1], at);
    for (const ContourPoint p : sample(moves[i], at)) {
      const double distance = to_polygon(p, polygon);
      least = std::min(least, distance);
      largest = std::max(largest, distance);
    }
  }
  return {least, largest};
}

TEST_CASE("the centre of the tool never comes nearer to a random contour than its radius") {
  std::mt19937 random(1);
  ContourMill mill;
  ContourMill other(4.1);
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    for (const char* side : {"RL", "RR"}) {
      const auto [least, largest] = distances(mill, random, side);
      CHECK(least == doctest::Approx(4).epsilon(1e-3));
      CHECK(largest < 4 / std::sin(15 * std::acos(-1.0) / 180));
      CHECK(distances(other, random, side).first > 4.05);  // another tool is another path
    }
  }
}

}  // namespace
}  // namespace fitgauge::interpreter
