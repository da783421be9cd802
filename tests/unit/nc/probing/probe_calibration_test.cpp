#include <doctest/doctest.h>

#include "probing_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::Block;
using machine::Boss;
using machine::CalibrationRing;
using machine::Setup;
using machine::Vec3;

constexpr double kRadius = 1.9963;  // of the real ball, 2 in the tool table
constexpr double kLength = 120.25;  // nose to the ball's south pole, 120 in the table
constexpr double kOffsetMain = 0.013;
constexpr double kOffsetSecondary = -0.021;
constexpr double kPretravel = 0.004;

/// A probe that is not as its tables say, and what it is calibrated against and then measures.
Setup deviating_setup() {
  Setup setup;
  setup.machine.tools[0].actual_radius = kRadius;
  setup.machine.tools[0].actual_length = kLength;
  setup.machine.probes[0].centre_offset = {kOffsetMain, kOffsetSecondary};
  setup.machine.probes[0].pretravel_um = kPretravel * 1000;
  setup.machine.calibration_ring = CalibrationRing{{-200, 100}, 0, 20, 50, {}};
  setup.machine.calibration_stud = Boss{{-200, -100}, 30, 30, 40};
  setup.machine.calibration_sphere = machine::CalibrationSphere{{-200, 0, 60}, 12.5};
  machine::Bore bore;
  bore.centre = {100.02, 79.97};
  bore.depth = 30;
  bore.diameter = 25.013;
  setup.features = {Block{{0, 0, -40}, {200, 160, 0}}, bore};
  return setup;
}

/// Moves the tip there: first up, then across, then down.
void stand_at(ProbingBench& bench, const Vec3& tip) {
  for (const Vec3& target :
       {Vec3{bench.machine.position().linear.x, bench.machine.position().linear.y, 200},
        Vec3{tip.x, tip.y, 200}, tip}) {
    REQUIRE(bench.machine.move({machine::AxisWords::linear(target), {}}).has_value());
  }
}

/// The bore of the setup, whose values only a calibrated probe finds.
void measure_bore(ProbingBench& bench) {
  stand_at(bench, {100, 80, 20});
  REQUIRE(bench.run(421, values("273=100 274=80 262=25 247=90 261=-10 260=20")) == 0);
}
void check_bore(ProbingBench& bench) {
  measure_bore(bench);
  CHECK(std::abs(bench.host.q[151] - 100.02) < 2e-6);
  CHECK(std::abs(bench.host.q[152] - 79.97) < 2e-6);
  CHECK(std::abs(bench.host.q[153] - 25.013) < 2e-6);
}

void check_probe(const ProbingBench& bench, double main, double secondary) {
  const machine::ProbeSystem probe = *bench.machine.state().probe_system();
  CHECK(std::abs(probe.radius - (kRadius - kPretravel)) < 2e-6);
  CHECK(std::abs(probe.data.cal_of1 - main) < 2e-6);
  CHECK(std::abs(probe.data.cal_of2 - secondary) < 2e-6);
}

}  // namespace

TEST_CASE("without calibration the deviations of the probe falsify a measurement") {
  ProbingBench bench(deviating_setup());
  measure_bore(bench);
  CHECK(std::abs(bench.host.q[151] - (100.02 - kOffsetMain)) < 1e-4);
  CHECK(std::abs(bench.host.q[152] - (79.97 - kOffsetSecondary)) < 1e-4);
  CHECK(std::abs(bench.host.q[153] - (25.013 + 2 * (2 - kRadius + kPretravel))) < 1e-4);
}

TEST_CASE("462 in a ring: the bore measured after it is right") {
  for (const double touches : {3.0, 4.0, 8.0}) {
    ProbingBench bench(deviating_setup());
    stand_at(bench, {-200.3, 100.2, -12});
    CHECK(bench.run(462, {{407, 25.0}, {320, 1.0}, {423, touches}, {380, 15.0}}) == 0);
    check_probe(bench, kOffsetMain, kOffsetSecondary);
    CHECK(bench.machine.state().probe_system()->length == 120);
    CHECK(bench.machine.state().modes.spindle_deg == 0);
    CHECK(bench.host.touches.size() == static_cast<std::size_t>(3 * touches));
    check_bore(bench);
  }
}

