#include "nc/machine/workpiece.hpp"

#include <doctest/doctest.h>

#include "unit/nc/machine/vec_check.hpp"

using namespace fitgauge::machine;

namespace {

constexpr double kBall = 2;

Block block() { return {{0, 0, -40}, {100, 80, 0}}; }

Bore bore(double diameter = 25.013) {
  Bore bore;
  bore.centre = {50, 40};
  bore.depth = 30;
  bore.diameter = diameter;
  return bore;
}

Vec3 at_angle(double angle_deg) {
  return {std::cos(radians(angle_deg)), std::sin(radians(angle_deg)), 0};
}

double contact(const Workpiece& workpiece, const Vec3& start, const Vec3& direction,
               double radius = kBall) {
  const auto way = workpiece.contact(start, unit(direction), radius, 500);
  REQUIRE(way);
  return *way;
}

}  // namespace

TEST_CASE("a ball stops one radius before a face, from any side") {
  const Workpiece workpiece({block()});
  CHECK(near(contact(workpiece, {50, 40, 20}, {0, 0, -1}), 18));
  CHECK(near(contact(workpiece, {-10, 40, -20}, {1, 0, 0}), 8));
  CHECK(near(contact(workpiece, {50, 95, -20}, {0, -1, 0}), 13));
  CHECK(near(contact(workpiece, {50, 40, -60}, {0, 0, 1}), 18));
  // Oblique: the face is met where the normal part of the way is used up.
  CHECK(near(contact(workpiece, {50, 40, 20}, {1, 0, -1}), 18 * std::sqrt(2.0)));
  CHECK(near(contact(workpiece, {50, 40, 20}, {0.2, 0, -0.1}), 18 * std::sqrt(5.0)));
}

TEST_CASE("a ball meets an edge and a corner of a block") {
  const Workpiece workpiece({block()});
  // Down beside the edge x = 0: at the offset 1 the ball rests on the edge, sqrt(4 - 1) above it.
  CHECK(near(contact(workpiece, {-1, 40, 20}, {0, 0, -1}), 20 - std::sqrt(3.0)));
  CHECK(near(contact(workpiece, {-1, -1, 20}, {0, 0, -1}), 20 - std::sqrt(2.0)));
  CHECK_FALSE(workpiece.contact({-2.001, 40, 20}, {0, 0, -1}, kBall, 500));
}

TEST_CASE("a bore is round from inside in every direction") {
  const Workpiece workpiece({block(), bore()});
  for (int angle = 0; angle < 360; angle += 15) {
    CHECK(near(contact(workpiece, {50, 40, -10}, at_angle(angle)), 25.013 / 2 - kBall));
  }
  // From beside the centre, along x at y = 3: half chord of the offset circle.
  const double offset = 25.013 / 2 - kBall;
  CHECK(near(contact(workpiece, {48, 43, -10}, {1, 0, 0}), 2 + std::sqrt(offset * offset - 9)));
  CHECK(near(contact(workpiece, {50, 40, -10}, {0, 0, -1}), 18));  // the bottom
}

TEST_CASE("a ball enters a bore past its edge, or rests on it") {
  const Workpiece workpiece({block(), bore(10)});
  CHECK(near(contact(workpiece, {50, 40, 20}, {0, 0, -1}), 48));
  // 0.5 mm from the wall, the ball rests on the edge of the opening.
  CHECK(near(contact(workpiece, {54.5, 40, 20}, {0, 0, -1}), 20 - std::sqrt(4 - 0.25)));
  CHECK(near(contact(workpiece, {55.5, 40, 20}, {0, 0, -1}), 18));
  // A ball larger than the bore rests on the whole edge.
  const double rest = std::sqrt(64.0 - 25.0);
  CHECK(near(contact(workpiece, {50, 40, 20}, {0, 0, -1}, 8), 20 - rest, 1e-8));
}

TEST_CASE("a bore through a block has no bottom") {
  Bore through = bore(10);
  through.depth = 40;
  const Workpiece workpiece({block(), through});
  CHECK_FALSE(workpiece.contact({50, 40, 20}, {0, 0, -1}, kBall, 500));
  const Workpiece on_plane({block(), through, Plane{{0, 0, -45}, {0, 0, 1}}});
  CHECK(near(contact(on_plane, {50, 40, 20}, {0, 0, -1}), 63));
}

