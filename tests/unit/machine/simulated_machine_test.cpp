#include "machine/simulated_machine.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "unit/machine/machine_check.hpp"

using namespace fitgauge::machine;

namespace {

Setup bore_setup() {
  Setup setup;
  Bore bore;
  bore.centre = {50, 40};
  bore.depth = 30;
  bore.diameter = 25.013;
  setup.features = {Block{{0, 0, -40}, {100, 80, 0}}, bore};
  return setup;
}

ToolCall probe_call() {
  ToolCall call;
  call.number = 30;
  call.axis = Axis::Z;
  return call;
}

LinearMove to(const Vec3& point, CoordinateSystem system = CoordinateSystem::Input) {
  LinearMove move;
  move.target = AxisWords::linear(point);
  move.system = system;
  return move;
}

ProbeMove towards(const Vec3& direction, double distance = 20) {
  return {direction, distance, 500, CoordinateSystem::Input, std::nullopt, Feed::rapid(3000)};
}

}  // namespace

TEST_CASE("a run begins at the start with an empty spindle and the active preset") {
  SimulatedMachine machine(bore_setup());
  CHECK(machine.state().nose == Position{{0, 0, 500}, {}});
  CHECK(machine.state().tool.number == 0);
  CHECK_FALSE(machine.state().tool.axis);
  CHECK(machine.state().active_preset == 1);
  CHECK(machine.state().elapsed_s == 0);
  Setup setup = bore_setup();
  setup.machine.start[Axis::Z] = 400;
  setup.machine.presets[0].frame.origin = {10, 20, 30};
  SimulatedMachine other(setup);
  check_near(other.position().linear, {-10, -20, 370});
  check_near(other.position(CoordinateSystem::Reference).linear, {0, 0, 400});
}

TEST_CASE("a tool call leaves the nose and moves the tip by the length") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  check_near(machine.position(CoordinateSystem::Reference).linear, {0, 0, 500});
  check_near(machine.position().linear, {0, 0, 380});
  check_near(machine.state().ball_centre(), {0, 0, 382});
  ToolCall oversize = probe_call();
  oversize.dl = 0.5;
  oversize.dr = 0.1;
  REQUIRE(ok(machine.call_tool(oversize)));
  CHECK(machine.state().tool_length() == 120.5);
  CHECK(machine.state().tool_radius() == 2.1);
  check_near(machine.position().linear, {0, 0, 379.5});
}

TEST_CASE("tool calls that name no tool, no axis or a locked tool are faults") {
  SimulatedMachine machine(bore_setup());
  ToolCall without_axis;
  without_axis.number = 30;
  const auto fault = machine.call_tool(without_axis);
  CHECK(fault_of(fault) == FaultKind::ToolAxisMissing);
  CHECK(fault.error().number == 1001);
  ToolCall unknown = probe_call();
  unknown.number = 77;
  CHECK(fault_of(machine.call_tool(unknown)) == FaultKind::ToolUnknown);
  Tool locked = *machine.state().tools.find(30);
  locked.locked = true;
  REQUIRE(ok(machine.write_tool(locked)));
  CHECK(fault_of(machine.call_tool(probe_call())) == FaultKind::ToolLocked);
  ToolCall empty;
  empty.number = 0;
  empty.axis = Axis::Z;
  REQUIRE(ok(machine.call_tool(empty)));
  CHECK(fault_of(machine.probe(towards({0, 0, -1}))) == FaultKind::NoTool);
}

TEST_CASE("a bore is probed in four directions") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({50, 40, 50}))));
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
  SimulatedMachine machine(setup);
  REQUIRE(ok(machine.call_tool(probe_call())));
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
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({50, 40, -12}))));
  const auto missed = machine.probe(towards({1, 0, 0}, 10));
  CHECK(fault_of(missed) == FaultKind::NoContact);
  CHECK(missed.error().number == 1014);
  check_near(machine.position().linear, {60, 40, -12});
  Setup setup = bore_setup();
  setup.machine.start = AxisWords::linear({50, 40, 117.5});
  SimulatedMachine deflected(setup);
  REQUIRE(ok(deflected.call_tool(probe_call())));
  check_near(deflected.position().linear, {50, 40, -2.5});
  REQUIRE(ok(deflected.probe(towards({1, 0, 0}))));
  Setup inside = setup;
  inside.machine.start = AxisWords::linear({20, 20, 121.5});
  SimulatedMachine touching(inside);
  REQUIRE(ok(touching.call_tool(probe_call())));
  REQUIRE(ok(touching.probe(towards({0, 0, -1}))));
  inside.machine.start = AxisWords::linear({20, 20, 119.5});
  SimulatedMachine overlapping(inside);
  REQUIRE(ok(overlapping.call_tool(probe_call())));
  CHECK(fault_of(overlapping.probe(towards({0, 0, -1}))) == FaultKind::StylusDeflected);
}

