#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

const machine::Block kClampedPlate{.min = {0, 0, -40}, .max = {100, 80, 0}};

struct BesideThePlate : ProbingBench {
  BesideThePlate() : ProbingBench({kClampedPlate}) {
    move(machine::Axis::X, -10);
    move(machine::Axis::Y, 40);
    move(machine::Axis::Z, -5);
  }
};

}  // namespace

TEST_CASE("TCH PROBE 0 gives the compensated coordinate and comes back to its position") {
  ProbingBench bench({kClampedPlate});
  CHECK(bench.run(0, values("result=5 axis=2 direction=-1 X=50 Y=40 Z=5")) == 0);
  CHECK(same(bench.host.q[5], 0));
  CHECK(bench.machine.position().linear == machine::Vec3{50, 40, 5});
  CHECK(same(bench.host.q[117], 120));
  CHECK(bench.host.files.empty());
  CHECK(bench.host.records.empty());

  BesideThePlate side;
  CHECK(side.run(0, values("result=5 axis=0 direction=1 X=-8")) == 0);
  check_q(side, {{5, 0}, {115, -2}});
  CHECK(side.run(0, values("result=5 axis=0 direction=-1")) == 1014);
  CHECK(side.run(0, values("result=5 axis=0 direction=0")) == 1042);
}

TEST_CASE("TCH PROBE 1 touches at an angle from its axis") {
  BesideThePlate bench;
  CHECK(bench.run(1, values("axis=0 angle=30")) == 0);
  CHECK(same(bench.host.q[115], -2));
  CHECK(std::abs(bench.host.q[116] - (40 + 8 * std::tan(machine::radians(30)))) < 1e-6);
}

TEST_CASE("TCH PROBE 3 gives the uncompensated position, or -1 without contact") {
  BesideThePlate bench;
  const Values block = values("result=1 axis=0 angle=0 distance=10 feed=100 retract=1");
  CHECK(bench.run(3, block) == 0);
  check_q(bench, {{1, -2}, {2, 40}, {3, -5}});
  CHECK(bench.host.q[4] == 0);
  CHECK(same(bench.machine.position().linear.x, -3));
  CHECK(bench.run(3, with(block, values("system=1"))) == 0);
  CHECK(same(bench.host.q[3], 115));
  CHECK(bench.run(3, with(block, values("distance=0.5"))) == 1014);
  CHECK(bench.run(3, with(block, values("distance=0.4 error-mode=1"))) == 0);
  CHECK(bench.host.q[4] == -1);
}

TEST_CASE("TCH PROBE 4 touches along a vector and goes on without contact") {
  BesideThePlate bench;
  const Values block = values("result=20 X=3 Y=4 distance=45 feed=100");
  CHECK(bench.run(4, block) == 0);
  CHECK(same(bench.host.q[20], -2));
  CHECK(std::abs(bench.host.q[21] - (40 + 8 * 4.0 / 3)) < 1e-6);
  CHECK(bench.host.q[23] == 0);
  CHECK(bench.run(4, with(block, values("X=-3"))) == 0);
  CHECK(bench.host.q[23] == -1);
  CHECK(bench.run(4, with(block, values("X=0 Y=0"))) == 1042);
}

TEST_CASE("441 changes how later cycles position, until the program ends") {
  const Values block{{263, 50.0}, {264, 40.0}, {261, 0.0}, {272, 3.0}, {267, -1.0}, {260, 300.0}};
  const auto seconds = [&](const Values& fast) {
    ProbingBench bench({kClampedPlate});
    if (!fast.empty()) CHECK(bench.run(441, fast) == 0);
    CHECK(bench.run(427, block) == 0);
    return bench.machine.state().elapsed_s;
  };
  const double usual = seconds({});
  CHECK(seconds({{397, 1.0}}) < usual);
  CHECK(seconds({{396, 500.0}}) > usual);
  CHECK(seconds({{396, 0.0}}) == usual);
  ProbingBench bench({kClampedPlate});
  CHECK(bench.run(441, {{396, 500.0}, {400, 0.0}}) == 0);
  CHECK_FALSE(bench.host.cycle_memory.fast_probing.interrupts);
  bench.host.cycle_memory.end_program();
  CHECK(bench.host.cycle_memory.fast_probing.interrupts);
  CHECK(bench.host.cycle_memory.fast_probing.positioning_feed == 0);
}

}  // namespace fitgauge::probing
