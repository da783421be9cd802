#include <sstream>

#include "workshop.hpp"

/// SL cycles 21 to 24: paths worked out by hand, and a pocket with an island whose clearing is
/// measured point by point. The cutter has a radius of 4 mm.
namespace fitgauge::interpreter {
namespace {

const std::string kData =
    "CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\n"
    "CYCL DEF 20 CONTOUR DATA Q1=-10 Q2=1 Q5=+1 Q6=2 Q7=+50";
/// A pocket of 40 mm by 20 mm with its corner in X+20 Y+30.
const std::string kPocket = "\nL X+20 Y+30 RL\nL X+60\nL Y+50\nL X+20\nL Y+30\n";

std::string called(const std::string& cycle, const std::string& contour,
                   const std::string& data = " Q9=+1") {
  return kData + data + "\nCYCL DEF " + cycle + "\nCYCL CALL M3\nL M2\nLBL 1" + contour + "LBL 0";
}

/// The moves of a feed.
Lines fed(const Lines& moves, const std::string& feed) {
  Lines out;
  std::copy_if(moves.begin(), moves.end(), std::back_inserter(out),
               [&](const std::string& line) { return line.ends_with(" F" + feed); });
  return out;
}

TEST_CASE("24 mills along the inside of a pocket, climbing or not, in infeeds") {
  Workshop mill;
  CHECK(mill.path(called("24 SIDE FINISHING Q9=+1 Q10=-6 Q11=100 Q12=350", kPocket)) ==
        Lines{"L X+40 Y+34 Z+50 FMAX", "L X+40 Y+34 Z+3 FMAX", "L X+40 Y+34 Z-5 F100",
              "L X+56 Y+34 Z-5 F350", "L X+56 Y+46 Z-5 F350", "L X+24 Y+46 Z-5 F350",
              "L X+24 Y+34 Z-5 F350", "L X+40 Y+34 Z-5 F350", "L X+40 Y+34 Z-9 F100",
              "L X+56 Y+34 Z-9 F350", "L X+56 Y+46 Z-9 F350", "L X+24 Y+46 Z-9 F350",
              "L X+24 Y+34 Z-9 F350", "L X+40 Y+34 Z-9 F350", "L X+40 Y+34 Z+50 FMAX"});
  CHECK(outcome(mill.last) == "completed");
  // Up-cut, and 0.5 mm left on the side.
  CHECK(fed(mill.path(called("24 SIDE FINISHING Q9=-1 Q10=0 Q11=100 Q12=350 Q14=+0.5", kPocket)),
            "350") == Lines{"L X+55.5000 Y+45.5000 Z-9 F350", "L X+55.5000 Y+34.5000 Z-9 F350",
                            "L X+24.5000 Y+34.5000 Z-9 F350", "L X+24.5000 Y+45.5000 Z-9 F350",
                            "L X+40 Y+45.5000 Z-9 F350"});
}

TEST_CASE("24 goes around an island, on arcs around its corners") {
  Workshop mill;
  const std::string finish = "24 SIDE FINISHING Q9=+1 Q10=0 Q11=100 Q12=350";
  // RR around to the left is outside.
  CHECK(fed(mill.path(called(finish, "\nCC X+60 Y+50\nL X+50 Y+50 RR\nC X+50 Y+50 DR+\n")),
            "350") == Lines{"ARC X+46 Y+50 Z-9 CC X+60 Y+50 Z-9 -180 F350",
                            "ARC X+74 Y+50 Z-9 CC X+60 Y+50 Z-9 -180 F350"});
  // RL around to the right too; the open contour is closed by a line.
  CHECK(fed(mill.path(called(finish, "\nL X+0 Y+0 RL\nL Y+30\nL X+40\n")), "350").size() == 7);
  // RR to the right and RL to the left are pockets.
  CHECK(fed(mill.path(called(finish, "\nCC X+60 Y+50\nL X+50 Y+50 RR\nC X+50 Y+50 DR-\n")), "350")
            .front() == "ARC X+54 Y+50 Z-9 CC X+60 Y+50 Z-9 +180 F350");
}

TEST_CASE("a corner that is too small for the tool is milled as far as it goes") {
  Workshop mill;
  const std::string rounded =
      "\nL X+20 Y+40 RL\nL Y+30\nRND R2\nL X+60\nRND R6\nL Y+50\nRND R4\nL X+20\nRND R3\nL Y+40\n";
  CHECK(fed(mill.path(called("24 SIDE FINISHING Q9=+1 Q10=0 Q11=100 Q12=350", rounded)), "350") ==
        Lines{"L X+24 Y+46 Z-9 F350", "L X+24 Y+40 Z-9 F350", "L X+24 Y+34 Z-9 F350",
              "L X+54 Y+34 Z-9 F350", "ARC X+56 Y+36 Z-9 CC X+54 Y+36 Z-9 +90 F350",
              "L X+56 Y+46 Z-9 F350", "L X+40 Y+46 Z-9 F350"});
  CHECK(outcome(mill.last) == "completed");
}

TEST_CASE(
    "the contour may compute, repeat and transform; its depths and M functions do not count") {
  Workshop mill;
  const std::string finish = "24 SIDE FINISHING Q9=+1 Q10=0 Q11=100 Q12=350";
  const Lines plain = fed(mill.path(called(finish, kPocket)), "350");
  CHECK(fed(mill.path(called(finish,
                             "\nTRANS DATUM AXIS X+20 Y+30\nQ1 = 40\nL X+0 Y+0 Z-3 RL F99 M5\n"
                             "CALL LBL 2\nL IX-Q1\nL IY-20\n") +
                      "\nLBL 2\nL IX+Q1\nL IY+20\nLBL 0"),
            "350") == plain);
  // A mirrored contour is the same pocket, begun on its other side.
  CHECK(fed(mill.path(called(finish,
                             "\nCYCL DEF 8.0 MIRRORING\nCYCL DEF 8.1 X\nL X-60 Y+30 RL\n"
                             "L X-20\nL Y+50\nL X-60\nL Y+30\n")),
            "350") == Lines{"L X+24 Y+46 Z-9 F350", "L X+24 Y+34 Z-9 F350", "L X+56 Y+34 Z-9 F350",
                            "L X+56 Y+46 Z-9 F350", "L X+40 Y+46 Z-9 F350"});
  // What it transforms ends with it, and the machine has not moved.
  CHECK(mill.last.messages.empty());
  mill.path(called(finish, "\nL X+20 Y+30 RL\nCYCL CALL\nL X+60\n"));
  CHECK(outcome(mill.last).find("is not allowed in the contour") != std::string::npos);
  CHECK(mill.last.messages.back().source == "CYCL CALL");
  CHECK(mill.last.messages.back().line == 12);  // that of the contour
  mill.path(called(finish, "\nL X+20 Y+30 RL\nL X+60\n"));
  CHECK(mill.last.messages.back().number == 1024);
  mill.path("CYCL DEF 22 ROUGH-OUT Q10=-5\nCYCL CALL");
  CHECK(mill.last.messages.back().number == 1017);
}

TEST_CASE("21 pecks where 22 plunges") {
  Workshop mill;
  CHECK(mill.path(called("21 PILOT DRILLING Q10=-6 Q11=100 Q13=5", kPocket, " Q3=+1 Q4=+0.5")) ==
        Lines{"L X+40 Y+35 Z+50 FMAX", "L X+40 Y+35 Z+3 FMAX", "L X+40 Y+35 Z-5 F100",
              "L X+40 Y+35 Z+3 FMAX", "L X+40 Y+35 Z-4.4000 FMAX", "L X+40 Y+35 Z-8.5000 F100",
              "L X+40 Y+35 Z+50 FMAX"});
  mill.path(called("21 PILOT DRILLING Q10=-6 Q11=100 Q13=77", kPocket));
  CHECK(mill.last.messages.back().number == 1003);
}

TEST_CASE("22 clears in lanes, then mills along the contour, and leaves its allowances") {
  Workshop mill;
  const Lines moves = mill.path(
      called("22 ROUGH-OUT Q10=0 Q11=100 Q12=350 Q208=900", kPocket, " Q3=+1 Q4=+0.5 Q9=+1"));
  CHECK(fed(moves, "100") == Lines{"L X+25 Y+35 Z-8.5000 F100", "L X+55 Y+38.3333 Z-8.5000 F100",
                                   "L X+25 Y+41.6667 Z-8.5000 F100", "L X+55 Y+45 Z-8.5000 F100",
                                   "L X+40 Y+35 Z-8.5000 F100"});
  CHECK(fed(moves, "350") == Lines{"L X+55 Y+35 Z-8.5000 F350", "L X+25 Y+38.3333 Z-8.5000 F350",
                                   "L X+55 Y+41.6667 Z-8.5000 F350", "L X+25 Y+45 Z-8.5000 F350",
                                   "L X+55 Y+35 Z-8.5000 F350", "L X+55 Y+45 Z-8.5000 F350",
                                   "L X+25 Y+45 Z-8.5000 F350", "L X+25 Y+35 Z-8.5000 F350",
                                   "L X+40 Y+35 Z-8.5000 F350"});
  CHECK(moves.back() == "L X+40 Y+35 Z+50 F900");
  // The floor is finished at its depth at once.
  CHECK(
      fed(mill.path(called("23 FLOOR FINISHING Q11=100 Q12=350", kPocket, " Q3=+1 Q4=+0.5")), "100")
          .front() == "L X+25 Y+35 Z-9 F100");
}

struct Point {
  double x;
  double y;
};

/// The points every 0.1 mm of the straight moves at Z-9, at the feed of milling.
std::vector<Point> milled(const Lines& moves) {
  std::vector<Point> points;
  Point at{};
  for (const std::string& line : moves) {
    std::istringstream words(line);
    std::string word;
    Point to = at;
    bool is_arc = false;
    while (words >> word && word != "CC") {
      if (word == "ARC") is_arc = true;
      if (word[0] == 'X') to.x = std::stod(word.substr(1));
      if (word[0] == 'Y') to.y = std::stod(word.substr(1));
    }
    if (!is_arc && line.ends_with(" Z-9 F350")) {
      const int steps = static_cast<int>(std::hypot(to.x - at.x, to.y - at.y) / 0.1) + 1;
      for (int i = 0; i <= steps; ++i) {
        points.push_back({at.x + (to.x - at.x) * i / steps, at.y + (to.y - at.y) * i / steps});
      }
    }
    at = to;
  }
  return points;
}

TEST_CASE("22 cuts neither walls nor islands, and leaves nothing between them") {
  Workshop mill;
  const std::string body =
      "CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1 /2\n"
      "CYCL DEF 20 CONTOUR DATA Q1=-10 Q2=1 Q3=+0.5 Q5=+1 Q6=2 Q7=+50 Q9=+1\n"
      "CYCL DEF 22 ROUGH-OUT Q10=0 Q11=100 Q12=350\nCYCL CALL M3\nL M2\n"
      "LBL 1\nL X+0 Y+0 RL\nL X+100\nL Y+60\nL X+0\nL Y+0\nLBL 0\n"
      "LBL 2\nCC X+50 Y+30\nL X+38 Y+30 RL\nC X+38 Y+30 DR-\nLBL 0";
  const auto points = milled(mill.path(body));
  REQUIRE(outcome(mill.last) == "completed");
  REQUIRE(points.size() > 5000);
  const double reach = 4.5;
  const auto room = [](Point p) {
    return std::min({p.x, 100 - p.x, p.y, 60 - p.y, std::hypot(p.x - 50, p.y - 30) - 12});
  };
  double least = 1e9;
  for (const Point& p : points) least = std::min(least, room(p));
  CHECK(least >= reach - 1e-3);  // the trace shows four decimals
  double farthest = 0;
  for (double x = 0; x <= 100; x += 1) {
    for (double y = 0; y <= 60; y += 1) {
      if (room({x, y}) < reach) continue;
      double nearest = 1e9;
      for (const Point& p : points) nearest = std::min(nearest, std::hypot(p.x - x, p.y - y));
      farthest = std::max(farthest, nearest);
    }
  }
  CHECK(farthest <= 4);
}

}  // namespace
}  // namespace fitgauge::interpreter
