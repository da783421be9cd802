#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Block;
using machine::Bore;
using machine::Boss;

const Block kSquarePlate{.min = {0, 0, -40}, .max = {200, 200, 0}};

/// A hole or stud of 25 in the middle of the plate, limits 25.021 and 25.
Values hole_block() {
  return values("273=100 274=100 262=25 247=90 261=-5 260=20 275=25.021 276=25");
}
ProbingBench hole_of(double diameter, std::array<double, 2> centre = {100, 100}) {
  return ProbingBench(
      {kSquarePlate, Bore{.centre = centre, .top = 0, .depth = 30, .diameter = diameter}});
}
Values stud_block() {
  return values("273=100 274=100 262=25 247=90 261=5 260=30 277=25 278=24.979");
}
ProbingBench stud_of(double diameter) {
  return ProbingBench(
      {kSquarePlate, Boss{.centre = {100, 100}, .top = 10, .height = 10, .diameter = diameter}});
}

}  // namespace

TEST_CASE("421 and 422 reach every path between the points") {
  for (const double via_clearance : {0.0, 1.0}) {
    for (const double arc : {0.0, 1.0}) {
      for (const double step : {-90.0, 35.0}) {
        for (const double points : {3.0, 4.0}) {
          const Values path{{301, via_clearance}, {365, arc},    {247, step},
                            {325, 17.0},          {423, points}, {320, 1.5}};
          ProbingBench hole = hole_of(25.013);
          CHECK(hole.run(421, with(hole_block(), path)) == 0);
          CHECK(same(hole.host.q[153], 25.013));
          CHECK(hole.host.touches.size() == static_cast<std::size_t>(points));
          ProbingBench stud = stud_of(24.99);
          // A chord across 90 degrees would cut the stud.
          const bool collides = arc == 0 && via_clearance == 0 && step == -90;
          CHECK(stud.run(422, with(stud_block(), path)) == (collides ? -1 : 0));
          if (!collides) CHECK(same(stud.host.q[153], 24.99));
        }
      }
    }
  }
}

TEST_CASE("an error of 421, 422, 412 and 413 names the bore or boss that is there") {
  const auto preset_block = [](double height) {
    return Values{{321, 100.0}, {322, 100.0}, {262, 25.0}, {247, 90.0}, {261, height}, {260, 30.0}};
  };
  // The number of the error, and its text from the part on.
  const auto text = [](ProbingBench bench, int number, const Values& values) {
    const std::string error = std::to_string(bench.run(number, values));
    const auto at = bench.fault.text.find("; ");
    return at == std::string::npos ? error : error + bench.fault.text.substr(at);
  };
  const std::string boss = "; the setup has a boss of 25 mm here: cycle ";
  const std::string bore = "; the setup has a bore of 25 mm here: cycle ";
  CHECK(text(stud_of(25), 421, with(hole_block(), {{261, 5.0}})) == "-1" + boss + "422");
  CHECK(text(stud_of(25), 412, preset_block(5)) == "-1" + boss + "413");
  CHECK(text(hole_of(25), 422, with(stud_block(), {{261, -5.0}})) == "-1" + bore + "421");
  CHECK(text(hole_of(25), 413, preset_block(-5)) == "-1" + bore + "412");
  // Nothing within DIST: the stud stands above the ball, or the hole is larger.
  CHECK(text(hole_of(25), 422, stud_block()) == "1014" + bore + "421");
  CHECK(text(hole_of(80), 421, hole_block()) ==
        "1014; the setup has a bore of 80 mm here: Q262 is 25 mm");
  CHECK(text(stud_of(60), 422, stud_block()) ==
        "-1; the setup has a boss of 60 mm here: Q262 is 25 mm");
  CHECK(text(hole_of(25), 421, with(hole_block(), {{261, 5.0}})) == "1014");
  CHECK(text(hole_of(25, {50, 50}), 422, with(stud_block(), {{261, -5.0}})) == "-1");
}

TEST_CASE("421 touches a hole too small for the clearance from its centre") {
  ProbingBench bench(
      {kSquarePlate, Bore{.centre = {100, 100}, .top = 0, .depth = 20, .diameter = 6}});
  CHECK(bench.run(421, with(hole_block(), values("262=6 275=6.01 276=5.99 301=1"))) == 0);
  CHECK(same(bench.host.q[153], 6.0));
}

TEST_CASE("421: a centre out of tolerance is reject, 0 switches the check off") {
  ProbingBench bench = hole_of(25.01, {100.1, 99.95});
  const Values block = with(hole_block(), {{309, 1.0}});
  CHECK(bench.run(421, with(block, {{279, 0.1}, {280, 0.05}})) == 0);
  CHECK(bench.run(421, with(block, {{279, 0.0999}, {280, 0.05}})) == 1044);
  CHECK(bench.status() == 1);
  CHECK(bench.run(421, with(block, {{279, 0.1}, {280, 0.0499}})) == 1045);
  CHECK(bench.run(421, with(block, {{279, 0.0}, {280, 0.0}})) == 0);
}

