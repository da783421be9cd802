#pragma once

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// Touches the calibration sphere at any position of the rotary axes. Points are centres of the
/// ball in machine coordinates; "above" is along the tool. Linear moves run at Q253, at most at the
/// rapid of the probe. Not thread-safe; lives within one execution. After an error the machine
/// stops where it is.
class SphereProbe {
 public:
  /// @errors those of ProbingMotion::begin.
  static CycleResult<SphereProbe> begin(const CycleContext& context);

  /// Sphere to start of a touch, centre to centre: both radii, SET_UP and Q320.
  double start_distance() const { return sphere_radius_ + probe_.radius + clearance_; }
  /// Distance from the sphere's centre to the tip for circling: the ball stays clear of the sphere
  /// on either side of the tip.
  double circling_distance() const { return sphere_radius_ + 2 * probe_.radius + clearance_; }

  /// Unit vector from the tip to the nose.
  Vec3 tool_direction() const;
  /// Returns the distance from nose to ball in mm.
  double ball_length() const { return probe_.length - probe_.radius; }

  /// Moves over a sphere: up, if need be, across, down.
  CycleResult<void> go_over(const Vec3& sphere, double distance);
  /// Moves straight.
  CycleResult<void> move_ball(const Vec3& centre);
  CycleResult<void> move_tip(const Vec3& tip);

  /// Finds a sphere below the probe: touches down once.
  CycleResult<Vec3> find();
  /// Touches a sphere whose centre is expected at `sphere`: from above, then Q423 times around it
  /// from the angle Q380 on. Ends above it.
  /// @errors 1014 no contact, 1072 the measured radius differs from Q407 by more than 0.1 mm, 1101
  ///   beyond the traverse range.
  CycleResult<Vec3> measure(const Vec3& sphere);

 private:
  explicit SphereProbe(const CycleContext& context);

  machine::Feed feed() const;
  CycleResult<Vec3> touch(const Vec3& direction);
  Vec3 ball() const;
  Vec3 around(double angle_deg) const;  ///< a unit vector across the tool

  machine::Machine& machine_;
  CycleHost& host_;
  machine::ProbeSystem probe_;
  double sphere_radius_;
  double clearance_;  ///< SET_UP + Q320
  double feed_;       ///< Q253
  double first_angle_;
  int touches_;
};

/// Lifts a result like `lift`; a move beyond the range of an axis is error 1101.
CycleResult<void> lift_move(const machine::MachineResult<void>& moved);

}  // namespace fitgauge::probing
