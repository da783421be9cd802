#pragma once

#include "nc/probing/kinematics/fit.hpp"
#include "nc/probing/kinematics/sphere.hpp"

namespace fitgauge::probing {

/// Turns the rotary axes and measures the calibration sphere at its new place. Before a turn the
/// probe moves to the retraction height Q408 over the sphere's place at zero, or with Q408 = 0 it
/// circles the sphere while the axes turn. A tilted plane and TCPM are switched off, as on the
/// control. Not thread-safe; lives within one execution. After an error the machine stops where it
/// is.
class KinematicsProbing {
 public:
  /// The sphere is expected at the zero of the active preset.
  /// @errors 1082 Q408 = 0 without the option of TCPM or on a machine with Hirth axes, or a height
  ///   inside the sphere; those of SphereProbe::begin.
  static CycleResult<KinematicsProbing> begin(const CycleContext& context);

  MeasuringTool tool() const { return {state().tool_axis(), probe_.ball_length()}; }
  /// Expected place of the sphere with all axes at zero, in machine coordinates.
  const Vec3& sphere() const { return sphere_; }

  /// Finds the sphere below the probe, at the present position of the axes.
  CycleResult<void> find();
  /// Turns without measuring. @errors 1101 beyond the traverse range, faults of the machine.
  CycleResult<void> turn(const Vec3& rotary);
  /// Turns and measures. @errors those of turn and of SphereProbe::measure.
  CycleResult<SpherePose> measure(const Vec3& rotary);
  /// Retracts to the height before a turn.
  CycleResult<void> retract();

 private:
  KinematicsProbing(const CycleContext& context, const SphereProbe& probe, bool follows);

  const machine::MachineState& state() const { return machine_.state(); }
  void publish_targets(const Vec3& rotary);
  CycleResult<void> turn_axes(const Vec3& rotary);
  CycleResult<void> circle(const Vec3& rotary);
  CycleResult<SpherePose> measure_here();
  Vec3 expected(const Vec3& rotary) const;

  machine::Machine& machine_;
  CycleHost& host_;
  SphereProbe probe_;
  double retraction_;  ///< Q408
  machine::Feed turning_feed_;
  bool follows_;
  Vec3 sphere_;
};

}  // namespace fitgauge::probing
