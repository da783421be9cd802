#include <doctest/doctest.h>

#include "unit/nc/machine/machine_bench.hpp"

using namespace fitgauge::machine;

namespace {

/// A head B over a plate whose upper side is at Z = 0; the probe is in the spindle.
Setup head_setup() {
  Setup setup;
  setup.machine.axes[index(Axis::B)] = AxisSetup::of(Axis::B);
  setup.machine.axes[index(Axis::B)]->mount = AxisMount::Head;
  setup.features = {Plane{}};
  return setup;
}

/// The height at which the control sees the ball's centre when it touches straight down.
double touched_height(Machine& machine) {
  REQUIRE(ok(machine.move(to({0, 0, 10}, CoordinateSystem::Machine))));
  const auto contact =
      machine.probe({{0, 0, -1}, 20, 500, CoordinateSystem::Machine, std::nullopt, {}});
  REQUIRE(ok(contact));
  return contact->ball_centre.z;
}

}  // namespace

TEST_CASE("a head turns about an axis that may lie off the spindle nose") {
  const Kinematics head({{Axis::B, AxisMount::Head, {0, 0, 30}, {0, 1, 0}}});
  check_near(head.tool_vector({}, Axis::Z, 120), {0, 0, -120});
  check_near(head.tool_vector({0, 90, 0}, Axis::Z, 120), {-150, 0, 30});
  const Kinematics shifted(head.axes(), {1, 2, 3});
  check_near(shifted.tool_vector({0, 90, 0}, Axis::Z, 120), {-149, 2, 33});
  CHECK_FALSE(shifted == head);
}

TEST_CASE("the axis of a head that lies elsewhere than modelled moves the ball") {
  Setup setup = head_setup();
  setup.machine.axes[index(Axis::B)]->centre = {5, 6, 7};  // means nothing in a head
  constexpr double kError = 0.02;
  setup.machine.axes[index(Axis::B)]->centre_error = {0, 0, kError};
  MachineWithProbe machine(setup);
  CHECK(near(touched_height(machine), 2));
  machine.turn(Axis::B, 60);
  CHECK(near(touched_height(machine), 2 - kError / 2));
}

TEST_CASE("the offset of the kinematic model moves every coordinate of the tool") {
  MachineWithProbe machine(head_setup());
  const Vec3 tip = machine.position().linear;
  const Kinematics shifted(machine.state().kinematics.axes(), {1, -2, 0.5});
  REQUIRE(ok(machine.set_kinematics(shifted)));
  check_near(machine.position().linear, tip + Vec3{1, -2, 0.5});
  CHECK(near(touched_height(machine), 2.5));
  machine.turn(Axis::B, 60);
  CHECK(near(touched_height(machine), 2.5));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_of(machine.set_kinematics(Kinematics(shifted.axes(), {kNan, 0, 0}))) ==
        FaultKind::ValueInvalid);
}
