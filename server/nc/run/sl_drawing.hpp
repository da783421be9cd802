#pragma once

#include <vector>

#include "nc/machine/machine.hpp"
#include "nc/run/element.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

/// What the subprogram of an SL contour programs, kept instead of moved. It may transform
/// coordinates: the curves are those of the input system in which the cycle was called. Depths,
/// feeds and M functions do not count there.
class SlDrawing {
 public:
  /// Begins where the machine stands, which must outlive this.
  explicit SlDrawing(const machine::Machine& machine)
      : machine_(&machine),
        begun_in_(machine.state().frames),
        at_(begun_in_.to_machine(machine.position().linear)) {}

  /// The first element that names an axis of the plane leads to the contour's first point; the
  /// others are the contour. @errors not in the working plane.
  NcResult<void> add(const Element& element);

  /// Where the last element ends, in the coordinates that are active now.
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
