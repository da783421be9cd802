#pragma once

#include "nc/machine/axis.hpp"

namespace fitgauge::probing {

/// The main and the secondary axis of the working plane and the probe axis across it. Cycles
/// compute in plane coordinates: x along the main axis, y along the secondary axis, z along the
/// probe axis.
struct WorkingPlane {
  machine::Axis main = machine::Axis::X;
  machine::Axis secondary = machine::Axis::Y;
  machine::Axis probe = machine::Axis::Z;

  /// Tool axis Z: XY, X: YZ, Y: ZX.
  static constexpr WorkingPlane across(machine::Axis tool_axis) {
    using machine::Axis;
    if (tool_axis == Axis::X) return {Axis::Y, Axis::Z, Axis::X};
    if (tool_axis == Axis::Y) return {Axis::Z, Axis::X, Axis::Y};
    return {Axis::X, Axis::Y, Axis::Z};
  }

  constexpr machine::Vec3 from_input(const machine::Vec3& p) const {
    return {p[index(main)], p[index(secondary)], p[index(probe)]};
  }
  constexpr machine::Vec3 to_input(const machine::Vec3& p) const {
    machine::Vec3 input;
    input[index(main)] = p.x;
    input[index(secondary)] = p.y;
    input[index(probe)] = p.z;
    return input;
  }

  /// The axis a block names by Q272: 1 main, 2 secondary, 3 probe axis.
  constexpr machine::Axis axis(int q272) const {
    return q272 == 1 ? main : q272 == 2 ? secondary : probe;
  }
};

}  // namespace fitgauge::probing