TEST_CASE("a probe that touches on a positioning move stops there, a cutter does not") {
  Setup setup = bore_setup();
  ToolSetup mill;
  mill.row.number = 5;
  mill.row.l = 120;
  mill.row.r = 5;
  setup.machine.tools.push_back(mill);
  SimulatedMachine machine(setup);
  REQUIRE(ok(machine.call_tool(probe_call())));
  const auto fault = machine.move(to({20, 20, -5}));
  CHECK(fault_of(fault) == FaultKind::Collision);
  // From (0, 0, 380): the ball's centre stops one radius above the face.
  CHECK(near(machine.state().ball_centre().z, 2, 2e-6));
  ToolCall cutter = probe_call();
  cutter.number = 5;
  REQUIRE(ok(machine.call_tool(cutter)));
  REQUIRE(ok(machine.move(to({20, 20, -5}))));
  check_near(machine.position().linear, {20, 20, -5});
}

TEST_CASE("a probe collides on an arc and on a turning table") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({58, 40, -12}))));
  ArcMove arc;
  arc.centre = {50, 40, 0};
  arc.end = {58, 40, -12};
  arc.sweep_deg = 360;
  REQUIRE(ok(machine.move_arc(arc)));
  check_near(machine.position().linear, {58, 40, -12});
  arc.centre = {47, 40, 0};  // reaches x = 36, where the wall stands at 37.4935
  CHECK(fault_of(machine.move_arc(arc)) == FaultKind::Collision);
  const Vec3 centre = machine.state().ball_centre();
  CHECK(near(std::hypot(centre.x - 50, centre.y - 40), 25.013 / 2 - 2, 2e-6));

  Setup setup = bore_setup();
  setup.machine.axes[index(Axis::C)] = AxisSetup::of(Axis::C);
  SimulatedMachine turning(setup);
  REQUIRE(ok(turning.call_tool(probe_call())));
  REQUIRE(ok(turning.move(to({110, 40, -20}))));
  LinearMove turn;
  turn.target[Axis::C] = 45;
  CHECK(fault_of(turning.move(turn)) == FaultKind::Collision);
}

TEST_CASE("moves outside the axis ranges are refused before they begin") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  CHECK(fault_of(machine.move(to({501, 0, 100}))) == FaultKind::AxisLimit);
  CHECK(fault_of(machine.move(to({0, 0, 381}))) == FaultKind::AxisLimit);  // the nose at 501
  REQUIRE(ok(machine.move(to({0, 0, 380}))));
  ArcMove arc;
  arc.centre = {0, 300, 0};
  arc.end = {0, 0, 380};
  arc.sweep_deg = 360;
  CHECK(fault_of(machine.move_arc(arc)) == FaultKind::AxisLimit);  // reaches y = 600
  check_near(machine.position().linear, {0, 0, 380});
  LinearMove turn;
  turn.target[Axis::A] = 10;
  CHECK(fault_of(machine.move(turn)) == FaultKind::AxisMissing);
  LinearMove standing = to({1, 1, 1});
  standing.feed = Feed::at(0);
  const auto fault = machine.move(standing);
  CHECK(fault_of(fault) == FaultKind::FeedMissing);
  CHECK(fault.error().number == 1010);
  CHECK(fault_of(machine.move(to({std::nan(""), 0, 0}))) == FaultKind::ValueInvalid);
  REQUIRE(ok(machine.move(to({490, 0, 300}))));
  CHECK(fault_of(machine.probe(towards({1, 0, 0}))) == FaultKind::AxisLimit);
  check_near(machine.position().linear, {500, 0, 300});
}

TEST_CASE("M91 positions the spindle nose") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({10, 20, 300}, CoordinateSystem::Reference))));
  check_near(machine.position().linear, {10, 20, 180});
  REQUIRE(ok(machine.move(to({10, 20, 300}, CoordinateSystem::Machine))));
  check_near(machine.state().nose.linear, {10, 20, 420});
}

TEST_CASE("axes without a word keep their coordinate, also in a rotated frame") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  Frames frames = machine.state().frames;
  frames.set_rotation({30, Axis::Z});
  REQUIRE(ok(machine.set_frames(frames)));
  REQUIRE(ok(machine.move(to({10, 20, 100}))));
  LinearMove move;
  move.target[Axis::X] = 50;
  REQUIRE(ok(machine.move(move)));
  check_near(machine.position().linear, {50, 20, 100});
}

TEST_CASE("time is the way over the feed") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  LinearMove move = to({30, 40, 380});
  REQUIRE(ok(machine.move(move)));  // 50 mm at 15000 mm/min
  CHECK(near(machine.state().elapsed_s, 0.2));
  move = to({0, 0, 380});
  move.feed = Feed::at(1000);
  REQUIRE(ok(machine.move(move)));
  CHECK(near(machine.state().elapsed_s, 3.2));
  move = to({30, 40, 380});
  move.feed = Feed::rapid(3000);
  REQUIRE(ok(machine.move(move)));
  CHECK(near(machine.state().elapsed_s, 4.2));
  ArcMove arc;
  arc.centre = {0, 0, 0};
  arc.end = {-30, -40, 380};
  arc.sweep_deg = -180;
  arc.feed = Feed::at(1000);
  REQUIRE(ok(machine.move_arc(arc)));
  CHECK(near(machine.state().elapsed_s, 4.2 + 50 * kPi / 1000 * 60));
  check_near(machine.position().linear, {-30, -40, 380});
  REQUIRE(ok(machine.dwell(1.5)));
  CHECK(near(machine.state().elapsed_s, 5.7 + 50 * kPi / 1000 * 60));
  CHECK(fault_of(machine.dwell(-1)) == FaultKind::ValueInvalid);
}