TEST_CASE("421 writes its log where Q281 says") {
  ProbingBench bench = hole_of(25.01);
  CHECK(bench.run(421, with(hole_block(), {{281, 0.0}})) == 0);
  CHECK(bench.host.files.empty());
  CHECK(bench.run(421, with(hole_block(), {{281, 2.0}})) == 0);
  CHECK(bench.host.files.empty());
  CHECK(bench.host.shown.size() == 1);
  bench.host.cycle_memory.fast_probing.interrupts = false;
  CHECK(bench.run(421, with(hole_block(), {{281, 2.0}})) == 0);
  CHECK(bench.host.shown.size() == 1);
  CHECK(bench.run(421, with(hole_block(), {{281, 1.0}})) == 0);
  const std::size_t size = bench.host.files.at("TCHPR421.TXT").size();
  CHECK(bench.run(421, with(hole_block(), {{281, 1.0}})) == 0);
  CHECK(bench.host.files.at("TCHPR421.TXT").size() == 2 * size);
}

TEST_CASE("Q330 corrects the radius of the named tool and watches for breakage") {
  machine::Setup setup{
      .machine = {},
      .features = {kSquarePlate,
                   Bore{.centre = {100, 100}, .top = 0, .depth = 30, .diameter = 25.013},
                   Boss{.centre = {30, 30}, .top = 10, .height = 10, .diameter = 24.99}}};
  setup.machine.tools.push_back(tool_of(7, 80, 8));
  setup.machine.tools.back().row.name = "MILL_D16";
  ProbingBench bench(setup);
  CHECK(bench.run(421, with(hole_block(), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, 0.0065));
  CHECK(bench.run(421, with(hole_block(), {{330, std::string("mill_d16")}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, 0.013));
  const Values stud{{273, 30.0}, {274, 30.0}};
  CHECK(bench.run(422, with(with(stud_block(), stud), {{330, 7.0}})) == 0);
  CHECK(same(bench.machine.state().tools.find(7)->dr, 0.018));
  CHECK(bench.run(421, with(hole_block(), {{330, 8.0}})) == 1092);
  CHECK(bench.run(421, with(hole_block(), {{330, std::string("NONE")}})) == 1092);

  machine::Tool tool = *bench.machine.state().tools.find(7);
  tool.r_breakage = 0.013;
  REQUIRE(bench.machine.write_tool(tool).has_value());
  CHECK(bench.run(421, with(hole_block(), {{330, 7.0}})) == 0);
  tool = *bench.machine.state().tools.find(7);
  tool.r_breakage = 0.0129;
  REQUIRE(bench.machine.write_tool(tool).has_value());
  CHECK(bench.run(421, with(hole_block(), {{330, 7.0}})) == 1065);
  CHECK(bench.machine.state().tools.find(7)->locked);
}

TEST_CASE("421: errors of parameters and motion") {
  ProbingBench bench = hole_of(25.01);
  CHECK(bench.run(421, with(hole_block(), {{247, 120.1}})) == 1004);
  CHECK(bench.run(421, with(hole_block(), {{423, 5.0}})) == 1004);
  CHECK(bench.run(421, {{273, 50.0}}) == 1017);
  CHECK(bench.run(421, with(hole_block(), {{274, 150.0}})) == -1);  // collides with the plate
}

TEST_CASE("measuring resets a basic rotation") {
  ProbingBench bench = hole_of(25.01);
  machine::Frames frames = bench.machine.state().frames;
  frames.set_preset({.origin = {}, .basic_rotation_deg = {0, 0, 5}, .rotary_offsets_deg = {}});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  CHECK(bench.run(421, hole_block()) == 0);
  CHECK(same(bench.host.q[151], 100));
  CHECK(bench.machine.state().frames.preset().basic_rotation_deg == machine::Vec3{});
}

TEST_CASE("422 in the planes of the other tool axes: the equator of a sphere") {
  using machine::Axis;
  struct Case {
    Axis tool_axis;
    double main;
    double secondary;
    double height;
  };
  for (const Case& c : {Case{Axis::X, 30, 10, -20}, Case{Axis::Y, 10, -20, 30}}) {
    ProbingBench bench({machine::Sphere{.centre = {-20, 30, 10}, .diameter = 24.99}});
    bench.move(c.tool_axis, 120);
    bench.move(Axis::Z, 10);
    REQUIRE(bench.machine.call_tool({.number = {}, .axis = c.tool_axis, .spindle_rpm = {}})
                .has_value());
    for (const double via_clearance : {0.0, 1.0}) {
      CHECK(bench.run(422, with(stud_block(), {{273, c.main},
                                               {274, c.secondary},
                                               {261, c.height},
                                               {260, 60.0},
                                               {301, via_clearance}})) == 0);
      CHECK(std::abs(bench.host.q[151] - c.main) < 2e-6);
      CHECK(std::abs(bench.host.q[152] - c.secondary) < 2e-6);
      CHECK(std::abs(bench.host.q[153] - 24.99) < 2e-6);
    }
  }
}

TEST_CASE("the log of an INCH program counts in inches") {
  ProbingBench bench = hole_of(25.4);
  bench.host.inch = true;
  CHECK(bench.run(421, with(hole_block(), {{262, 25.4}, {275, 0.0}, {276, 0.0}})) == 0);
  const std::string& log = bench.host.files.at("TCHPR421.TXT");
  CHECK(log.find("Unit (0=MM / 1=INCH): 1\n") != std::string::npos);
  CHECK(log.find("Diameter:                                           1.000000\n") !=
        std::string::npos);
}

}  // namespace fitgauge::probing
