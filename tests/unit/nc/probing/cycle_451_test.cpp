#include <doctest/doctest.h>

#include "kinematics_bench.hpp"
#include "nc/probing/cycle_host.hpp"
#include "nc/probing/kinematics/measurement.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::RotaryAxis;
using machine::Setup;
using machine::Vec3;

const RotaryAxis& model_of(const ProbingBench& bench, Axis axis) {
  return *bench.machine.state().kinematics.find(axis);
}

/// A and C over wide ranges.
Values both_axes(double points) {
  return with(with(kinematics_block(), measured(Axis::A, -90, 90, points)),
              measured(Axis::C, -90, 180, points));
}

/// How far a modelled axis lies from the real one at the height of the sphere, in mm.
double distance(const ProbingBench& bench, const Setup& setup, Axis axis) {
  const RotaryAxis real = setup.machine.axes[index(axis)]->built(axis);
  const Vec3 on_real = point_of(real, kSphere);
  return norm(point_of(model_of(bench, axis), on_real) - on_real);
}

}  // namespace

TEST_CASE("measuring positions are evenly spaced") {
  CHECK(measuring_positions(90, -90, 4, 0) == std::vector<double>{90, 30, -30, -90});
  CHECK(measuring_positions(90, 270, 4, 0) == std::vector<double>{90, 150, 210, 270});
  CHECK(measuring_positions(45, 90, 1, 0) == std::vector<double>{45});
  CHECK(measuring_positions(45, 90, 0, 0).empty());
}

TEST_CASE("a Hirth axis is measured on its grid") {
  CHECK(measuring_positions(-30, 90, 4, 3) == std::vector<double>{-30, 9, 51, 90});
  // Of two teeth that are equally near the one away from zero.
  CHECK(measuring_positions(-1.5, 1.5, 2, 3) == std::vector<double>{-3, 3});
  // Decimal grids have exact ties, too: -56.55 and ±0.1.
  CHECK(measuring_positions(-51, -62.1, 11, 0.1)[5] == doctest::Approx(-56.6).epsilon(1e-12));
  CHECK(measuring_positions(-0.3, 0.3, 4, 0.2) ==
        std::vector<double>{-2 * 0.2, -0.2, 0.2, 2 * 0.2});
}

TEST_CASE("a machine that is as modelled has no errors") {
  const Setup setup = trunnion();
  for (const double touches : {3.0, 4.0, 8.0}) {
    SphereBench bench(setup);
    const machine::Kinematics before = bench.machine.state().kinematics;
    REQUIRE(bench.run(451, with(both_axes(4), {{406, 2.0}, {423, touches}})) == 0);
    CHECK(bench.host.q[142] == -1);
    CHECK(bench.host.q[145] == -1);
    for (const int q : {141, 143, 144, 146, 147, 148, 149}) CHECK(same(bench.host.q[q], 0));
    for (const Axis axis : {Axis::A, Axis::C}) {
      CHECK(norm(model_of(bench, axis).centre - before.find(axis)->centre) < 1e-9);
      CHECK(norm(model_of(bench, axis).direction - before.find(axis)->direction) < 1e-10);
    }
    CHECK(bench.machine.state().nose.rotary == Vec3{});
  }
}

TEST_CASE("checking finds the errors of the axes and leaves the model as it is") {
  const Setup setup = with_location_errors();
  SphereBench bench(setup);
  const machine::Kinematics before = bench.machine.state().kinematics;
  REQUIRE(bench.run(451, with(both_axes(4), {{406, 0.0}})) == 0);
  CHECK(bench.machine.state().kinematics == before);
  CHECK(bench.host.q[141] > 0.01);
  CHECK(bench.host.q[143] > 0.01);
  check_q(bench, {{144, 0}, {146, 0}});
  // Of C, the axis measured last.
  check_q(bench, {{147, -0.02}, {148, 0.05}, {149, 0}});
  CHECK(contains(log_of(bench, 451), "X 0.0000, Y 0.0400, Z -0.0300"));
  CHECK(contains(log_of(bench, 451), "X -0.0200, Y 0.0500, Z 0.0000"));
}