TEST_CASE("463 on a stud: the bore measured after it is right") {
  for (const double via_clearance : {0.0, 1.0}) {
    ProbingBench bench(deviating_setup());
    stand_at(bench, {-199.8, -100.3, 33});  // SET_UP 2 and Q320 1 above the stud
    CHECK(bench.run(463, {{407, 20.0}, {320, 1.0}, {301, via_clearance}}) == 0);
    check_probe(bench, kOffsetMain, kOffsetSecondary);
    CHECK(std::abs(bench.machine.position().linear.z - 33) < 1e-9);
    check_bore(bench);
  }
}

TEST_CASE("460 on a sphere finds radius, offset and length") {
  for (const double touches : {3.0, 5.0}) {
    ProbingBench bench(deviating_setup());
    stand_at(bench, {-200.2, 0.3, 80});
    const Values block{{407, 12.5}, {320, 1.0}, {423, touches}, {380, 40.0}};
    CHECK(bench.run(460, block) == 0);
    check_probe(bench, kOffsetMain, kOffsetSecondary);
    CHECK(bench.machine.state().probe_system()->length == 120);
    stand_at(bench, {-200.2, 0.3, 80});
    CHECK(bench.run(460, with(block, {{433, 1.0}, {434, 60.0}})) == 0);
    check_probe(bench, kOffsetMain, kOffsetSecondary);
    CHECK(std::abs(bench.machine.state().probe_system()->length - (kLength - kPretravel)) < 3e-6);
    check_bore(bench);
    stand_at(bench, {20, 20, 10});
    CHECK(bench.run(427, values("263=20 264=20 261=0 272=3 267=-1 260=20")) == 0);
    CHECK(std::abs(bench.host.q[160]) < 3e-6);
  }
}

TEST_CASE("461 on the ring: the effective length, and Q160 of a face after it") {
  ProbingBench bench(deviating_setup());
  stand_at(bench, {-200 + 35, 100, 5});
  const Vec3 before = bench.machine.position().linear;
  CHECK(bench.run(461, {{434, 0.0}}) == 0);
  CHECK(std::abs(bench.machine.state().probe_system()->length - (kLength - kPretravel)) < 2e-6);
  CHECK(bench.machine.state().probe_system()->radius == 2);
  CHECK(norm(bench.machine.state().nose.linear - Vec3{before.x, before.y, before.z + 120}) < 1e-9);
  stand_at(bench, {20, 20, 10});
  CHECK(bench.run(427, values("263=20 264=20 261=0 272=3 267=-1 260=20")) == 0);
  CHECK(std::abs(bench.host.q[160]) < 2e-6);
}

TEST_CASE("a second calibration changes nothing, the oversizes of table and call are respected") {
  ProbingBench bench(deviating_setup());
  machine::Tool tool = *bench.machine.state().active_tool();
  tool.dr = 0.1;
  tool.dl = 0.2;
  REQUIRE(bench.machine.write_tool(tool).has_value());
  REQUIRE(bench.machine
              .call_tool({.number = 30, .axis = Axis::Z, .spindle_rpm = {}, .dl = 0.3, .dr = -0.05})
              .has_value());
  for (int time = 0; time < 2; ++time) {
    stand_at(bench, {-200, 100, -12});
    CHECK(bench.run(462, {{407, 25.0}}) == 0);
    check_probe(bench, kOffsetMain, kOffsetSecondary);
  }
  stand_at(bench, {-200 + 35, 100, 5});
  CHECK(bench.run(461, {{434, 0.0}}) == 0);
  CHECK(std::abs(bench.machine.state().probe_system()->length - (kLength - kPretravel)) < 2e-6);
  CHECK(bench.machine.state().active_tool()->dr == 0);
  CHECK(bench.machine.state().active_tool()->dl == 0);
}