TEST_CASE("lobes follow R + a cos(n (t - phase)), touched by a ball") {
  Bore lobed = bore(25);
  lobed.lobes = 3;
  lobed.lobe_amplitude_um = 5;
  lobed.lobe_phase_deg = 10;
  const Workpiece workpiece({block(), lobed});
  // Where the profile is extreme the ball touches it in the probing direction.
  for (const int angle : {10, 130, 250}) {
    CHECK(near(contact(workpiece, {50, 40, -10}, at_angle(angle)), 12.505 - kBall));
  }
  for (const int angle : {70, 190, 310}) {
    CHECK(near(contact(workpiece, {50, 40, -10}, at_angle(angle)), 12.495 - kBall));
  }
  // Elsewhere it touches beside: compare with the nearest of a million points of the profile.
  const double angle = 33;
  const Vec3 centre = at_angle(angle) * contact(workpiece, {50, 40, -10}, at_angle(angle));
  double nearest = 1000;
  for (int k = 0; k < 1'000'000; ++k) {
    const double t = 2 * kPi * k / 1'000'000;
    const double r = 12.5 + 0.005 * std::cos(3 * (t - radians(10)));
    nearest = std::min(nearest, std::hypot(r * std::cos(t) - centre.x, r * std::sin(t) - centre.y));
  }
  CHECK(near(nearest, kBall, 1e-9));
}

TEST_CASE("four points do not see three lobes but four") {
  const auto diameter = [](int lobes) {
    Bore lobed = bore(25);
    lobed.lobes = lobes;
    lobed.lobe_amplitude_um = 5;
    const Workpiece workpiece({block(), lobed});
    double sum = 0;
    for (int angle = 0; angle < 360; angle += 90) {
      sum += contact(workpiece, {50, 40, -10}, at_angle(angle)) + kBall;
    }
    return sum / 2;
  };
  CHECK(near(diameter(3), 25, 1e-4));
  CHECK(near(diameter(4), 25.010, 1e-9));
}

TEST_CASE("a taper opens the diameter with the depth and is touched square to the wall") {
  Bore tapered = bore(25);
  tapered.taper_um_per_mm = 100;
  const Workpiece workpiece({block(), tapered});
  // The wall at depth h is 12.5 + 0.05 h; the ball at depth 10 touches a little lower.
  const double slant = std::hypot(1.0, 0.05);
  CHECK(near(contact(workpiece, {50, 40, -10}, {0, 1, 0}), 13 - kBall * slant));
}

TEST_CASE("a tilted bore is a circle across its own axis") {
  Bore tilted = bore(20);
  tilted.tilt_deg = {5, 0};
  const Workpiece workpiece({block(), tilted});
  const Matrix3 turn = Matrix3::spatial({5, 0, 0});
  const Vec3 middle = Vec3{50, 40, 0} + turn * Vec3{0, 0, -15};
  for (int angle = 0; angle < 360; angle += 30) {
    CHECK(near(contact(workpiece, middle, turn * at_angle(angle)), 10 - kBall));
  }
  // Along y the cut of the cylinder is an ellipse: 1 / cos 5 degrees longer.
  CHECK(near(contact(workpiece, middle, {0, 1, 0}), (10 - kBall) / std::cos(radians(5))));
}

