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

/// A block's settings of one rotary axis, and its positions.
struct AxisPlan {
  machine::Axis axis = machine::Axis::A;
  double start = 0;                 ///< degrees
  double end = 0;                   ///< degrees
  double incidence = 0;             ///< its position while other axes are measured, in degrees
  int points = 0;                   ///< 0: it is not measured
  bool strobed = false;             ///< positioned by an M function (mStrobeRotAxPos, decision 19)
  double grid = 0;                  ///< of a Hirth axis, in degrees; 0 is none
  std::vector<double> positions{};  ///< in order; 0 is left out, the reference is measured there

  bool is_measured() const { return points > 0; }
};

/// Returns `points` positions from `start` to `end` at equal steps. A Hirth axis stops at the
/// nearest multiple of its grid; of two as near, at the one farther from zero (decision 5).
std::vector<double> measuring_positions(double start, double end, int points, double grid);

/// Plans the rotary axes of the machine, in the order A, B, C; settings of other axes are ignored.
/// @errors 1005 an axis that an M function positions is not at 0, 1100 the machine has no rotary
///   axis, 1101 a position, or its approach for backlash (Q432) on either side, is outside the
///   range of its axis.
CycleResult<std::vector<AxisPlan>> plan_positions(const Arguments& arguments,
                                                  const machine::MachineState& state);

/// The measurements of one rotary axis.
struct AxisMeasurement {
  AxisPlan plan;
  double radius = 0;                 ///< of the measuring circle, in mm
  double positioning_error_deg = 0;  ///< mean, by the corrected kinematics
  std::optional<double> backlash_deg{};
  std::string_view no_backlash{};  ///< why there is none
};

struct KinematicsMeasurement {
  std::vector<AxisMeasurement> axes;  ///< measured axes, in the order A, B, C
  std::vector<PoseGroup> poses;       ///< of each: the reference at 0 first, then its positions
  KinematicsFit fit;  ///< of the active kinematics to them: `after` is that of a next measurement
};

/// Measures the planned axes one after the other, the others at their angle of incidence: with
/// backlash (Q432) each position is approached from both sides, and the first side counts.
/// Evaluates all axes together (decision 26).
/// @errors those of KinematicsProbing::measure.
CycleResult<KinematicsMeasurement> measure_kinematics(const CycleContext& context,
                                                      KinematicsProbing& probing,
                                                      std::span<const AxisPlan> plans,
                                                      const FitOptions& options);

/// Q141 to Q149, always in mm; -1 for axes that were not measured.
void write_kinematics_results(CycleHost& host, const KinematicsMeasurement& measurement,
                              const Vec3& offset);

/// Corrections that the machine allows: with insignificant_corrections "note" all of them.
FitOptions fit_options(const CycleContext& context, bool directions);

/// Applies the corrected model to the machine, if there are corrections, and notes the omitted
/// ones. A correction beyond max_modification_mm waits for NC Start; if a stop ends the run nothing
/// is corrected.
/// @errors 1102 errors were found, and none of them is at least twice its uncertainty.
CycleResult<void> correct_kinematics(const CycleContext& context, const KinematicsFit& fit);

/// Q431: whether the active preset is set into the centre of the sphere before measuring, after it,
/// or both. Its zero then is the centre with all rotary axes at 0.
class PresetAtSphere {
 public:
  explicit PresetAtSphere(int q431)
      : sets_before_(q431 == 1 || q431 == 3), sets_after_(q431 >= 2) {}

  /// @errors 1085 the preset that is to be set is write-protected.
  CycleResult<void> check(const CycleContext& context) const;
  /// Finds the sphere below the probe and sets the preset, if that is asked for.
  CycleResult<void> before(const CycleContext& context, KinematicsProbing& probing) const;
  /// Turns all axes to 0, sets the preset if that is asked for, and retracts.
  CycleResult<void> after(const CycleContext& context, KinematicsProbing& probing) const;

 private:
  bool sets_before_;
  bool sets_after_;
};

/// Adds a measurement to TCHPR451.html (with the cycle's number) in the program's folder: for each
/// axis its positions with errors before and after, standard deviations, results and undetermined
/// values. Lengths in mm, also in an INCH program.
/// @param mode in words
/// @param directions were asked for
/// @param shift of the preset, in mm, that was compensated
/// @errors if the run's output budget is used up.
CycleResult<void> log_kinematics(const CycleContext& context, std::string_view mode,
                                 const KinematicsMeasurement& measurement, bool directions,
                                 const std::optional<Vec3>& shift = std::nullopt);

/// Writes the log of axes that were measured together.
CycleResult<void> log_grid(const CycleContext& context, std::string_view mode,
                           std::span<const SpherePose> poses, const KinematicsFit& fit);

}  // namespace fitgauge::probing
