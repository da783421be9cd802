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

}  // namespace

TEST_CASE("427 in the probe axis: the surface, whether Q261 names it or the ball centre on it") {
  for (const double q261 : {0.0, 2.0, 1.0}) {
    ProbingBench bench({kRaisedPlate});
    CHECK(bench.run(427, with(top_block(), {{261, q261}})) == 0);
    CHECK(same(bench.host.q[160], 0.013));
    CHECK(same(bench.host.q[168], 0.013 - q261));
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

}  // namespace fitgauge::probing
