#pragma once

#include "nc/probing/kinematics/fit.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// Turns the rotary axes and measures the calibration sphere at its new place. Before a turn the
/// probe moves to the retraction height Q408 over the sphere's place at zero, or with Q408 = 0 it
/// circles the sphere while the axes turn. A tilted plane and TCPM are switched off, as on the
/// control. Linear moves run at Q253, at most at the rapid of the probe. Not thread-safe; lives
/// within one execution. After an error the machine stops where it is.
class KinematicsProbing {
 public:
  /// The sphere is expected at the zero of the active preset.
  /// @errors 1082 Q408 = 0 without the option of TCPM or on a machine with Hirth axes, or a height
  ///   inside the sphere; those of ProbingMotion::begin.
  static CycleResult<KinematicsProbing> begin(const CycleContext& context);

  /// The ball's centre, and its distance from the nose in mm.
  MeasuringTool tool() const { return {state().tool_axis(), probe_.length - probe_.radius}; }
  /// Expected place of the sphere with all axes at zero, in machine coordinates.
  const Vec3& sphere() const { return sphere_; }

  /// Finds the sphere below the probe, at the present position of the axes: touches down once, then
  /// measures it.
  CycleResult<void> find();
  /// Turns without measuring. @errors 1101 beyond the traverse range, faults of the machine.
  CycleResult<void> turn(const Vec3& rotary);
  /// Turns and measures: touches from above, then Q423 times around the sphere from the angle Q380
  /// on. Ends above it.
  /// @errors those of turn; 1014 no contact, 1072 the measured radius differs from Q407 by more
  ///   than max_calibration_ball_deviation_mm.
  CycleResult<SpherePose> measure(const Vec3& rotary);
  /// Retracts to the height before a turn.
  CycleResult<void> retract();

 private:
  explicit KinematicsProbing(const CycleContext& context)
      : context_(context),
        probe_(*context.state().probe_system()),
        sphere_(context.state().frames.preset().origin) {}

  const machine::MachineState& state() const { return context_.state(); }
  bool follows() const { return context_.number(408) == 0; }
  /// Sphere to start of a touch, centre to centre: both radii, SET_UP and Q320.
  double start_distance() const {
    return context_.number(407) + probe_.radius + (probe_.data.set_up + context_.number(320));
  }
  Vec3 tool_direction() const;  ///< from the tip to the nose
  machine::Feed feed() const;
  Vec3 expected(const Vec3& rotary) const;
  Vec3 around(double angle_deg) const;  ///< a unit vector across the tool

  // Points are in machine coordinates; "over" is along the tool.
  CycleResult<void> move(const machine::AxisWords& words, const machine::Feed& feed);
  CycleResult<void> move_tip(const Vec3& tip);
  CycleResult<void> move_ball(const Vec3& centre);
  CycleResult<void> go_over(const Vec3& sphere);
  CycleResult<Vec3> touch(const Vec3& direction);
  CycleResult<Vec3> measure_sphere(const Vec3& sphere);
  CycleResult<SpherePose> measure_here();
  void publish_targets(const Vec3& rotary);
  CycleResult<void> circle(const Vec3& rotary);

  const CycleContext& context_;
  machine::ProbeSystem probe_;
  Vec3 sphere_;
};

}  // namespace fitgauge::probing
