#pragma once

#include <optional>
#include <span>
#include <vector>

#include "machine/kinematics.hpp"

namespace fitgauge::probing {

/// The calibration sphere measured with the rotary axes at one position.
struct SpherePose {
  machine::Vec3 rotary;  ///< A, B, C in degrees
  machine::Vec3 nose;    ///< what X, Y, Z would show with the ball's centre in that of the sphere
};

/// The spherical tool that measured: a ball `length` mm from the spindle nose.
struct MeasuringTool {
  machine::Axis axis = machine::Axis::Z;
  double length = 0;
};

/// Where the sphere's centre lies on the table by a kinematic model: in machine coordinates with
/// all axes at zero.
machine::Vec3 on_table(const SpherePose& pose, const machine::Kinematics& model,
                       const MeasuringTool& tool);

/// The spread of sphere centres that should lie at one place of the table.
struct Spread {
  /// One coordinate's standard deviation over the degrees of freedom. Of two positions the distance
  /// between them: one position beside the reference has an error, but no standard deviation.
  double deviation = 0;
  machine::Vec3 centre;
  std::vector<machine::Vec3> errors;  ///< of each pose, on the table
};

/// @param parameters how many values of the model were fitted to the poses.
/// @pre there is a pose.
Spread spread(std::span<const SpherePose> poses, const machine::Kinematics& model,
              const MeasuringTool& tool, std::size_t parameters = 0);

/// What the poses say about one rotary axis: real minus modelled, in machine coordinates with all
/// axes at zero. What they cannot see has no value.
struct AxisErrors {
  machine::Axis axis = machine::Axis::C;
  std::optional<machine::Vec3> location;  ///< in mm across the axis, at the height of the sphere
  std::optional<machine::Vec3> tilt_deg;  ///< a rotation vector across the axis
  /// The variance of one measured centre over that of the location, in its worst direction; 0
  /// without a location.
  double valuation = 0;
};

struct KinematicsFit {
  machine::Kinematics corrected;   ///< the model with what was found
  std::vector<AxisErrors> errors;  ///< in the order asked for
  Spread before;                   ///< by the model
  Spread after;                    ///< by the corrected model
};

/// Location, and with `directions` the direction, of axes by least squares over the distances of
/// the sphere centres on the table from their mean (Gauss-Newton; the place of the sphere is
/// eliminated). A value that the singular value decomposition of the positions leaves undefined is
/// not determined: first directions are given up, then locations.
KinematicsFit fit_kinematics(std::span<const SpherePose> poses, const machine::Kinematics& model,
                             const MeasuringTool& tool, std::span<const machine::Axis> axes,
                             bool directions);

/// By how much more the axis is turned where its position was approached from above than where it
/// was approached from below, in degrees, by least squares. @pre both have the same positions.
double fit_backlash(std::span<const SpherePose> from_below, std::span<const SpherePose> from_above,
                    const machine::Kinematics& model, const MeasuringTool& tool,
                    machine::Axis axis);

/// The radius of the circle that the sphere and the ball describe around each other, in mm.
double measuring_radius(const machine::Vec3& sphere, const machine::RotaryAxis& axis,
                        const MeasuringTool& tool);

}  // namespace fitgauge::probing
