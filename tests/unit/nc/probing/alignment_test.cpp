#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::Bore;
using machine::Boss;
using machine::Plane;
using machine::Vec3;

/// The default machine with a rotary table C that turns around the machine's zero.
machine::Setup with_table(std::vector<machine::Feature> features, Axis letter = Axis::C) {
  machine::Setup setup{.machine = {}, .features = std::move(features)};
  machine::AxisSetup table = machine::AxisSetup::of(letter);
  table.centre = {0, 0, 0};
  setup.machine.axes[index(letter)] = table;
  return setup;
}

const Values kEdge = values("263=10 264=30 265=60 266=30 272=2 267=1 261=0 260=100");

std::vector<machine::Feature> two(double angle_deg, bool holes) {
  const auto [sine, cosine] = machine::sine_cosine(angle_deg);
  std::vector<machine::Feature> features{Plane{}};
  for (const double radius : {20.0, 120.0}) {
    const std::array centre{radius * cosine, radius * sine};
    if (holes) {
      features.push_back(Bore{.centre = centre, .top = 0, .depth = 20, .diameter = 10});
    } else {
      features.push_back(Boss{.centre = centre, .top = 10, .height = 10, .diameter = 10});
    }
  }
  return features;
}
const Values kHoles{{268, 20.0}, {269, 0.0}, {270, 120.0}, {271, 0.0}, {261, -5.0}, {260, 30.0}};
const Values kStuds = values("268=20 269=0 313=10 261=5 270=120 271=0 314=10 315=5 260=30 320=5");

double rotation(const ProbingBench& bench) {
  return bench.machine.state().frames.preset().basic_rotation_deg.z;
}
bool near(double a, double b) { return std::abs(a - b) < 1e-6; }

}  // namespace

TEST_CASE("400 makes the angle of an edge the basic rotation") {
  ProbingBench bench({edge_at(1.5)});
  CHECK(bench.run(400, kEdge) == 0);
  CHECK(near(rotation(bench), 1.5));
  CHECK(bench.preset(1).basic_rotation_deg.z == 0);
  // A rotation that is active is reset first, so the angle does not add up.
  CHECK(bench.run(400, with(kEdge, {{307, 0.5}})) == 0);
  CHECK(near(rotation(bench), 1));
  CHECK(bench.run(400, with(kEdge, {{305, 4.0}})) == 0);
  CHECK(rotation(bench) == 0);
  CHECK(near(bench.preset(4).basic_rotation_deg.z, 1.5));
  REQUIRE(bench.machine.activate_preset(4).has_value());
  CHECK(near(rotation(bench), 1.5));
}

TEST_CASE("400 along the secondary axis, whether Q307 says 0 or 90") {
  const Values block = values("263=-30 264=10 265=-30 266=60 272=1 267=-1 261=0 320=5 260=100");
  for (const double reference : {0.0, 90.0}) {
    for (const double angle : {91.5, 88.0}) {
      ProbingBench bench({edge_at(angle)});
      CHECK(bench.run(400, with(block, {{307, reference}})) == 0);
      CHECK(near(rotation(bench), angle - 90));
    }
  }
}

TEST_CASE("400, 401 and 402 turn by the least angle between the line and Q307") {
  for (const double reference : {-90.0, 90.0, 180.0, 270.0}) {
    for (const double off : {1.0, -1.0}) {
      CAPTURE(reference);
      CAPTURE(off);
      ProbingBench bench(two(reference + off, true));
      const auto [sine, cosine] = machine::sine_cosine(reference);
      const Values at{{268, 20 * cosine}, {269, 20 * sine}, {270, 120 * cosine}, {271, 120 * sine}};
      CHECK(bench.run(401, with(with(kHoles, at), {{307, reference}})) == 0);
      CHECK(near(rotation(bench), off));
      ProbingBench studs(two(reference + off, false));
      CHECK(studs.run(402, with(with(kStuds, at), {{307, reference}})) == 0);
      CHECK(near(rotation(studs), off));
    }
  }
  ProbingBench edge({edge_at(-1)});
  CHECK(edge.run(400, with(kEdge, {{307, 180.0}})) == 0);
  CHECK(near(rotation(edge), -1));
}