TEST_CASE("after optimising a second measurement finds nothing more") {
  const Setup setup = with_location_errors();
  SphereBench bench(setup);
  REQUIRE(bench.run(451, with(both_axes(4), {{406, 1.0}})) == 0);
  CHECK(distance(bench, setup, Axis::A) < 1e-8);
  CHECK(distance(bench, setup, Axis::C) < 1e-8);
  REQUIRE(bench.run(451, both_axes(4)) == 0);
  for (const int q : {141, 143, 144, 146, 147, 148, 149}) CHECK(same(bench.host.q[q], 0));
}

TEST_CASE("the zero of an axis that carries another is corrected in mode 3 alone") {
  for (const machine::AxisMount mount : {machine::AxisMount::Table, machine::AxisMount::Head}) {
    CAPTURE(mount == machine::AxisMount::Table);
    const bool is_table = mount == machine::AxisMount::Table;
    const Axis carrier = is_table ? Axis::A : Axis::C;
    const Axis carried = is_table ? Axis::C : Axis::A;
    machine::Setup setup = trunnion();
    for (const Axis axis : {Axis::A, Axis::C}) {
      machine::AxisSetup& real = *setup.machine.axes[index(axis)];
      real.mount = mount;
      real.centre = is_table ? real.centre : machine::Vec3{};
    }
    setup.machine.axes[index(carrier)]->zero_error_deg = 0.03;
    setup.machine.axes[index(carried)]->centre_error = {0.02, -0.01, 0.015};
    Values block = with(kinematics_block(), measured(Axis::A, -50, 60, 5));
    block = with(block, measured(Axis::C, -80, 100, 5));
    block = with(block, {{413, 25.0}, {421, 30.0}});
    for (const double mode : {2.0, 3.0}) {
      CAPTURE(mode);
      SphereBench bench(setup);
      REQUIRE(bench.run(451, with(block, {{406, mode}})) == 0);
      const machine::Kinematics& found = bench.machine.state().kinematics;
      const machine::RotaryAxis modelled = machine::AxisSetup::of(carried).modelled(carried);
      const double leans =
          machine::degrees(norm(found.find(carried)->direction - modelled.direction));
      CHECK(found.find(carrier)->zero_deg == doctest::Approx(mode == 3 ? 0.03 : 0).epsilon(1e-5));
      CHECK(std::abs(leans - (mode == 3 ? 0 : 0.03)) < 1e-6);
      CHECK(found.find(carried)->zero_deg == 0);
      REQUIRE(bench.run(451, with(block, {{406, 0.0}})) == 0);
      for (const int q : {141, 143}) CHECK(bench.host.q.at(q) < 2e-6);
    }
  }
}

TEST_CASE("directions are corrected in mode 2 alone") {
  Setup setup = trunnion();
  setup.machine.axes[index(Axis::A)]->tilt_error_deg = {0, 0.02, -0.01};
  setup.machine.axes[index(Axis::C)]->tilt_error_deg = {-0.015, 0.01, 0};
  SphereBench first(setup);
  REQUIRE(first.run(451, with(both_axes(4), {{406, 1.0}})) == 0);
  CHECK(model_of(first, Axis::A).direction == Vec3{1, 0, 0});
  CHECK(first.host.q[144] > 1e-3);
  SphereBench second(setup);
  REQUIRE(second.run(451, with(both_axes(4), {{406, 2.0}})) == 0);
  CHECK(same(second.host.q[144], 0));
  for (const Axis axis : {Axis::A, Axis::C}) {
    const RotaryAxis real = setup.machine.axes[index(axis)]->built(axis);
    CHECK(norm(model_of(second, axis).direction - real.direction) < 1e-10);
    CHECK(distance(second, setup, axis) < 1e-8);
  }
  CHECK(contains(log_of(second, 451), "X -0.0150, Y 0.0100, Z 0.0000"));
}

