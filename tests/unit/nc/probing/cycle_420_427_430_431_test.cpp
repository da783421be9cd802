#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

const machine::Block kRaisedPlate{.min = {0, 0, -40}, .max = {100, 80, 0.013}};

Values top_block() { return values("263=50 264=40 261=0 272=3 267=-1 260=50 288=0.02 289=-0.02"); }
Values side_block(double axis, double direction, double coordinate) {
  return with(values("261=-10 260=50"), {{263, axis == 1 ? coordinate : 50.0},
                                         {264, axis == 2 ? coordinate : 40.0},
                                         {272, axis},
                                         {267, direction},
                                         {288, coordinate + 0.05},
                                         {289, coordinate - 0.05}});
}

/// Three holes of 10 mm on a circle of the given diameter around 100, 80.
std::vector<machine::Feature> holes(double diameter, double dx = 0) {
  std::vector<machine::Feature> features{machine::Block{.min = {0, 0, -40}, .max = {200, 200, 0}}};
  for (const double angle : {0.0, 120.0, 240.0}) {
    const auto [sine, cosine] = machine::sine_cosine(angle);
    features.push_back(
        machine::Bore{.centre = {100 + dx + diameter / 2 * cosine, 80 + diameter / 2 * sine},
                      .top = 0,
                      .depth = 20,
                      .diameter = 10});
  }
  return features;
}

Values bolt_block() {
  return {{273, 100.0}, {274, 80.0}, {262, 60.0},  {291, 0.0},   {292, 120.0}, {293, 240.0},
          {261, -5.0},  {260, 20.0}, {288, 60.05}, {289, 59.95}, {309, 1.0}};
}

}  // namespace

TEST_CASE("420 measures the angle of an edge to the main axis") {
  const Values along_main =
      values("263=10 264=30 265=60 266=30 272=2 267=1 261=0 260=100 301=1 281=1 320=5");
  for (const double angle : {0.0, 1.5, -2.25}) {
    ProbingBench bench({edge_at(angle)});
    CHECK(bench.run(420, along_main) == 0);
    CHECK(std::abs(bench.host.q[150] - angle) < 1e-7);
    CHECK(bench.host.files.at("TCHPR420.TXT").find("Measured angle:") != std::string::npos);
    // Two touched coordinates, which nothing judges.
    REQUIRE(bench.host.records.size() == 1);
    CHECK(bench.host.records.front().sizes.size() == 2);
    CHECK_FALSE(bench.host.records.front().verdict.has_value());
  }
  const Values across{{263, -30.0}, {264, 10.0}, {265, -30.0}, {266, 60.0}, {272, 1.0},
                      {267, -1.0},  {261, 0.0},  {260, 100.0}, {320, 5.0},  {281, 0.0}};
  for (const double angle : {90.0, 91.5, 88.0}) {
    ProbingBench bench({edge_at(angle)});
    bench.host.q[180] = 1;
    CHECK(bench.run(420, across) == 0);
    CHECK(bench.host.q[180] == 1);
    CHECK(std::abs(bench.host.q[150] - angle) < 1e-7);
    CHECK(bench.host.files.empty());
  }
}

TEST_CASE("420 in the probe axis measures the slope along the axis in which the points differ") {
  const auto slope = [](const machine::Vec3& normal, double x2, double y2) {
    ProbingBench bench({machine::Plane{.point = {0, 0, 0}, .normal = normal}});
    CHECK(bench.run(420, with(values("263=0 264=0 272=3 267=-1 261=0 260=50"),
                              {{265, x2}, {266, y2}})) == 0);
    return bench.host.q[150];
  };
  const double up = std::tan(machine::radians(2));
  CHECK(std::abs(slope({-up, 0, 1}, 40, 0) - 2) < 1e-7);
  CHECK(std::abs(slope({0, up, 1}, 0, 40) + 2) < 1e-7);
}

