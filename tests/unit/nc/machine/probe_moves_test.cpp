#include <doctest/doctest.h>

#include "unit/nc/machine/machine_bench.hpp"

using namespace fitgauge::machine;

TEST_CASE("a bore is probed in four directions") {
  MachineWithProbe machine(bore_setup(), {50, 40, 50});
  REQUIRE(ok(machine.move(to({50, 40, -12}))));  // the ball's centre at -10
  for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}}) {
    const auto contact = machine.probe(towards(direction));
    REQUIRE(ok(contact));
    check_near(contact->ball_centre, Vec3{50, 40, -10} + direction * (25.013 / 2 - 2));
    check_near(contact->surface, Vec3{50, 40, -10} + direction * (25.013 / 2));
    check_near(contact->tip, contact->ball_centre - Vec3{0, 0, 2});
    check_near(contact->nose.linear, contact->tip_machine + Vec3{0, 0, 120});
    CHECK(near(contact->seconds, (25.013 / 2 - 2) / 500 * 60));
    check_near(machine.position().linear, {50, 40, -12});  // back at the start
  }
}

TEST_CASE("contacts are the same in shifted, rotated and mirrored coordinates") {
  Setup setup = bore_setup();
  setup.machine.presets[0].frame = {{50, 40, -10}, {0, 0, 30}, {}};
  MachineWithProbe machine(setup);
  Frames frames = machine.state().frames;
  frames.set_datum_shift({{0, 0, 3}, {}});
  frames.set_mirror({true, false, false});
  REQUIRE(ok(machine.set_frames(frames)));
  REQUIRE(ok(machine.move(to({0, 0, -5}))));
  const auto contact = machine.probe(towards({1, 1, 0}));
  REQUIRE(ok(contact));
  check_near(contact->ball_centre, unit({1, 1, 0}) * (25.013 / 2 - 2) + Vec3{0, 0, -3});
}

TEST_CASE("a probing move that meets nothing, or meets at once, is a fault") {
  MachineWithProbe machine(bore_setup(), {50, 40, -12});
  const auto missed = machine.probe(towards({1, 0, 0}, 10));
  CHECK(fault_of(missed) == FaultKind::NoContact);
  CHECK(missed.error().number == 1014);
  check_near(machine.position().linear, {60, 40, -12});
  Setup setup = bore_setup();
  setup.machine.start = AxisWords::linear({50, 40, 117.5});
  MachineWithProbe deflected(setup);
  check_near(deflected.position().linear, {50, 40, -2.5});
  REQUIRE(ok(deflected.probe(towards({1, 0, 0}))));
  Setup inside = setup;
  inside.machine.start = AxisWords::linear({20, 20, 121.5});
  MachineWithProbe touching(inside);
  REQUIRE(ok(touching.probe(towards({0, 0, -1}))));
  inside.machine.start = AxisWords::linear({20, 20, 119.5});
  MachineWithProbe overlapping(inside);
  CHECK(fault_of(overlapping.probe(towards({0, 0, -1}))) == FaultKind::StylusDeflected);
}

TEST_CASE("pretravel lengthens every contact, repeatability scatters it by its seed") {
  Setup setup = bore_setup();
  setup.machine.probes[0].pretravel_um = 3;
  MachineWithProbe late(setup, {50, 40, -12});
  CHECK(near(late.probe(towards({1, 0, 0}))->ball_centre.x, 50 + 25.013 / 2 - 2 + 0.003));

  setup.machine.probes[0].pretravel_um = 0;
  setup.machine.probes[0].repeatability_um = 1;
  const auto contacts = [&](std::uint64_t seed) {
    setup.seed = seed;
    MachineWithProbe machine(setup, {50, 40, -12});
    std::vector<double> found(500);
    for (double& x : found) x = machine.probe(towards({1, 0, 0}))->ball_centre.x;
    return found;
  };
  const auto first = contacts(7);
  CHECK(first == contacts(7));
  CHECK(first != contacts(8));
  double squares = 0;
  for (const double x : first) squares += std::pow(x - (50 + 25.013 / 2 - 2), 2);
  CHECK(near(std::sqrt(squares / 500), 0.001, 1e-4));
}

