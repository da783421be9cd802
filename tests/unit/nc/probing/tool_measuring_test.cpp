#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::CoordinateSystem;
using machine::Setup;
using machine::Vec3;

/// A worn end mill: 0.03 mm shorter and 0.012 mm thinner than tool.t says.
Setup mill_setup() {
  Setup setup;
  machine::ToolSetup& mill = setup.machine.tools.emplace_back(tool_of(5, 100, 6));
  mill.row.name = "MILL_D12";
  mill.row.teeth = 4;
  mill.row.l_tolerance = 0.05;
  mill.row.r_tolerance = 0.02;
  mill.row.l_breakage = 2;
  mill.row.r_breakage = 0.5;
  mill.actual_length = 99.97;
  mill.actual_radius = 5.988;
  return setup;
}

class TtBench : public ProbingBench {
 public:
  explicit TtBench(const Setup& setup = mill_setup()) : ProbingBench(setup) { call(5); }

  const machine::Tool& mill() { return *machine.state().tools.find(5); }
};

const Values kCheck{{340, 1.0}, {260, 200.0}};

}  // namespace

TEST_CASE("481 to 483 check a tool: DL and DR, Q115, Q116, Q199") {
  TtBench bench;
  CHECK(bench.run(481, kCheck) == 0);
  CHECK(same(bench.mill().dl, -0.03));
  CHECK(bench.mill().l == 100);
  CHECK(same(bench.host.q[115], -0.03));
  CHECK(bench.host.q[199] == 0);
  CHECK(bench.run(482, kCheck) == 0);
  CHECK(same(bench.mill().dr, -0.012));
  CHECK(same(bench.host.q[116], -0.012));
  CHECK_FALSE(bench.mill().locked);
  // With DL and DR in force the same tool is found again.
  CHECK(bench.run(483, kCheck) == 0);
  CHECK(same(bench.mill().dl, -0.03));
  CHECK(same(bench.mill().dr, -0.012));
  CHECK(std::abs(bench.machine.position(CoordinateSystem::Machine).linear.z - 200) < 1e-9);
}

TEST_CASE("31 to 33 are 481 to 483 in sub-lines, with a Q for the status") {
  TtBench bench;
  const Values check{{word(ParameterId::WordCheck), 1.0},
                     {word(ParameterId::WordHeight), 200.0},
                     {word(ParameterId::WordResult), 5.0}};
  bench.host.q[5] = -1;
  CHECK(bench.run(31, check) == 0);
  CHECK(same(bench.mill().dl, -0.03));
  CHECK(bench.host.q[5] == 0);
  CHECK(bench.run(32, check) == 0);
  CHECK(same(bench.mill().dr, -0.012));
  machine::Tool strict = bench.mill();
  strict.r_tolerance = 0.01;
  REQUIRE(bench.machine.write_tool(strict).has_value());
  CHECK(bench.run(33, check) == 0);
  CHECK(bench.host.q[5] == 1);
  CHECK(bench.host.q[199] == 1);
  CHECK(bench.mill().locked);
  CHECK(bench.run(33, {{word(ParameterId::WordCheck), 0.0},
                       {word(ParameterId::WordHeight), 200.0}}) == 0);
  CHECK(same(bench.mill().l, 99.97));
  CHECK(bench.run(31, {{word(ParameterId::WordCheck), 2.0},
                       {word(ParameterId::WordHeight), 200.0}}) == 1004);
}

TEST_CASE("TCH PROBE 30 calibrates the tool touch probe as 480 does") {
  Setup setup = mill_setup();
  setup.machine.tools.back().row.l = 99.97;
  setup.machine.tools.back().row.r = 5.988;
  TtBench dotted(setup);
  TtBench plain(setup);
  CHECK(dotted.run(30, {{word(ParameterId::WordHeight), 200.0}}) == 0);
  CHECK(plain.run(480, {{260, 200.0}}) == 0);
  CHECK(dotted.machine.state().tt.centre == plain.machine.state().tt.centre);
  CHECK(dotted.machine.state().tt.radius == plain.machine.state().tt.radius);
}