TEST_CASE("bosses, planes and spheres add material, joined in order") {
  const Workpiece workpiece({block(), Boss{{20, 20}, 10, 10, 12}, Sphere{{70, 40, 30}, 25},
                             Plane{{0, 0, -100}, {0, 0, 1}}});
  CHECK(near(contact(workpiece, {20, 20, 50}, {0, 0, -1}), 38));
  for (int angle = 0; angle < 360; angle += 45) {
    CHECK(near(contact(workpiece, Vec3{20, 20, 5} + at_angle(angle) * 15, -at_angle(angle)), 7));
  }
  const Vec3 slanted = unit({1, 2, 3});
  CHECK(near(contact(workpiece, Vec3{70, 40, 30} + slanted * 20, -slanted), 5.5));
  CHECK(near(contact(workpiece, {-20, -20, 0}, {0, 0, -1}), 98));
  // Between the boss and the block's face the ball touches whichever is nearer.
  CHECK(near(contact(workpiece, {40, 20, 2.5}, {-1, 0, 0}), 12));
  // A boss after a bore stands in it; a bore after a boss takes it away.
  const Workpiece stud_in_bore({block(), bore(30), Boss{{50, 40}, -10, 20, 6}});
  CHECK(near(contact(stud_in_bore, {50, 40, 20}, {0, 0, -1}), 28));
  const Workpiece drilled({block(), Boss{{50, 40}, 10, 10, 30}, Bore{{50, 40}, 10, 20, 20}});
  CHECK(near(contact(drilled, {50, 40, 20}, {0, 0, -1}), 28));
  CHECK(near(contact(drilled, {50, 40, 5}, {1, 0, 0}), 8));
}

TEST_CASE("an oblique plane is met along any direction") {
  const Vec3 normal = unit({1, 2, 2});
  const Workpiece workpiece({Plane{{10, 20, 30}, {1, 2, 2}}});
  const Vec3 start = Vec3{10, 20, 30} + normal * 50 + cross(normal, Vec3{1, 0, 0}) * 7;
  for (const Vec3& direction : {Vec3{0, 0, -1}, Vec3{-1, 0, 0}, Vec3{-1, -1, -1}, -normal}) {
    const Vec3 along = unit(direction);
    CHECK(near(contact(workpiece, start, along), -48 / dot(along, normal)));
  }
}

TEST_CASE("a measured surface is linear between its points and ends at their hull") {
  Surface surface;
  for (int x = 0; x <= 3; ++x) {
    for (int y = 0; y <= 3; ++y) {
      surface.points.push_back({10.0 * x, 10.0 * y, 0.3 * x + 0.2 * y});
    }
  }
  const Workpiece workpiece({surface});
  const Vec3 normal = unit({-0.03, -0.02, 1});
  for (const Vec3 at : {Vec3{5, 5, 20}, Vec3{14, 21, 20}, Vec3{28, 3, 20}}) {
    const double height = 0.03 * at.x + 0.02 * at.y;
    CHECK(near(contact(workpiece, at, {0, 0, -1}), 20 - height - kBall / normal.z));
    CHECK(near(contact(workpiece, at, -normal), (20 - height) * normal.z - kBall));
  }
  CHECK_FALSE(workpiece.contact({-2.1, 15, 20}, {0, 0, -1}, kBall, 500));
  CHECK(near(contact(workpiece, {-20, 15, -50}, {1, 0, 0}), 18));  // the wall below the hull
}

TEST_CASE("a single triangle is touched at its points") {
  const Workpiece workpiece({Surface{{{0, 0, 1.2}, {10, 0, 1.25}, {0, 10, 1.1}}}});
  CHECK(near(contact(workpiece, {3, 3, 20}, {0, 0, -1}, 0.5),
             20 - (1.2 + 0.005 * 3 - 0.01 * 3) - 0.5 * std::sqrt(1 + 0.005 * 0.005 + 0.0001)));
}

TEST_CASE("an empty workpiece is never touched") {
  const Workpiece workpiece({});
  CHECK(workpiece.is_empty());
  CHECK_FALSE(workpiece.contact({0, 0, 0}, {0, 0, -1}, kBall, 500));
  CHECK(std::isinf(workpiece.clearance({0, 0, 0}, kBall)));
}

TEST_CASE("a way beside a wall ends without touching") {
  const Workpiece workpiece({block()});
  CHECK_FALSE(workpiece.contact({-200, 40, 2 + 1e-7}, {1, 0, 0}, kBall, 400));
  CHECK(near(contact(workpiece, {-200, 40, 2 - 1e-4}, {1, 0, 0}),
             200 - std::sqrt(4 - (2 - 1e-4) * (2 - 1e-4)), 1e-7));
}
