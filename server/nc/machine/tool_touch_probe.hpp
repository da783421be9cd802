#pragma once

#include "nc/machine/geometry.hpp"

namespace fitgauge::machine {

/// The tool touch probe TT as the control knows it: cycles 480 and 484 calibrate it.
struct ToolTouchProbe {
  Vec3 centre{300, 0, 50};  ///< of the upper side of its contact plate, machine coordinates, in mm
  double radius = 20;       ///< of the disc, or half the edge of the cube, in mm

  friend bool operator==(const ToolTouchProbe&, const ToolTouchProbe&) = default;
};

}  // namespace fitgauge::machine