TEST_CASE("483 measures a new tool: L and R, without oversizes") {
  Setup setup = mill_setup();
  setup.machine.tools.back().row.l = 97;
  setup.machine.tools.back().row.r = 5;
  setup.machine.tools.back().row.dl = 0.5;
  TtBench bench(setup);
  CHECK(bench.run(483, {{340, 0.0}, {260, 200.0}}) == 0);
  CHECK(same(bench.mill().l, 99.97));
  CHECK(same(bench.mill().r, 5.988));
  CHECK(bench.mill().dl == 0);
  CHECK(bench.mill().dr == 0);
  CHECK(bench.host.q[199] == 0);
  CHECK_FALSE(bench.mill().locked);
}

TEST_CASE("Q340 = 2 compares and writes nothing") {
  Setup setup = mill_setup();
  setup.machine.tools.back().row.l_tolerance = 0.0299;
  TtBench bench(setup);
  const machine::Tool before = bench.mill();
  CHECK(bench.run(483, {{340, 2.0}, {260, 200.0}}) == 0);
  check_q(bench, {{115, -0.03}, {116, -0.012}});
  CHECK(bench.host.q[199] == 1);
  CHECK(bench.mill() == before);
}

TEST_CASE("wear and breakage: on the limit, beyond it, and what locks the tool") {
  struct Case {
    double l_tolerance;
    double l_breakage;
    double r_tolerance;
    double r_breakage;
    int status;
  };
  for (const Case& c :
       {Case{0.03, 0, 0.012, 0, 0}, Case{0.0299, 0, 0.012, 0, 1}, Case{0.03, 0, 0.0119, 0, 1},
        Case{0, 0.03, 0, 0.012, 0}, Case{0, 0.0299, 0, 0, 2}, Case{0, 0, 0, 0.0119, 2},
        Case{0.01, 0.02, 0.02, 0, 2}, Case{0.05, 0, 0.01, 0.011, 2}, Case{0, 0, 0, 0, 0}}) {
    CAPTURE(c.l_tolerance);
    CAPTURE(c.l_breakage);
    CAPTURE(c.r_tolerance);
    CAPTURE(c.r_breakage);
    Setup setup = mill_setup();
    machine::Tool& row = setup.machine.tools.back().row;
    row.l_tolerance = c.l_tolerance;
    row.l_breakage = c.l_breakage;
    row.r_tolerance = c.r_tolerance;
    row.r_breakage = c.r_breakage;
    TtBench bench(setup);
    CHECK(bench.run(483, kCheck) == 0);
    CHECK(bench.host.q[199] == c.status);
    CHECK(bench.mill().locked == (c.status != 0));
  }
}

TEST_CASE("Q341 touches each tooth, and needs their number") {
  TtBench bench;
  CHECK(bench.run(483, with(kCheck, {{341, 1.0}})) == 0);
  CHECK(same(bench.mill().dl, -0.03));
  CHECK(same(bench.mill().dr, -0.012));
  Setup setup = mill_setup();
  for (const int teeth : {0, 21}) {
    setup.machine.tools.back().row.teeth = teeth;
    TtBench wrong(setup);
    CHECK(wrong.run(481, with(kCheck, {{341, 1.0}})) == 1109);
    CHECK(wrong.run(482, with(kCheck, {{341, 1.0}})) == 1109);
  }
}

TEST_CASE("R-OFFS puts the edge over the plate, L-OFFS the depth of the side") {
  Setup setup = mill_setup();
  machine::ToolSetup& mill = setup.machine.tools.back();
  mill.row.r = 32;
  mill.actual_radius = 31.99;
  mill.row.r_offset = 32;
  mill.row.l_offset = 4;
  TtBench bench(setup);
  CHECK(bench.run(483, kCheck) == 0);
  CHECK(same(bench.mill().dl, -0.03));
  CHECK(same(bench.mill().dr, -0.01));
  mill.row.r_offset = 60;
  TtBench beside(setup);
  CHECK(beside.run(481, kCheck) == 1014);
}