TEST_CASE("401 and 402 take the line between two holes or studs") {
  for (const double angle : {0.0, 1.25, -0.75}) {
    ProbingBench holes(two(angle, true));
    CHECK(holes.run(401, kHoles) == 0);
    CHECK(near(rotation(holes), angle));
    ProbingBench studs(two(angle, false));
    CHECK(studs.run(402, with(kStuds, {{307, 1.0}, {305, 3.0}})) == 0);
    CHECK(near(studs.preset(3).basic_rotation_deg.z, angle - 1));
    CHECK(rotation(studs) == 0);
  }
}

TEST_CASE("401 and 402 turn the table instead, and set it to zero") {
  ProbingBench bench(with_table(two(1.25, true)));
  CHECK(bench.run(401, with(kHoles, {{402, 1.0}, {337, 1.0}})) == 0);
  CHECK(rotation(bench) == 0);
  CHECK(near(bench.machine.position(machine::CoordinateSystem::Machine)[Axis::C], 1.25));
  CHECK(bench.machine.position()[Axis::C] == 0);
  // The holes stand along the main axis now.
  CHECK(bench.run(401, kHoles) == 0);
  CHECK(near(rotation(bench), 0));
  ProbingBench studs(with_table(two(-2, false)));
  CHECK(studs.run(402, with(kStuds, {{402, 1.0}})) == 0);
  CHECK(near(studs.machine.position()[Axis::C], -2));
  ProbingBench without(two(1, true));
  CHECK(without.run(401, with(kHoles, {{402, 1.0}})) == -1);
  machine::Setup head = with_table(two(1, true));
  head.machine.axes[index(Axis::C)]->mount = machine::AxisMount::Head;
  ProbingBench turning_head(head);
  CHECK(turning_head.run(401, with(kHoles, {{402, 1.0}})) == 1100);
}

TEST_CASE("403 turns a rotary axis until the edge stands along the main axis") {
  ProbingBench bench(with_table({edge_at(1.5)}));
  CHECK(bench.run(403, with(kEdge, {{312, 6.0}, {337, 1.0}, {305, 0.0}})) == 0);
  CHECK(near(bench.host.q[150], 1.5));
  CHECK(near(bench.machine.position(machine::CoordinateSystem::Machine)[Axis::C], 1.5));
  CHECK(bench.machine.position()[Axis::C] == 0);
  CHECK(bench.run(403, with(kEdge, {{380, 1.0}, {337, 0.0}})) == 0);
  CHECK(near(bench.host.q[150], 0));
  CHECK(near(bench.machine.position()[Axis::C], -1));
  CHECK(bench.run(403, with(kEdge, {{312, 4.0}})) == 1019);
  CHECK(bench.run(403, with(kEdge, {{312, 2.0}})) == 1019);
}

TEST_CASE("403 takes half a turn more of Q380 for the same line") {
  const Values across = with(kEdge, values("263=-30 264=10 265=-30 266=60 272=1 267=-1"));
  for (const auto& [block, nominal] : {std::pair(kEdge, 0.0), std::pair(across, 90.0)}) {
    for (const double half_turns : {-180.0, 0.0, 180.0}) {
      for (const double off : {1.0, -1.0}) {
        CAPTURE(nominal + half_turns);
        ProbingBench bench(with_table({edge_at(nominal + off)}));
        CHECK(bench.run(403, with(block, {{380, nominal + half_turns}})) == 0);
        CHECK(near(bench.host.q[150], nominal + off));
        CHECK(near(bench.machine.position()[Axis::C], off));
      }
    }
  }
}

