#include <doctest/doctest.h>

#include "unit/nc/machine/machine_bench.hpp"

using namespace fitgauge::machine;

namespace {

/// A sphere on a trunnion table, touched from above.
Setup sphere_setup() {
  Setup setup;
  setup.machine.axes[index(Axis::A)] = AxisSetup::of(Axis::A);
  setup.machine.axes[index(Axis::C)] = AxisSetup::of(Axis::C);
  setup.features = {Sphere{{100, 20, 50}, 25}};
  return setup;
}

/// The top of the sphere, found by touching straight down above `centre`.
double touch_top(Machine& machine, const Vec3& centre) {
  REQUIRE(ok(machine.move(to(centre + Vec3{0, 0, 30}, CoordinateSystem::Machine))));
  ProbeMove probing{{0, 0, -1}, 40, 500, CoordinateSystem::Machine, std::nullopt, {}};
  const auto contact = machine.probe(probing);
  REQUIRE(ok(contact));
  return contact->tip_machine.z;
}

}  // namespace

TEST_CASE("the workpiece turns with the table") {
  MachineWithProbe machine(sphere_setup());
  CHECK(near(touch_top(machine, {100, 20, 50}), 62.5));
  machine.turn(Axis::C, 90);  // the workpiece turns by -90 degrees
  CHECK(near(touch_top(machine, {20, -100, 50}), 62.5));
  machine.turn(Axis::A, 45);
  const Vec3 centre = machine.state().kinematics.table({45, 0, 90}).point({100, 20, 50});
  CHECK(near(touch_top(machine, centre), centre.z + 12.5));
}

TEST_CASE("a tilted plane follows the table and is probed square to the plane") {
  Setup setup = sphere_setup();
  MachineWithProbe machine(setup);
  Frames frames = machine.state().frames;
  frames.set_plane(TiltedPlane{{30, 0, 0}, {100, 20, 50}});
  REQUIRE(ok(machine.set_frames(frames)));
  const Vec3 normal = Matrix3::spatial({30, 0, 0}) * Vec3{0, 0, 1};
  const auto found = machine.state().kinematics.orientations(normal, {}, Axis::Z);
  REQUIRE_FALSE(found.empty());
  machine.turn(Axis::A, found[0].x);
  machine.turn(Axis::C, found[0].z);
  check_near(machine.state().tool_direction(), {0, 0, 1});
  REQUIRE(ok(machine.move(to({0, 0, 30}))));
  const auto contact =
      machine.probe({{0, 0, -1}, 40, 500, CoordinateSystem::Input, std::nullopt, {}});
  REQUIRE(ok(contact));
  check_near(contact->tip, {0, 0, 12.5});
  check_near(machine.state().frames.from_machine(contact->tip_machine, CoordinateSystem::Basic),
             Vec3{100, 20, 50} + normal * 12.5);
}

TEST_CASE("with TCPM the tip keeps its place on the workpiece") {
  MachineWithProbe machine(sphere_setup(), {100, 20, 80});
  machine.set_tcpm(true);
  machine.turn(Axis::C, 60);
  check_near(machine.position().linear, {100, 20, 80});
  const Vec3 expected = machine.state().kinematics.table({0, 0, 60}).point({100, 20, 80});
  check_near(machine.position(CoordinateSystem::Machine).linear, expected);
  machine.set_tcpm(false);
  check_near(machine.position().linear, expected);
}

TEST_CASE("with TCPM the nose keeps to the ranges of the axes on its way, not only at its end") {
  Setup setup = sphere_setup();
  setup.machine.axes[index(Axis::X)]->min = -100;
  setup.machine.axes[index(Axis::X)]->max = 100;
  MachineWithProbe machine(setup, {0, 300, 200});
  machine.set_tcpm(true);
  const Position before = machine.state().nose;
  LinearMove half_turn;
  half_turn.target[Axis::C] = 180;  // from Y+300 to Y-300, by X+300 or X-300
  CHECK(machine.move(half_turn).error().kind == FaultKind::AxisLimit);
  CHECK(machine.state().nose == before);
  half_turn.target[Axis::C] = 15;  // X = 300 sin 15 = 78
  CHECK(ok(machine.move(half_turn)));
}