TEST_CASE("a head is measured like a table") {
  Setup setup = sphere_setup();
  machine::AxisSetup& head = add_axis(setup, Axis::B);
  head.mount = machine::AxisMount::Head;
  head.centre_error = {0.03, 0, -0.05};
  head.tilt_error_deg = {0.01, 0, 0.02};
  SphereBench bench(setup);
  set_tcpm(bench.machine, true);
  const Values block =
      with(with(kinematics_block(), measured(Axis::B, -60, 60, 5)), {{406, 2.0}, {408, 0.0}});
  REQUIRE(bench.run(451, block) == 0);
  check_q(bench, {{147, 0.03}, {148, 0}, {149, -0.05}});
  CHECK(bench.host.q[142] > 0.01);
  CHECK(same(bench.host.q[145], 0));
  CHECK(norm(model_of(bench, Axis::B).direction - head.built(Axis::B).direction) < 1e-9);
}

TEST_CASE("the other axes stand at their angle of incidence") {
  const Setup setup = with_location_errors();
  SphereBench bench(setup);
  const Values block = with(both_axes(4), {{406, 2.0}, {413, 30.0}, {421, -45.0}});
  REQUIRE(bench.run(451, block) == 0);
  CHECK(distance(bench, setup, Axis::A) < 1e-8);
  CHECK(distance(bench, setup, Axis::C) < 1e-8);
  bool inclined = false;
  for (const auto& touch : bench.host.touches) {
    inclined = inclined || touch.nose.rotary == Vec3{30, 0, 180};
  }
  CHECK(inclined);
}

TEST_CASE("a turned preset gives the same results") {
  Setup setup = with_location_errors();
  setup.machine.presets.front().frame.basic_rotation_deg = {0, 0, 30};
  SphereBench bench(setup);
  REQUIRE(bench.run(451, with(both_axes(4), {{380, 17.0}})) == 0);
  check_q(bench, {{147, -0.02}, {148, 0.05}, {144, 0}});
}

TEST_CASE("of one position the error is known, and no direction is invented") {
  const Setup setup = with_location_errors();
  SphereBench bench(setup);
  const Values block = with(with(kinematics_block(), measured(Axis::C, 180, 0, 1)), {{406, 2.0}});
  REQUIRE(bench.run(451, block) == 0);
  // Half a turn shows the location error twice.
  check_q(bench, {{143, to_length(2 * std::hypot(0.02, 0.05)).to_mm()}, {146, 0}, {147, -0.02}});
  CHECK(model_of(bench, Axis::C).direction == Vec3{0, 0, 1});
  CHECK(contains(log_of(bench, 451), "cannot see the direction"));
  CHECK(contains(log_of(bench, 451), "Measured error of the position"));
}

TEST_CASE("what the positions cannot see is left as it is") {
  const Setup setup = with_location_errors();
  SphereBench bench(setup);
  const machine::Kinematics before = bench.machine.state().kinematics;
  const Values block =
      with(with(kinematics_block(), measured(Axis::C, 0, 359.9999, 2)), {{406, 2.0}});
  REQUIRE(bench.run(451, block) == 0);
  CHECK(bench.machine.state().kinematics == before);
  CHECK(contains(log_of(bench, 451), "cannot see the location"));
  for (const int q : {147, 148, 149}) CHECK(bench.host.q[q] == 0);
}

TEST_CASE("a narrow range is called poor") {
  SphereBench bench(with_location_errors());
  const auto block = [](double range) {
    return with(kinematics_block(), measured(Axis::A, -range, range, 4));
  };
  REQUIRE(bench.run(451, block(10)) == 0);
  CHECK(contains(log_of(bench, 451), "Poor positions"));
  CHECK_FALSE(contains(log_of(bench, 451), "Usable positions"));
  REQUIRE(bench.run(451, block(90)) == 0);
  CHECK(contains(log_of(bench, 451), "Usable positions"));
}

