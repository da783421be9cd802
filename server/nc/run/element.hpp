#pragma once

#include <cmath>

#include "nc/machine/machine.hpp"
#include "nc/machine/tolerance.hpp"
#include "nc/run/plane_geometry.hpp"

namespace fitgauge::interpreter {

/// One positioning block as geometry: its curve in a plane and the axes it names, absolute, in mm
/// and degrees.
struct Element {
  WorkingPlane plane;
  Curve curve;
  machine::Vec3 from;  ///< where the block before ends
  machine::AxisWords target;
  machine::Feed feed;
  machine::CoordinateSystem system = machine::CoordinateSystem::Input;
  int side = 0;  ///< of the contour that the tool is on: 1 left (RL), -1 right (RR), 0 on it
  machine::Vec3 shift{};  ///< of the tool from the programmed path (LN with DR), without RL and RR

  bool moves_in_plane() const {
    return curve.is_arc() || norm(curve.end - curve.start) > tolerance::kSamePoint;
  }
};

/// A radius of the tool as the working plane of the input system shows it: scaling (11, 26) does
/// not scale the tool.
inline double radius_in_plane(const machine::MachineState& state, double radius) {
  const WorkingPlane plane = WorkingPlane::across(state.tool_axis());
  return radius / std::abs(state.frames.scaling().factor[plane.first]);
}

inline void set_plane_target(Element& element, Vec2 point) {
  element.target.values[element.plane.first] = point.x;
  element.target.values[element.plane.second] = point.y;
}

}  // namespace fitgauge::interpreter
