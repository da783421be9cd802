#pragma once

#include "nc/machine/simulated_machine.hpp"

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
inline ToolCall probe_call() {
  ToolCall call;
  call.number = 30;
  call.axis = Axis::Z;
  return call;
}

inline LinearMove to(const Vec3& point, CoordinateSystem system = CoordinateSystem::Input) {
  LinearMove move;
  move.target = AxisWords::linear(point);
  move.system = system;
  return move;
}

inline ProbeMove towards(const Vec3& direction, double distance = 20) {
  return {direction, distance, 500, CoordinateSystem::Input, std::nullopt, Feed::rapid(3000)};
}

}  // namespace fitgauge::machine
