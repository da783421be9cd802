#pragma once

#include <vector>

#include "nc/klartext/statement.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/plane_geometry.hpp"

namespace fitgauge::interpreter {

class Channel;

/// A contour of cycle 14: closed curves, one after the other, in input coordinates.
struct SlContour {
  std::vector<Curve> curves;
  bool is_pocket = true;  ///< machined inside; else an island, which stays
};

/// What the label's subprogram programs. RL around to the left and RR to the right are a pocket,
/// the other two an island; without RL and RR it is a pocket. An open contour is closed by a line.
/// @errors those of its blocks; 1024 no such label, or it encloses nothing.
NcResult<SlContour> read_contour(Channel& channel, const klartext::Label& label);

/// The contour as the tool mills along it.
struct SlPath {
  std::vector<Curve> curves;  ///< of the contour, from the middle of its longest curve
  int side = 1;               ///< of the curves that the tool is on: 1 left, -1 right
  Vec2 start;                 ///< of the tool's centre
};

/// Climb milling (with M3) goes around a pocket to the left and around an island to the right.
/// Corner arcs that the tool cannot follow from inside become the corners of their lines, where
/// material remains. @param reach from the contour to the tool's centre
SlPath path_along(const SlContour& contour, double reach, bool is_climb);

}  // namespace fitgauge::interpreter