TEST_CASE("420: a collision") {
  ProbingBench bench({edge_at(0)});
  const Values block = values("263=10 264=30 265=10 266=30 272=2 267=1 261=0 260=100");
  CHECK(bench.run(420, with(block, {{265, 60.0}, {266, 300.0}, {264, 300.0}})) == -1);
}

TEST_CASE("431 gives the angles that tilt the working plane into the measured one") {
  const auto measure = [](const machine::Vec3& spatial) {
    const machine::Matrix3 tilt = machine::Matrix3::spatial(spatial);
    const machine::Vec3 main = tilt * machine::Vec3{1, 0, 0};
    const machine::Vec3 secondary = tilt * machine::Vec3{0, 1, 0};
    const machine::Vec3 normal = tilt * machine::Vec3{0, 0, 1};
    ProbingBench bench({machine::Plane{.point = {0, 0, 0}, .normal = normal}});
    const machine::Vec3 second = main * 50;
    const machine::Vec3 third = secondary * 40 + main * 10;
    CHECK(bench.run(431, with(values("263=0 264=0 294=0 260=60"), {{265, second.x},
                                                                   {266, second.y},
                                                                   {295, second.z},
                                                                   {296, third.x},
                                                                   {297, third.y},
                                                                   {298, third.z}})) == 0);
    CHECK(same(bench.host.q[173], 0));
    CHECK(std::abs(bench.host.q[174] - second.z) < 1e-6);
    CHECK(std::abs(bench.host.q[175] - third.z) < 1e-6);
    CHECK(std::abs(bench.host.q[158] - machine::degrees(std::atan2(-normal.y, normal.z))) < 1e-6);
    CHECK(std::abs(bench.host.q[159] - machine::degrees(std::atan2(normal.x, normal.z))) < 1e-6);
    return machine::Vec3{bench.host.q[170], bench.host.q[171], bench.host.q[172]};
  };
  CHECK(measure({0, 0, 0}) == machine::Vec3{});
  CHECK(norm(measure({10, 0, 0}) - machine::Vec3{10, 0, 0}) < 1e-6);
  CHECK(norm(measure({0, -12, 0}) - machine::Vec3{0, -12, 0}) < 1e-6);
  CHECK(norm(measure({5, 7, 0}) - machine::Vec3{5, 7, 0}) < 1e-4);
}

TEST_CASE("427 in the probe axis: the surface, whether Q261 names it or the ball centre on it") {
  for (const double q261 : {0.0, 2.0, 1.0}) {
    ProbingBench bench({kRaisedPlate});
    CHECK(bench.run(427, with(top_block(), {{261, q261}})) == 0);
    check_q(bench, {{160, 0.013}, {168, 0.013 - q261}});
    CHECK(bench.status() == 100);
    CHECK(bench.host.files.count("TCHPR427.TXT") == 1);
    CHECK(bench.run(427, with(top_block(), {{261, q261}, {288, 0.0}, {289, 0.0}, {309, 1.0}})) ==
          0);
    CHECK(bench.status() == 100);
  }
}

TEST_CASE("427 in the plane, from both sides") {
  ProbingBench bench({kRaisedPlate});
  CHECK(bench.run(427, side_block(1, 1, 0)) == 0);
  CHECK(same(bench.host.q[160], 0));
  CHECK(bench.run(427, side_block(1, -1, 100)) == 0);
  CHECK(same(bench.host.q[160], 100));
  CHECK(bench.run(427, side_block(2, 1, 0)) == 0);
  CHECK(same(bench.host.q[160], 0));
  CHECK(bench.run(427, side_block(2, -1, 80)) == 0);
  CHECK(same(bench.host.q[160], 80));
  CHECK(bench.run(427, side_block(1, 0, 0)) == 1042);
  CHECK(bench.run(427, side_block(1, 1, 30)) == -1);
}