TEST_CASE("backlash is measured from both sides of each position") {
  Setup setup = trunnion();
  setup.machine.axes[index(Axis::C)]->backlash_deg = 0.01;
  for (const double angle : {2.0, -2.0}) {
    SphereBench bench(setup);
    const Values block =
        with(with(kinematics_block(), measured(Axis::C, -60, 120, 3)), {{432, angle}});
    REQUIRE(bench.run(451, block) == 0);
    CHECK(
        contains(log_of(bench, 451), "<th scope=\"row\">Backlash in degrees</th><td>0.0100</td>"));
    CHECK(same(bench.host.q[143], 0));
  }
  setup.machine.axes[index(Axis::C)]->hirth_grid_deg = 5;
  SphereBench bench(setup);
  REQUIRE(bench.run(451, with(with(kinematics_block(), measured(Axis::C, -60, 120, 3)),
                              {{432, 2.0}})) == 0);
  CHECK(contains(log_of(bench, 451), "not possible on a Hirth axis"));
}

TEST_CASE("with TCPM the probe circles the sphere instead of retracting") {
  const Setup setup = with_location_errors();
  SphereBench retracting(setup);
  REQUIRE(retracting.run(451, both_axes(4)) == 0);
  SphereBench circling(setup);
  set_tcpm(circling.machine, true);
  REQUIRE(circling.run(451, with(both_axes(4), {{408, 0.0}})) == 0);
  for (int q = 141; q <= 149; ++q) CHECK(same(circling.host.q[q], retracting.host.q[q]));
  CHECK_FALSE(circling.machine.state().modes.tcpm);
}

TEST_CASE("Q408 = 0 needs the option of TCPM and no Hirth axis, a height must clear the sphere") {
  Setup setup = trunnion();
  SphereBench bench(setup);
  CHECK(bench.run(451, with(both_axes(3), {{408, 10.0}})) == 1082);
  // The option is there, whether TCPM is active or not.
  CHECK(bench.run(451, with(both_axes(3), {{408, 0.0}})) == 0);
  setup.machine.kinematics_options.tcpm = false;
  SphereBench without(setup);
  CHECK(without.run(451, with(both_axes(3), {{408, 0.0}})) == 1082);
  machine::Modes modes = without.machine.state().modes;
  modes.tcpm = true;
  CHECK(without.machine.set_modes(modes).error().number == 1095);
  setup.machine.kinematics_options.tcpm = true;
  setup.machine.axes[index(Axis::A)]->hirth_grid_deg = 3;
  SphereBench hirth(setup);
  set_tcpm(hirth.machine, true);
  CHECK(hirth.run(451, with(both_axes(3), {{408, 0.0}})) == 1082);
}

TEST_CASE("Q431 sets the preset into the sphere") {
  for (const double when : {0.0, 1.0, 2.0, 3.0}) {
    CAPTURE(when);
    Setup setup = with_location_errors();
    const Vec3 rough = kSphere + Vec3{0.3, -0.2, 0.5};
    setup.machine.presets.front().frame.origin = rough;
    SphereBench bench(setup);
    // The preset before is found where the probe stands, so the tip is over the sphere.
    REQUIRE(bench.machine
                .move({machine::AxisWords::linear(kSphere + Vec3{0.5, 0.5, 30}),
                       {},
                       machine::CoordinateSystem::Machine})
                .has_value());
    REQUIRE(bench.run(451, with(both_axes(4), {{406, 2.0}, {431, when}})) == 0);
    const Vec3 origin = bench.machine.state().presets.find(1)->frame.origin;
    const Vec3 expected = when == 0 ? rough : kSphere;
    for (std::size_t k = 0; k < 3; ++k) CHECK(same(origin[k], expected[k]));
    CHECK(bench.machine.state().frames.preset().origin == origin);
    CHECK(distance(bench, setup, Axis::C) < 1e-8);
  }
}

TEST_CASE("a preset before finds the sphere with the axes anywhere") {
  const Setup setup = trunnion();
  ProbingBench bench(setup);
  bench.move(Axis::A, 20);
  bench.move(Axis::C, 70);
  const Vec3 there = bench.machine.state().kinematics.table({20, 0, 70}).point(kSphere);
  REQUIRE(bench.machine
              .move({machine::AxisWords::linear(there + Vec3{0, 0, 25}),
                     {},
                     machine::CoordinateSystem::Machine})
              .has_value());
  REQUIRE(bench.run(451, with(both_axes(3), {{431, 1.0}})) == 0);
  CHECK(norm(bench.machine.state().frames.preset().origin - kSphere) < 1e-6);
}

