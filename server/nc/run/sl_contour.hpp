#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/machine/machine.hpp"
#include "nc/run/cutter_path.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/plane_geometry.hpp"

namespace fitgauge::interpreter {

class Channel;

/// A contour of cycle 14: closed curves, one after the other, in input coordinates.
struct SlContour {
  std::vector<Curve> curves;
  bool is_pocket = true;  ///< machined inside; otherwise an island, which stays
};

/// The kind of contour in the label's subprogram. RL around to the left and RR to the right are a
/// pocket, the other two an island; without RL and RR it is a pocket. An open contour is closed by
/// a line.
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

/// Stores the contour of a subprogram of an SL cycle instead of moving. It may transform
/// coordinates: the curves are in the input system in which the cycle was called. Depths, feeds and
/// M functions have no effect there.
class SlDrawing {
 public:
  /// Begins at the position of the machine, which must outlive this.
  explicit SlDrawing(const machine::Machine& machine)
      : machine_(&machine),
        begun_in_(machine.state().frames),
        at_(begun_in_.to_machine(machine.position().linear)) {}

  /// The first element that names an axis of the plane leads to the contour's first point; the
  /// others are the contour. @errors not in the working plane.
  NcResult<void> add(const Element& element);

  /// End of the last element, in the active coordinates.
  machine::Position position() const;

  const std::vector<Curve>& curves() const { return curves_; }
  /// 1 for RL, -1 for RR, seen in the system of the call; 0 for neither.
  int side() const { return side_; }

 private:
  const machine::Machine* machine_;
  machine::Frames begun_in_;
  machine::Vec3 at_;  ///< in Machine coordinates
  bool has_begun_ = false;
  std::vector<Curve> curves_;
  int side_ = 0;
};

}  // namespace fitgauge::interpreter