TEST_CASE("the offset is that of the machine's axes, however the coordinates are turned") {
  ProbingBench bench(deviating_setup());
  machine::Frames frames;
  frames.set_preset(
      {.origin = {-200, 100, 0}, .basic_rotation_deg = {0, 0, 30}, .rotary_offsets_deg = {}});
  REQUIRE(bench.machine.set_frames(frames).has_value());
  stand_at(bench, {0.1, 0.2, -12});
  CHECK(bench.run(462, {{407, 25.0}}) == 0);
  check_probe(bench, kOffsetMain, kOffsetSecondary);
}

TEST_CASE("an offset that was calibrated at another spindle angle is given for 0") {
  ProbingBench bench(deviating_setup());
  machine::ProbeRow row = *bench.machine.state().probes.find(1);
  row.cal_of1 = -kOffsetSecondary;  // the real offset, seen with the spindle turned by 90 degrees
  row.cal_of2 = kOffsetMain;
  row.cal_ang = 90;
  REQUIRE(bench.machine.write_probe(row).has_value());
  stand_at(bench, {-200, 100, -12});
  CHECK(bench.run(462, {{407, 25.0}}) == 0);
  check_probe(bench, kOffsetMain, kOffsetSecondary);
  CHECK(bench.machine.state().probes.find(1)->cal_ang == 0);
}

TEST_CASE("scatter of the probe shows as distance from the circle and hardly in the result") {
  Setup setup = deviating_setup();
  setup.machine.probes[0].repeatability_um = 1;
  ProbingBench bench(setup);
  stand_at(bench, {-200, 100, -12});
  CHECK(bench.run(462, {{407, 25.0}, {423, 8.0}}) == 0);
  CHECK(std::abs(bench.machine.state().probe_system()->radius - (kRadius - kPretravel)) < 0.002);
}

TEST_CASE("calibration is logged in TCHPRAUTO.html, one section each") {
  ProbingBench bench(deviating_setup());
  stand_at(bench, {-200, 100, -12});
  CHECK(bench.run(462, {{407, 25.0}}) == 0);
  stand_at(bench, {-200 + 35, 100, 5});
  CHECK(bench.run(461, {{434, 0.0}}) == 0);
  const std::string& log = bench.host.files.at("TCHPRAUTO.html");
  CHECK(log.starts_with("<!DOCTYPE html>"));
  CHECK(log.find("<!DOCTYPE", 1) == std::string::npos);
  CHECK(log.find("<tr><th scope=\"row\">Effective ball radius</th><td>2.0000</td><td>1.9923</td>"
                 "<td>-0.0077</td></tr>") != std::string::npos);
  CHECK(log.find("CAL_OF1</th><td>0.0000</td><td>0.0130</td>") != std::string::npos);
  CHECK(log.find("CAL_OF2</th><td>0.0000</td><td>-0.0210</td>") != std::string::npos);
  CHECK(log.find("Effective length</th><td>120.0000</td><td>120.2460</td>") != std::string::npos);
}

TEST_CASE("calibration: errors of parameters and place") {
  ProbingBench bench(deviating_setup());
  stand_at(bench, {-200, 100, -12});
  CHECK(bench.run(462, {{407, 0.0}}) == 1004);
  CHECK(bench.run(462, {{407, 100.0}}) == 1004);
  CHECK(bench.run(462, {{407, 25.0}, {423, 2.0}}) == 1004);
  CHECK(bench.run(462, {{407, 25.0}, {423, 9.0}}) == 1004);
  CHECK(bench.run(462, {{407, 25.0}, {380, -1.0}}) == 1004);
  CHECK(bench.run(462, {}) == 1017);
  CHECK(bench.run(462, {{407, 22.0}}) == 1080);  // the ball would have a negative radius
  CHECK(bench.machine.state().probe_system()->radius == 2);
  CHECK(bench.machine.state().probes.find(1)->cal_of1 == 0);
  stand_at(bench, {-300, 100, 50});
  CHECK(bench.run(462, {{407, 25.0}}) == 1014);
  CHECK(bench.run(461, {{434, 0.0}}) == 1014);
  CHECK(bench.machine.state().modes.spindle_deg == 0);
}

}  // namespace fitgauge::probing