TEST_CASE("errors of 451") {
  Setup setup = trunnion();
  SphereBench bench(setup);
  CHECK(bench.run(451, with(both_axes(3), {{411, -150.0}})) == 1101);
  CHECK(bench.fault.text.find("A-150.0000") != std::string::npos);
  CHECK(bench.run(451, with(both_axes(3), {{413, 130.0}})) == 1101);
  CHECK(bench.run(451, with(both_axes(3), {{412, 119.0}, {432, 2.0}})) == 1101);
  CHECK(bench.run(451, with(both_axes(3), {{414, 13.0}})) == 1004);
  CHECK(bench.run(451, with(both_axes(3), {{423, 2.0}})) == 1004);
  CHECK(bench.run(451, with(both_axes(3), {{406, 4.0}})) == 1004);
  CHECK(bench.run(451, with(both_axes(3), {{432, 3.5}})) == 1004);
  CHECK(bench.run(451, with(both_axes(3), {{407, 14.8}})) == 1072);
  CHECK(bench.host.files.empty());
  CHECK_FALSE(bench.host.q.contains(141));
  setup.machine.presets.front().locked = true;
  SphereBench locked(setup);
  for (const double when : {0.0, 1.0, 2.0, 3.0}) {
    CAPTURE(when);
    CHECK(locked.run(451, with(both_axes(3), {{431, when}})) == (when == 0 ? 0 : 1085));
  }
  setup.machine.axes[0]->max = 75;
  SphereBench narrow(setup);
  CHECK(narrow.run(451, both_axes(3)) == 1101);
}

TEST_CASE("what 451 promises for a fork head is what the next check finds") {
  // Heads A and C; A has to stand inclined while C is measured, since the ball would lie on C.
  Setup setup = sphere_setup();
  for (const Axis axis : {Axis::A, Axis::C}) {
    machine::AxisSetup& head = add_axis(setup, axis);
    head.mount = machine::AxisMount::Head;
    head.centre = {};
  }
  setup.machine.axes[index(Axis::A)]->centre_error = {0, 0.03, 0.05};
  SphereBench bench(setup);
  const Values block = with(
      with(with(kinematics_block(), measured(Axis::A, -60, 60, 4)), measured(Axis::C, 60, 300, 5)),
      {{408, 100.0}, {413, 20.0}, {421, 0.0}});
  REQUIRE(bench.run(451, with(block, {{406, 1.0}})) == 0);
  for (const int q : {144, 146}) CHECK(same(bench.host.q[q], 0));
  REQUIRE(bench.run(451, with(block, {{406, 0.0}})) == 0);
  for (const int q : {141, 143, 147, 148, 149}) CHECK(same(bench.host.q[q], 0));
  CHECK(distance(bench, setup, Axis::C) < 1e-8);
}

TEST_CASE("a correction that is mostly noise is refused, or taken with a note") {
  Setup setup = trunnion();
  setup.machine.probes.front().repeatability_um = 1;
  const Values block =
      with(with(kinematics_block(), measured(Axis::C, -0.05, 0.05, 3)), {{406, 1.0}});
  SphereBench bench(setup);
  const machine::Kinematics before = bench.machine.state().kinematics;
  CHECK(bench.run(451, block) == 1102);
  CHECK(contains(bench.fault.text, "location of axis C"));
  CHECK(bench.machine.state().kinematics == before);
  CHECK(contains(log_of(bench, 451), "less than twice its standard uncertainty"));
  CHECK(bench.run(451, with(block, {{406, 0.0}})) == 0);
  setup.machine.kinematics_options.notes_insignificant = true;
  SphereBench noting(setup);
  CHECK(noting.run(451, block) == 0);
  CHECK(noting.host.notes.size() == 1);
  CHECK_FALSE(noting.machine.state().kinematics == before);
}

