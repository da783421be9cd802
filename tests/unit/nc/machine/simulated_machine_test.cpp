#include <doctest/doctest.h>

#include "unit/nc/machine/machine_bench.hpp"

using namespace fitgauge::machine;

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
  MachineWithProbe machine(bore_setup());
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

TEST_CASE("a probe that touches on a positioning move stops there, a cutter does not") {
  Setup setup = bore_setup();
  add_cutter(setup, 120, 5);
  MachineWithProbe machine(setup);
  const auto fault = machine.move(to({20, 20, -5}));
  CHECK(fault_of(fault) == FaultKind::Collision);
  // From (0, 0, 380): the ball's centre stops one radius above the face.
  CHECK(near(machine.state().ball_centre().z, 2, 2e-6));
  machine.call_cutter();
  REQUIRE(ok(machine.move(to({20, 20, -5}))));
  check_near(machine.position().linear, {20, 20, -5});
}

TEST_CASE("a probe collides on an arc and on a turning table") {
  MachineWithProbe machine(bore_setup(), {58, 40, -12});
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
  MachineWithProbe turning(setup, {110, 40, -20});
  LinearMove turn;
  turn.target[Axis::C] = 45;
  CHECK(fault_of(turning.move(turn)) == FaultKind::Collision);
}

TEST_CASE("moves outside the axis ranges are refused before they begin") {
  MachineWithProbe machine(bore_setup());
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
  MachineWithProbe machine(bore_setup());
  REQUIRE(ok(machine.move(to({10, 20, 300}, CoordinateSystem::Reference))));
  check_near(machine.position().linear, {10, 20, 180});
  REQUIRE(ok(machine.move(to({10, 20, 300}, CoordinateSystem::Machine))));
  check_near(machine.state().nose.linear, {10, 20, 420});
}

TEST_CASE("axes without a word keep their coordinate, also in a rotated frame") {
  MachineWithProbe machine(bore_setup());
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
  MachineWithProbe machine(bore_setup());
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

TEST_CASE("every tool collides with a fixture, and no value is taken from one") {
  Setup setup = bore_setup();
  setup.fixtures = {Boss{{80, 70}, 30, 30, 12}};
  for (const bool is_probe : {true, false}) {
    CAPTURE(is_probe);
    setup.machine.tools[0].row.probe = is_probe ? 1 : 0;
    MachineWithProbe machine(setup, {60, 70, 20});
    const auto fault = machine.move(to({90, 70, 20}));
    CHECK(fault_of(fault) == FaultKind::FixtureCollision);
    CHECK(fault.error().text == "Collision with a fixture");
    CHECK(machine.position().linear.x ==
          doctest::Approx(72));  // the ball of 2 before the boss of 6
  }
}

TEST_CASE("a fixture before the workpiece ends a probing move, one behind it does not") {
  for (const bool is_before : {true, false}) {
    CAPTURE(is_before);
    Setup setup = bore_setup();
    setup.fixtures = {is_before ? Boss{{-6, 40}, 0, 40, 4} : Boss{{50, 40}, 0, 40, 4}};
    MachineWithProbe machine(setup, {-15, 40, -10});
    const auto contact = machine.probe(towards({1, 0, 0}));
    REQUIRE(contact.has_value() != is_before);
    if (is_before) CHECK(fault_of(contact) == FaultKind::FixtureCollision);
    if (!is_before) CHECK(contact->ball_centre.x == doctest::Approx(-2));
  }
}
