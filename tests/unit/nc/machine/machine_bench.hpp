#pragma once

#include "nc/machine/simulated_machine.hpp"
#include "unit/nc/machine/machine_check.hpp"

namespace fitgauge::machine {

/// A plate with a bore of 25.013 mm at (50, 40).
inline Setup bore_setup() {
  Setup setup;
  Bore bore;
  bore.centre = {50, 40};
  bore.depth = 30;
  bore.diameter = 25.013;
  setup.features = {Block{{0, 0, -40}, {100, 80, 0}}, bore};
  return setup;
}

/// The touch probe of the default setup.
inline ToolCall probe_call() { return {.number = 30, .axis = Axis::Z, .spindle_rpm = {}}; }

inline LinearMove to(const Vec3& point, CoordinateSystem system = CoordinateSystem::Input) {
  LinearMove move;
  move.target = AxisWords::linear(point);
  move.system = system;
  return move;
}

inline ProbeMove towards(const Vec3& direction, double distance = 20) {
  return {direction, distance, 500, CoordinateSystem::Input, std::nullopt, Feed::rapid(3000)};
}

/// Adds the cutter 5 to the tools.
inline ToolSetup& add_cutter(Setup& setup, double length, double radius) {
  ToolSetup& cutter = setup.machine.tools.emplace_back();
  cutter.row.number = 5;
  cutter.row.l = length;
  cutter.row.r = radius;
  return cutter;
}

/// A simulated machine that has called the touch probe, and may have moved its tip to a place.
class MachineWithProbe final : public SimulatedMachine {
 public:
  explicit MachineWithProbe(const Setup& setup) : SimulatedMachine(setup) {
    REQUIRE(ok(SimulatedMachine::call_tool(probe_call())));
  }
  MachineWithProbe(const Setup& setup, const Vec3& place) : MachineWithProbe(setup) {
    REQUIRE(ok(SimulatedMachine::move(to(place))));
  }

  void call_cutter() { REQUIRE(ok(call_tool({.number = 5, .axis = Axis::Z, .spindle_rpm = {}}))); }

  void turn(Axis axis, double angle) {
    LinearMove turning;
    turning.target[axis] = angle;
    REQUIRE(ok(move(turning)));
  }

  void set_tcpm(bool on) {
    Modes modes = state().modes;
    modes.tcpm = on;
    REQUIRE(ok(set_modes(modes)));
  }
};

}  // namespace fitgauge::machine