TEST_CASE("a head tilts the tool around the nose, and with TCPM around the tip") {
  Setup setup;
  setup.machine.axes[index(Axis::B)] = AxisSetup::of(Axis::B);
  setup.machine.axes[index(Axis::B)]->mount = AxisMount::Head;
  MachineWithProbe machine(setup);
  machine.turn(Axis::B, 90);
  check_near(machine.state().nose.linear, {0, 0, 500});
  check_near(machine.position().linear, {-120, 0, 500});
  machine.turn(Axis::B, 0);
  machine.set_tcpm(true);
  machine.turn(Axis::B, 30);
  check_near(machine.position().linear, {0, 0, 380});
  check_near(machine.state().nose.linear, Vec3{0, 0, 380} + Vec3{0.5, 0, std::sqrt(3) / 2} * 120);
}

TEST_CASE("errors of centre, direction and backlash move the sphere, not the model") {
  Setup setup = sphere_setup();
  AxisSetup& table = *setup.machine.axes[index(Axis::C)];
  table.centre_error = {0.02, -0.01, 0};
  MachineWithProbe machine(setup);
  const Vec3 ideal = machine.state().kinematics.table({0, 0, 180}).point({100, 20, 50});
  machine.turn(Axis::C, 180);
  // Half a turn doubles the error of the centre: touch the real centre to see it.
  CHECK(near(touch_top(machine, ideal + Vec3{0.04, -0.02, 0}), 62.5));
  CHECK(touch_top(machine, ideal) < 62.5 - 5e-5);

  table.centre_error = {};
  table.tilt_error_deg = {0.1, 0, 0};
  MachineWithProbe tilted(setup);
  tilted.turn(Axis::C, 180);
  const Vec3 direction = Matrix3::spatial({0.1, 0, 0}) * Vec3{0, 0, 1};
  const Vec3 moved = Transform::rotation_around({0, 0, -100}, direction, -180).point({100, 20, 50});
  CHECK(near(touch_top(tilted, moved), moved.z + 12.5));

  table.tilt_error_deg = {};
  table.backlash_deg = 0.05;
  MachineWithProbe loose(setup);
  loose.turn(Axis::C, 100);
  loose.turn(Axis::C, 90);  // from above: the table lags
  const Vec3 lagging = loose.state().kinematics.table({0, 0, 90.05}).point({100, 20, 50});
  CHECK(near(touch_top(loose, lagging), 62.5));
}

TEST_CASE("a turned table comes to rest with the scatter of its axis") {
  Setup setup = sphere_setup();
  setup.machine.axes[index(Axis::C)]->scatter_um = 2;
  MachineWithProbe machine(setup);
  double squares = 0;
  constexpr int kTurns = 300;
  for (int k = 0; k < kTurns; ++k) {
    machine.turn(Axis::C, k % 2 == 0 ? 360 : 0);
    squares += std::pow(touch_top(machine, {100, 20, 50}) - 62.5, 2);
  }
  CHECK(near(std::sqrt(squares / kTurns), 0.002, 3e-4));
}

TEST_CASE("an axis with a Hirth grid stops on teeth only") {
  Setup setup = sphere_setup();
  setup.machine.axes[index(Axis::A)]->hirth_grid_deg = 3;
  MachineWithProbe machine(setup);
  machine.turn(Axis::A, 51);
  LinearMove between;
  between.target[Axis::A] = 50;
  CHECK(fault_of(machine.move(between)) == FaultKind::HirthGrid);
  CHECK(machine.state().nose.rotary == Vec3{51, 0, 0});
}

TEST_CASE("a corrected model is what the frames follow") {
  MachineWithProbe machine(sphere_setup());
  std::vector<RotaryAxis> axes = machine.state().kinematics.axes();
  for (RotaryAxis& axis : axes) axis.centre = axis.centre + Vec3{1, 0, 0};
  REQUIRE(ok(machine.set_kinematics(Kinematics(axes))));
  machine.set_tcpm(true);
  REQUIRE(ok(machine.move(to({1, 0, 100}))));
  machine.turn(Axis::C, 180);
  check_near(machine.position(CoordinateSystem::Machine).linear, {1, 0, 100});
  const Kinematics foreign({{Axis::B, AxisMount::Table, {}, {0, 1, 0}}});
  CHECK(fault_of(machine.set_kinematics(foreign)) == FaultKind::AxisMissing);
}