TEST_CASE("what the control compensates is its table, what touches is the real ball") {
  Setup setup = bore_setup();
  setup.machine.tools[0].actual_radius = 2.05;
  setup.machine.tools[0].actual_length = 120.2;
  setup.machine.probes[0].centre_offset = {0.01, -0.02};
  MachineWithProbe machine(setup, {20, 20, 5});
  CHECK(near(machine.probe(towards({0, 0, -1}))->tip.z, 0.2));  // 0.2 mm longer than it knows
  REQUIRE(ok(machine.move(to({50, 40, 5}))));
  REQUIRE(ok(machine.move(to({50, 40, -12}))));
  const double reach = 25.013 / 2 - 2.05;
  const double expected = std::sqrt(reach * reach - 0.02 * 0.02) - 0.01;
  CHECK(near(machine.probe(towards({1, 0, 0}))->ball_centre.x, 50 + expected));
  ProbeRow calibrated = *machine.state().probes.find(1);
  calibrated.cal_of1 = 0.01;
  calibrated.cal_of2 = -0.02;
  REQUIRE(ok(machine.write_probe(calibrated)));
  const auto contact = machine.probe(towards({1, 0, 0}));
  check_near(contact->ball_centre, {50 + expected + 0.01, 39.98, -10});
}

TEST_CASE("the ball goes round with the spindle, and CAL_OF with it") {
  Setup setup = bore_setup();
  setup.machine.probes[0].centre_offset = {0.01, -0.02};
  setup.machine.probes[0].row.cal_of1 = 0.01;
  setup.machine.probes[0].row.cal_of2 = -0.02;
  MachineWithProbe machine(setup, {20, 20, 5});
  const auto nose_at_contact = [&](double spindle_deg) {
    Modes modes = machine.state().modes;
    modes.spindle_deg = spindle_deg;
    REQUIRE(ok(machine.set_modes(modes)));
    REQUIRE(ok(machine.move(to({50, 40, 5}))));
    REQUIRE(ok(machine.move(to({50, 40, -12}))));
    const auto contact = machine.probe(towards({1, 0, 0}));
    const double reach = 25.013 / 2 - 2;
    const Vec3& ball = contact->ball_centre;
    CHECK(near(std::hypot(ball.x - 50, ball.y - 40), reach));
    return contact->nose.linear.x;
  };
  const double straight = nose_at_contact(0);
  CHECK(near(nose_at_contact(180), straight + 0.02));
  CHECK(near(nose_at_contact(90), straight + 0.01 - 0.02, 1e-4));
}

TEST_CASE("the contact plate of the tool touch probe may be a cube") {
  Setup setup;
  setup.machine.tt.known.shape = ContactPlate::Cube;
  add_cutter(setup, 100, 6);
  MachineWithProbe machine(setup);
  machine.call_cutter();
  const auto touch_x = [&](double y) {
    REQUIRE(ok(machine.move(to({340, y, 60}))));
    REQUIRE(ok(machine.move(to({340, y, 45}))));
    return machine.probe(towards({-1, 0, 0}))->tip.x;
  };
  CHECK(near(touch_x(0), 326));
  CHECK(near(touch_x(19), 326));              // a disc is narrower there
  CHECK(near(touch_x(20 + 3.6), 320 + 4.8));  // the cylinder meets the edge
}

TEST_CASE("a cutter is measured by the tool touch probe") {
  Setup setup;
  ToolSetup& mill = add_cutter(setup, 100, 6);
  mill.actual_length = 99.9;
  mill.actual_radius = 5.95;
  MachineWithProbe machine(setup);
  machine.call_cutter();
  REQUIRE(ok(machine.move(to({300, 0, 60}))));
  CHECK(near(machine.probe(towards({0, 0, -1}))->tip.z, 49.9));  // 0.1 mm shorter than it knows
  REQUIRE(ok(machine.move(to({340, 0, 60}))));
  REQUIRE(ok(machine.move(to({340, 0, 45}))));
  CHECK(near(machine.probe(towards({-1, 0, 0}))->tip.x, 300 + 20 + 5.95));
  CHECK(fault_of(machine.probe(towards({1, 0, 0}))) == FaultKind::NoContact);
}

TEST_CASE("retracting goes back by the way asked for, or to the start") {
  MachineWithProbe machine(bore_setup(), {50, 40, -12});
  ProbeMove move = towards({1, 0, 0});
  move.retract = 3;
  REQUIRE(ok(machine.probe(move)));
  check_near(machine.position().linear, {50 + 25.013 / 2 - 2 - 3, 40, -12});
  for (const double farther : {18.0, 30.0}) {  // 30 mm would end in the opposite wall
    move.retract = farther;
    REQUIRE(ok(machine.probe(move)));
    check_near(machine.position().linear, {50 + 25.013 / 2 - 2 - 3, 40, -12});
  }
}
