#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Block;
using machine::Bore;
using machine::Plane;
using machine::Vec3;

/// All presets here go to row 9, with 1 and 2 as new datum in the plane.
const Values kDatum{{305, 9.0}, {303, 1.0}, {331, 1.0}, {332, 2.0}};
/// And 3 in the probe axis, touched beside the feature.
const Values kProbeAxis{{381, 1.0}, {382, 20.0}, {383, 20.0}, {384, 0.0}, {333, 3.0}};

std::vector<machine::Feature> stud(double x1, double y1, double x2, double y2) {
  return {kPlate, Block{.min = {x1, y1, 0}, .max = {x2, y2, 20}}};
}

void check_near(const Vec3& a, const Vec3& b) {
  CAPTURE(a.x);
  CAPTURE(a.y);
  CAPTURE(a.z);
  CHECK(norm(a - b) < 2e-6);
}

}  // namespace

TEST_CASE("408 and 409 set the datum in the middle of a slot and a ridge") {
  const Values block = values("321=100 322=80 311=30 261=-5 320=0 260=40 405=1 305=9");
  for (const double via_clearance : {0.0, 1.0}) {
    ProbingBench slot(pocket(85.1, 20, 115.3, 140));
    CHECK(slot.run(408, with(block, {{272, 1.0}, {301, via_clearance}})) == 0);
    check_q(slot, {{157, 100.2}, {166, 30.2}});
    check_near(slot.preset(9).origin, {99.2, 0, 0});
  }
  ProbingBench ridge(stud(60, 64.9, 140, 95));
  CHECK(ridge.run(409, with(with(block, {{272, 2.0}, {261, 5.0}}), kProbeAxis)) == 0);
  check_q(ridge, {{157, 79.95}, {166, 30.1}});
  check_near(ridge.preset(9).origin, {0, 78.95, -3});
}

TEST_CASE("414 and 415 find each corner of a part that stands turned in its preset") {
  struct Case {
    double main;  // steps from the corner into the part
    double secondary;
    double inside_corner;  // Q308 of the same corner of a pocket
  };
  for (const Case& c : {Case{1, 1, 3}, Case{-1, 1, 4}, Case{-1, -1, 1}, Case{1, -1, 2}}) {
    CAPTURE(c.inside_corner);
    for (const double basic_rotation : {0.0, 1.0}) {
      const Vec3 corner{100, 80, 0};
      const Vec3 end{100 + 80 * c.main, 80 + 60 * c.secondary, 0};
      const std::vector<machine::Feature> part{
          Block{.min = {std::min(corner.x, end.x), std::min(corner.y, end.y), -40},
                .max = {std::max(corner.x, end.x), std::max(corner.y, end.y), 0}}};
      const std::vector<machine::Feature> pocket_walls{
          Plane{.point = corner, .normal = {-c.main, 0, 0}},
          Plane{.point = corner, .normal = {0, -c.secondary, 0}}};
      for (const bool inside : {false, true}) {
        CAPTURE(inside);
        machine::Setup setup{.machine = {}, .features = inside ? pocket_walls : part};
        setup.machine.start[machine::Axis::X] = 100 - c.main * 30;
        setup.machine.start[machine::Axis::Y] = 80 - c.secondary * 30;
        ProbingBench bench(setup);
        bench.activate_turned_preset(-2);
        const auto local = [&](double x, double y) {
          return bench.machine.state().frames.from_machine(corner + Vec3{x, y, 0});
        };
        const Vec3 vertex = local(0, 0);
        const Vec3 first = local(10 * c.main, 0);
        const Vec3 third = local(0, 10 * c.secondary);
        const Values common{{261, -5.0}, {260, 300.0}, {304, basic_rotation},
                            {305, 2.0},  {303, 1.0},   {331, 0.0},
                            {332, 0.0}};
        const Values outside_block{{263, first.x}, {264, first.y}, {326, 40.0},
                                   {296, third.x}, {297, third.y}, {327, 30.0}};
        const Values inside_block{{263, vertex.x}, {264, vertex.y},        {326, 40.0},
                                  {327, 30.0},     {308, c.inside_corner}, {260, 5.0}};
        CHECK(bench.run(inside ? 415 : 414, with(common, inside ? inside_block : outside_block)) ==
              0);
        CHECK(std::abs(bench.host.q[151] - vertex.x) < 2e-6);
        CHECK(std::abs(bench.host.q[152] - vertex.y) < 2e-6);
        REQUIRE(bench.machine.activate_preset(2).has_value());
        check_near(bench.machine.state().frames.from_machine(corner), {});
        const double left = bench.machine.state().frames.preset().basic_rotation_deg.z;
        CHECK(std::abs(left - (basic_rotation == 1 ? 0 : -2)) < 1e-6);
      }
    }
  }
}

TEST_CASE("418 sets the datum where the lines between four holes meet") {
  std::vector<machine::Feature> features{kPlate};
  for (const auto& centre :
       {std::array{60.0, 50.0}, {140.0, 50.1}, {140.2, 110.0}, {60.0, 110.0}}) {
    features.push_back(Bore{.centre = centre, .top = 0, .depth = 20, .diameter = 10});
  }
  ProbingBench bench(features);
  CHECK(
      bench.run(
          418,
          with(values("268=60 269=50 270=140 271=50 316=140 317=110 318=60 319=110 261=-5 260=40"),
               with(kDatum, kProbeAxis))) == 0);
  // x = 60 + 80.2 t, y = 50 + 60 t meets x = 140 - 80 s, y = 50.1 + 59.9 s.
  const double t = (80 * 0.1 + 80 * 59.9) / (80.2 * 59.9 + 80 * 60);
  check_near(bench.preset(9).origin, {60 + 80.2 * t - 1, 50 + 60 * t - 2, -3});
  CHECK(same(bench.host.q[151], std::round((60 + 80.2 * t) * 1e6) / 1e6));
}

TEST_CASE("419 sets the datum in any one axis") {
  ProbingBench bench({kPlate});
  const Values block = values("263=0 264=80 261=-5 260=40 272=1 267=1 333=7 305=9");
  CHECK(bench.run(419, block) == 0);
  CHECK(same(bench.host.q[160], 0));
  check_near(bench.preset(9).origin, {-7, 0, 0});
  CHECK(bench.run(419, with(block, {{263, 20.0}, {261, 0.0}, {272, 3.0}, {267, -1.0}})) == 0);
  check_near(bench.preset(9).origin, {-7, 0, -7});
}

TEST_CASE("presets in a rotated preset move along its own axes") {
  ProbingBench bench({Plane{}, Bore{.centre = {100, 80}, .top = 0, .depth = 30, .diameter = 25}});
  bench.activate_turned_preset(30);
  const Vec3 centre = bench.machine.state().frames.from_machine({100, 80, 0});
  CHECK(bench.run(412, with(with(values("262=25 247=90 261=-5 260=40 305=2 303=1"),
                                 {{321, centre.x + 0.2}, {322, centre.y}}),
                            {{331, 10.0}, {332, -5.0}})) == 0);
  REQUIRE(bench.machine.activate_preset(2).has_value());
  check_near(bench.machine.state().frames.from_machine({100, 80, 0}), {10, -5, 0});
  CHECK(bench.machine.state().frames.preset().basic_rotation_deg == Vec3{0, 0, 30});
}

}  // namespace fitgauge::probing