TEST_CASE("the clearance height is that of the preset, and never so low that the tool touches") {
  Setup setup = mill_setup();
  setup.machine.presets[0].frame.origin = {10, 20, 30};
  TtBench bench(setup);
  CHECK(bench.run(481, {{340, 1.0}, {260, 100.0}}) == 0);
  CHECK(std::abs(bench.machine.state().nose.linear.z - (130 + 100)) < 1e-9);
  CHECK(bench.run(481, {{340, 1.0}, {260, -100.0}}) == 0);
  CHECK(same(bench.mill().dl, -0.03));
  // 5 mm over the plate at 50, by the length that the control knows now.
  CHECK(std::abs(bench.machine.state().nose.linear.z - (50 + 5 + 99.97)) < 1e-9);
}

TEST_CASE("480 finds centre and radius of the TT, and tools are right after it") {
  for (const auto shape : {machine::ContactPlate::Disc, machine::ContactPlate::Cube}) {
    Setup setup = mill_setup();
    setup.machine.tt.known.shape = shape;
    setup.machine.tt.actual_centre = Vec3{300.4, -0.3, 50.12};
    setup.machine.tt.actual_radius = 19.95;
    setup.machine.tools.push_back(tool_of(99, 80, 5));
    TtBench bench(setup);
    CHECK(bench.run(481, {{340, 2.0}, {260, 200.0}}) == 0);
    CHECK(same(bench.host.q[115], -0.03 + 0.12));  // the TT is higher than the control knows
    bench.call(99);
    CHECK(bench.run(480, {{260, 200.0}}) == 0);
    const machine::ToolTouchProbe& tt = bench.machine.state().tt;
    CHECK(norm(tt.centre - Vec3{300.4, -0.3, 50.12}) < 2e-6);
    CHECK(std::abs(tt.radius - 19.95) < 2e-6);
    bench.call(5);
    CHECK(bench.run(483, kCheck) == 0);
    CHECK(std::abs(bench.mill().dl + 0.03) < 2e-6);
    CHECK(std::abs(bench.mill().dr + 0.012) < 2e-6);
  }
}

TEST_CASE("484 calibrates the TT from where the tool stands") {
  Setup setup;
  setup.machine.tt.actual_centre = Vec3{-250, 120, 80};
  setup.machine.tools.push_back(tool_of(5, 80, 5));
  TtBench bench(setup);
  REQUIRE(bench.machine.move({machine::AxisWords::linear({-248, 121, 100}), {}}).has_value());
  CHECK(bench.run(484, {{536, 1.0}}) == 0);
  CHECK(bench.host.stops.empty());
  CHECK(norm(bench.machine.state().tt.centre - Vec3{-250, 120, 80}) < 2e-6);
  CHECK(std::abs(bench.machine.state().tt.radius - 20) < 2e-6);
  CHECK(norm(bench.machine.position().linear - Vec3{-250, 120, 100}) < 1e-5);
  CHECK(bench.run(484, {{536, 0.0}}) == 0);
  CHECK(bench.host.stops.size() == 1);
  REQUIRE(bench.machine.move({machine::AxisWords::linear({0, 0, 100}), {}}).has_value());
  CHECK(bench.run(484, {{536, 1.0}}) == 1014);
}

TEST_CASE("tool measurement: a mode there is not, and a tool that touches too early") {
  TtBench bench;
  CHECK(bench.run(481, {{340, 3.0}, {260, 200.0}}) == 1004);
  Setup setup = mill_setup();
  setup.machine.tools.back().actual_length = 110;  // touches before the cycle begins
  TtBench longer(setup);
  CHECK(longer.run(481, kCheck) == -1);
}

}  // namespace fitgauge::probing