TEST_CASE("presets are written at once and act when they are activated") {
  SimulatedMachine machine(bore_setup());
  Preset preset;
  preset.number = 4;
  preset.frame.origin = {1, 2, 3};
  REQUIRE(ok(machine.write_preset(preset)));
  check_near(machine.position().linear, {0, 0, 500});
  Frames frames = machine.state().frames;
  frames.set_datum_shift({{100, 0, 0}, {}});
  REQUIRE(ok(machine.set_frames(frames)));
  REQUIRE(ok(machine.activate_preset(4)));
  check_near(machine.position().linear, {-1, -2, 497});
  CHECK(machine.state().active_preset == 4);
  CHECK(fault_of(machine.activate_preset(5)) == FaultKind::PresetUnknown);
  preset.locked = true;
  REQUIRE(ok(machine.write_preset(preset)));
  CHECK(fault_of(machine.write_preset(preset)) == FaultKind::PresetLocked);
}

TEST_CASE("pretravel lengthens every contact, repeatability scatters it by its seed") {
  Setup setup = bore_setup();
  setup.machine.probes[0].pretravel_um = 3;
  SimulatedMachine late(setup);
  REQUIRE(ok(late.call_tool(probe_call())));
  REQUIRE(ok(late.move(to({50, 40, -12}))));
  CHECK(near(late.probe(towards({1, 0, 0}))->ball_centre.x, 50 + 25.013 / 2 - 2 + 0.003));

  setup.machine.probes[0].pretravel_um = 0;
  setup.machine.probes[0].repeatability_um = 1;
  const auto contacts = [&](std::uint64_t seed) {
    setup.seed = seed;
    SimulatedMachine machine(setup);
    REQUIRE(ok(machine.call_tool(probe_call())));
    REQUIRE(ok(machine.move(to({50, 40, -12}))));
    std::vector<double> found;
    for (int k = 0; k < 500; ++k) found.push_back(machine.probe(towards({1, 0, 0}))->ball_centre.x);
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
  SimulatedMachine machine(setup);
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({20, 20, 5}))));
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
  SimulatedMachine machine(setup);
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({20, 20, 5}))));
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
  setup.machine.tt.shape = ContactPlate::Cube;
  ToolSetup mill;
  mill.row.number = 5;
  mill.row.l = 100;
  mill.row.r = 6;
  setup.machine.tools.push_back(mill);
  SimulatedMachine machine(setup);
  ToolCall call = probe_call();
  call.number = 5;
  REQUIRE(ok(machine.call_tool(call)));
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
  ToolSetup mill;
  mill.row.number = 5;
  mill.row.l = 100;
  mill.row.r = 6;
  mill.actual_length = 99.9;
  mill.actual_radius = 5.95;
  setup.machine.tools.push_back(mill);
  SimulatedMachine machine(setup);
  ToolCall call = probe_call();
  call.number = 5;
  REQUIRE(ok(machine.call_tool(call)));
  REQUIRE(ok(machine.move(to({300, 0, 60}))));
  CHECK(near(machine.probe(towards({0, 0, -1}))->tip.z, 49.9));  // 0.1 mm shorter than it knows
  REQUIRE(ok(machine.move(to({340, 0, 60}))));
  REQUIRE(ok(machine.move(to({340, 0, 45}))));
  CHECK(near(machine.probe(towards({-1, 0, 0}))->tip.x, 300 + 20 + 5.95));
  CHECK(fault_of(machine.probe(towards({1, 0, 0}))) == FaultKind::NoContact);
}

TEST_CASE("retracting goes back by the way asked for, or to the start") {
  SimulatedMachine machine(bore_setup());
  REQUIRE(ok(machine.call_tool(probe_call())));
  REQUIRE(ok(machine.move(to({50, 40, -12}))));
  ProbeMove move = towards({1, 0, 0});
  move.retract = 3;
  REQUIRE(ok(machine.probe(move)));
  check_near(machine.position().linear, {50 + 25.013 / 2 - 2 - 3, 40, -12});
  move.retract = 18;
  REQUIRE(ok(machine.probe(move)));
  check_near(machine.position().linear, {50 + 25.013 / 2 - 2 - 18, 40, -12});
  move.retract = 30;  // into the opposite wall
  CHECK(fault_of(machine.probe(move)) == FaultKind::Collision);
}
