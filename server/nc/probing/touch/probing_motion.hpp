#pragma once

#include "nc/probing/touch/fits.hpp"
#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

using machine::Vec3;

/// A point of the working plane, by the parameters of its coordinates.
inline Point2 point_of(const Arguments& arguments, int main, int secondary) {
  return {arguments.number(main), arguments.number(secondary)};
}
/// A point in plane coordinates, likewise.
inline Vec3 place_of(const Arguments& arguments, int main, int secondary, int probe) {
  return {arguments.number(main), arguments.number(secondary), arguments.number(probe)};
}

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

/// Path of the probe from one touch to the start of the next.
enum class Transit : std::uint8_t {
  Straight,         ///< at measuring height, over the waypoints
  Arc,              ///< on the pitch circle, at measuring height
  ClearanceHeight,  ///< up to Q260, across, down
};

/// One touch, in plane coordinates of the ball centre.
struct Touch {
  Vec3 start;
  Vec3 direction;  ///< of probing, length 1
  Transit transit = Transit::Straight;
  std::vector<Vec3> waypoints{};  ///< of Transit::Straight, before the start
  Vec3 arc_centre{};              ///< of Transit::Arc
  double arc_sweep = 0;           ///< in degrees, positive counter-clockwise
};

/// The result of a touch, in plane coordinates.
struct Contact {
  Vec3 ball_centre;
  Vec3 surface;  ///< ball centre moved by the effective radius along the probing direction
};

/// The motion of probing cycles: positioning logic, touches with their data of tchprobe.tp (F,
/// FMAX, DIST, SET_UP) or cycle 441, retraction. Coordinates are those of the active input system,
/// in which a mm may be scaled (cycle 11); clearances of the probe table are real millimetres. Not
/// thread-safe; lives within one execution. After an error the machine stops where it is.
class ProbingMotion {
 public:
  /// @errors 1001 tool axis missing, 1092 no tool, 1093 no touch probe in the spindle.
  static CycleResult<ProbingMotion> begin(const CycleContext& context);

  const WorkingPlane& plane() const { return plane_; }
  /// The effective ball radius in the input system.
  double ball_radius() const { return probe_.radius / scale_; }
  std::optional<double> touch_uncertainty_um() const { return probe_.data.uncertainty_um; }
  /// Ball centre to nominal contact before a touch: radius + SET_UP + Q320, if the cycle has it.
  double start_distance() const {
    return (probe_.radius + probe_.data.set_up) / scale_ + context_.number_or(320, 0);
  }

  /// Touches in order, then retracts to the clearance height (of the tip, Q260). The first start is
  /// reached by the positioning logic: a tip below the clearance height goes up first.
  /// Without end, -infinity, the height has no effect. Every touch updates Q115 to Q119.
  /// @errors 1014 no contact within DIST, and the faults of the machine.
  CycleResult<std::vector<Contact>> touch_all(std::span<const Touch> touches,
                                              double clearance_height);

  /// Makes only the first touch: returns to its start and stops there.
  /// @errors those of touch_all.
  CycleResult<Contact> touch(const Touch& touch, double clearance_height);

  /// Moves the tip in the named input axes, all together.
  CycleResult<void> move_tip(const machine::AxisWords& target);
  /// Touches along a direction in plane coordinates, as touch_all does, and comes back.
  CycleResult<Contact> probe(const Vec3& direction);

 private:
  ProbingMotion(const CycleContext& context, const machine::ProbeSystem& probe);

  CycleResult<void> approach(const Touch& touch, double clearance_height);
  CycleResult<void> transit(const Touch& touch, double clearance_height);
  CycleResult<void> via_clearance_height(const Vec3& start, double clearance_height);
  CycleResult<void> arc(const Touch& touch);
  CycleResult<void> move_ball(const Vec3& centre);           ///< all three axes together
  CycleResult<void> move_ball_in_plane(const Vec3& centre);  ///< keeps the height
  CycleResult<void> move_tip_to_height(double height);
  machine::Feed positioning_feed() const;
  Vec3 tip() const;
  Vec3 ball_offset() const;  ///< tip to ball centre

  const CycleContext& context_;
  WorkingPlane plane_;
  machine::ProbeSystem probe_;
  double scale_;  ///< machine mm per input mm
};

/// @errors 1008 and 1007: preset and alignment cycles do not work mirrored or scaled.
CycleResult<void> refuse_mirror_and_scaling(const machine::Frames& frames);

/// Sets Q115 to Q119 and notifies the host, after every programmed touch.
void publish_touch(const machine::MachineState& state, CycleHost& host,
                   const machine::ContactPoint& contact);

}  // namespace fitgauge::probing