TEST_CASE("a correction beyond maxModification waits for NC Start") {
  Setup setup = with_location_errors();
  setup.machine.kinematics_options.max_modification = 0.05;
  const Values block = with(both_axes(4), {{406, 1.0}});
  SphereBench waiting(setup);
  const machine::Kinematics before = waiting.machine.state().kinematics;
  waiting.host.starts = false;
  CHECK(waiting.run(451, block) == 0);
  CHECK(waiting.host.stops.size() == 1);
  CHECK(waiting.machine.state().kinematics == before);
  SphereBench started(setup);
  CHECK(started.run(451, block) == 0);
  CHECK(distance(started, setup, Axis::C) < 1e-8);
  setup.machine.kinematics_options.max_modification = 0.06;
  SphereBench within(setup);
  CHECK(within.run(451, block) == 0);
  CHECK(within.host.stops.empty());
}

TEST_CASE("the largest deviation of the sphere's radius is a setting") {
  Setup setup = trunnion();
  SphereBench bench(setup);
  CHECK(bench.run(451, with(both_axes(3), {{407, 14.95}})) == 0);
  setup.machine.kinematics_options.max_ball_deviation = 0.02;
  SphereBench strict(setup);
  CHECK(strict.run(451, with(both_axes(3), {{407, 14.95}})) == 1072);
}

TEST_CASE("an axis of mStrobeRotAxPos gets its targets in Q120 to Q122") {
  Setup setup = with_location_errors();
  setup.machine.axes[index(Axis::C)]->backlash_deg = 0.01;
  setup.machine.kinematics_options.strobed[2] = true;
  SphereBench bench(setup);
  REQUIRE(bench.run(451, with(with(kinematics_block(), measured(Axis::C, -60, 120, 3)),
                              {{432, 2.0}})) == 0);
  CHECK(bench.host.q[122] == 0);
  CHECK_FALSE(bench.host.q.contains(120));
  CHECK(contains(log_of(bench, 451), "not possible with an axis that an M function positions"));
  bench.move(Axis::C, 5);
  CHECK(bench.run(451, with(kinematics_block(), measured(Axis::C, -60, 120, 3))) == 1005);
}

TEST_CASE("451 that measures no axis is noted") {
  SphereBench bench(trunnion());
  REQUIRE(bench.run(451, kinematics_block()) == 0);
  // One position at 0 is the reference alone, and the machine has no B.
  REQUIRE(bench.run(451, with(with(kinematics_block(), measured(Axis::A, 0, 90, 1)),
                              measured(Axis::B, -60, 60, 3))) == 0);
  REQUIRE(bench.host.notes.size() == 2);
  for (const std::string& note : bench.host.notes) CHECK(note.starts_with("cycle 451 measures no"));
  REQUIRE(bench.run(451, both_axes(3)) == 0);
  CHECK(bench.host.notes.size() == 2);
}

TEST_CASE("FMAX is a feed, and an INCH program gets millimetres") {
  SphereBench bench(with_location_errors());
  bench.host.inch = true;
  const double infinity = std::numeric_limits<double>::infinity();
  REQUIRE(bench.run(451, with(both_axes(3), {{253, infinity}})) == 0);
  CHECK(same(bench.host.q[148], 0.05));
  CHECK(contains(log_of(bench, 451), "Lengths in mm"));
  CHECK(contains(log_of(bench, 451), "15.0000"));
}

TEST_CASE("each measurement of a run joins one log") {
  SphereBench bench(trunnion());
  REQUIRE(bench.run(451, with(both_axes(3), {{406, 1.0}})) == 0);
  REQUIRE(bench.run(451, both_axes(3)) == 0);
  const std::string& log = log_of(bench, 451);
  CHECK(contains(log, "Mode 1 = optimise locations;"));
  CHECK(contains(log, "Mode 0 = check;"));
  CHECK(log.find("<!DOCTYPE") == log.rfind("<!DOCTYPE"));
}

}  // namespace fitgauge::probing