TEST_CASE("403 writes the zero of the axis to the row of Q305, as Q303 says") {
  ProbingBench bench(with_table({edge_at(1.5)}));
  REQUIRE(bench.run(403, with(kEdge, {{337, 1.0}, {305, 5.0}, {303, 1.0}})) == 0);
  CHECK(near(bench.machine.state().presets.find(5)->frame.rotary_offsets_deg.z, 1.5));
  CHECK(near(bench.machine.position()[Axis::C], 1.5));
  ProbingBench table(with_table({edge_at(1.5)}));
  CHECK(table.run(403, with(kEdge, {{337, 1.0}, {305, 5.0}, {303, 0.0}})) == 1043);
  table.host.has_datum_table = true;
  ProbingBench written(with_table({edge_at(1.5)}));
  written.host.has_datum_table = true;
  REQUIRE(written.run(403, with(kEdge, {{337, 1.0}, {305, 5.0}, {303, 0.0}})) == 0);
  CHECK(near(*written.host.datums.at(5)[Axis::C], 1.5));
}

TEST_CASE("403 levels a sloping face with A or B") {
  const double slope = std::tan(machine::radians(2));
  ProbingBench a(with_table({Plane{.point = {0, 0, 0}, .normal = {0, -slope, 1}}}, Axis::A));
  const Values along_y = values("263=0 264=0 265=0 266=40 272=3 267=-1 261=0 260=50");
  CHECK(a.run(403, along_y) == 0);
  CHECK(near(a.host.q[150], 2));
  CHECK(a.run(403, along_y) == 0);
  CHECK(near(a.host.q[150], 0));
  ProbingBench b(with_table({Plane{.point = {0, 0, 0}, .normal = {-slope, 0, 1}}}, Axis::B));
  const Values along_x = with(along_y, {{265, 40.0}, {266, 0.0}, {312, 5.0}});
  CHECK(b.run(403, along_x) == 0);
  CHECK(near(b.host.q[150], -2));
  CHECK(b.run(403, along_x) == 0);
  CHECK(near(b.host.q[150], 0));
}

TEST_CASE("404 sets a basic rotation without touching") {
  ProbingBench bench;
  CHECK(bench.run(404, {{307, 3.0}, {305, 0.0}}) == 0);
  CHECK(rotation(bench) == 3);
  CHECK(bench.preset(1).basic_rotation_deg.z == 0);
  CHECK(bench.run(404, {{307, 4.0}}) == 0);
  CHECK(rotation(bench) == 4);
  CHECK(bench.preset(1).basic_rotation_deg.z == 4);
  CHECK(bench.run(404, {{307, 5.0}, {305, 6.0}}) == 0);
  CHECK(rotation(bench) == 4);
  CHECK(bench.preset(6).basic_rotation_deg.z == 5);
}

TEST_CASE("405 turns the table until the hole stands where it belongs") {
  const auto hole_at = [](double angle_deg) {
    const auto [sine, cosine] = machine::sine_cosine(angle_deg);
    return std::vector<machine::Feature>{
        Plane{}, Bore{.centre = {80 * cosine, 80 * sine}, .top = 0, .depth = 20, .diameter = 20}};
  };
  const Values block{{321, 80.0}, {322, 0.1}, {262, 20.0}, {247, 90.0}, {261, -5.0}, {260, 30.0}};
  const double nominal = machine::degrees(std::atan2(0.1, 80));
  ProbingBench bench(with_table(hole_at(1)));
  CHECK(bench.run(405, with(block, {{337, 0.0}})) == 0);
  CHECK(near(bench.host.q[150], 1 - nominal));
  CHECK(bench.machine.position()[Axis::C] == 0);
  CHECK(bench.run(405, block) == 0);
  CHECK(near(bench.host.q[150], 0));

  ProbingBench up(with_table(hole_at(91)));
  up.host.has_datum_table = true;
  CHECK(up.run(405, with(block, {{321, 0.0}, {322, 80.0}, {337, 7.0}})) == 0);
  CHECK(near(up.host.q[150], 1));
  CHECK(near(*up.host.datums.at(7)[Axis::C], 1));
  CHECK(up.run(405, with(block, {{247, 0.0}})) == 1066);
}

}  // namespace fitgauge::probing