TEST_CASE("427 corrects the length of a tool in the probe axis, its radius across it") {
  machine::Setup setup{.machine = {}, .features = {kRaisedPlate}};
  setup.machine.tools.push_back(tool_of(7, 80, 8));
  ProbingBench bench(setup);
  CHECK(bench.run(427, with(top_block(), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dl, -0.013));  // too high: the tool is shorter
  CHECK(bench.run(427, with(side_block(1, -1, 99.98), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, -0.02));  // too much material
  CHECK(bench.run(427, with(side_block(1, 1, -0.05), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, 0.03));  // of the other side too little
  machine::Tool tool = *bench.machine.state().tools.find(7);
  tool.l_breakage = 0.01;
  REQUIRE(bench.machine.write_tool(tool).has_value());
  CHECK(bench.run(427, with(top_block(), {{330, 7.0}})) == 1065);
  CHECK(bench.machine.state().tools.find(7)->locked);
}

TEST_CASE("Q330 corrects the tool by the deviation without scale and mirror") {
  machine::Setup setup{.machine = {}, .features = {kRaisedPlate}};
  setup.machine.tools.push_back(tool_of(7, 80, 8));
  setup.machine.tools.back().row.l_breakage = 0.013;
  ProbingBench bench(setup);
  machine::Frames frames;
  frames.set_scaling({{2, 2, 2}, {}});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  CHECK(bench.run(427, with(top_block(), {{263, 25.0}, {264, 20.0}, {330, 7.0}})) == 0);
  CHECK(same(bench.host.q[168], 0.0065));
  CHECK(same(bench.machine.state().tools.find(7)->dl, -0.013));
  CHECK(bench.run(427, with(side_block(1, -1, 49.98), {{264, 20.0}, {330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, -0.04));
  machine::Tool tool = *bench.machine.state().tools.find(7);
  tool.l_breakage = 0.0129;
  REQUIRE(bench.machine.write_tool(tool).has_value());
  CHECK(bench.run(427, with(top_block(), {{263, 25.0}, {264, 20.0}, {330, 7.0}})) == 1065);

  ProbingBench mirrored(setup);
  frames = {};
  frames.set_mirror({true, false, true});
  REQUIRE(mirrored.machine.set_frames(frames).has_value());
  const Values top{{263, -50.0}, {267, 1.0}, {260, -50.0}, {330, 7.0}};
  CHECK(mirrored.run(427, with(top_block(), top)) == 0);
  CHECK(same(mirrored.host.q[168], -0.013));
  CHECK(same(mirrored.machine.state().tools.find(7)->dl, -0.013));  // too high, as without mirror
}

TEST_CASE("the positioning logic lifts a probe below the clearance height first") {
  ProbingBench bench({kRaisedPlate});
  const auto stand_low = [&] {
    bench.move(machine::Axis::Z, 60);
    bench.move(machine::Axis::X, -20);
    bench.move(machine::Axis::Z, -20);
  };
  stand_low();
  CHECK(bench.run(427, top_block()) == 0);
  CHECK(same(bench.machine.position().linear.z, 50));
  // Above the clearance height it goes across at once: here into the plate's face.
  stand_low();
  CHECK(bench.run(427, with(top_block(), {{260, -30.0}})) == -1);
}

TEST_CASE("430: centre, breakage and errors") {
  machine::Setup setup{.machine = {}, .features = holes(60.02, 0.1)};
  setup.machine.tools.push_back(tool_of(7, 80, 5));
  setup.machine.tools.back().row.r_breakage = 0.01;
  ProbingBench bench(setup);
  CHECK(bench.run(430, with(bolt_block(), {{279, 0.1}})) == 0);
  CHECK(bench.run(430, with(bolt_block(), {{279, 0.09}})) == 1044);
  CHECK(bench.run(430, with(bolt_block(), {{330, 7.0}})) == 1065);
  CHECK(bench.machine.state().tools.find(7)->dr == 0);
  CHECK(bench.machine.state().tools.find(7)->locked);
  CHECK(bench.run(430, with(bolt_block(), {{262, 80.0}})) == -1);
}

}  // namespace fitgauge::probing
