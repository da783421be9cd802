#pragma once

#include "nc/machine/frames.hpp"

namespace fitgauge::probing {

/// The calibration sphere measured with the rotary axes at one position.
struct SpherePose {
  machine::Vec3 rotary;  ///< A, B, C in degrees
  machine::Vec3 nose;    ///< display of X, Y, Z with the ball's centre in the sphere's centre
};

/// Comparable poses of one axis. The other axes rest elsewhere in each group, so each group has a
/// separate place of the sphere.
using PoseGroup = std::vector<SpherePose>;

/// The spherical tool that measured: a ball `length` mm from the spindle nose.
struct MeasuringTool {
  machine::Axis axis = machine::Axis::Z;
  double length = 0;
};

/// The sphere's centre on the table by a model: in machine coordinates with all axes at zero.
machine::Vec3 on_table(const SpherePose& pose, const machine::Kinematics& model,
                       const MeasuringTool& tool);

/// Spread of sphere centres that should coincide on the table.
struct Spread {
  /// Root mean square of the errors in space (decision 26). Of two positions the distance between
  /// them: a single position has an error, but no dispersion.
  double deviation = 0;
  machine::Vec3 centre;
  std::vector<machine::Vec3> errors;  ///< of each pose, on the table
};

/// @pre there is a pose.
Spread spread(const PoseGroup& poses, const machine::Kinematics& model, const MeasuringTool& tool);

/// An error of an axis, real minus modelled, in machine coordinates with all axes at zero.
struct FoundError {
  machine::Vec3 value;
  /// Half of the interval in which each coordinate is with a probability of 95 %, by the scatter of
  /// the poses (Student). Resting axes between this axis and the sphere, or the tool, add their
  /// scatter, like a pose.
  machine::Vec3 uncertainty;
  double size = 0;                  ///< of the value: mm, or mm at 100 mm of a direction
  double standard_uncertainty = 0;  ///< along the value, in its unit
  /// true if it is at least twice its standard uncertainty, or that is less than a nanometre; in a
  /// fit of significant errors: it is corrected.
  bool is_significant = true;
};

enum class ErrorKind : std::uint8_t { Location, Direction, Zero };

/// The result of the poses for one rotary axis. Quantities that they cannot show have no value.
struct AxisErrors {
  machine::Axis axis = machine::Axis::C;
  /// By their kind: the location in mm across the axis, at the height of the sphere; the direction
  /// and the zero as rotation vectors in degrees, across and along the axis.
  std::array<std::optional<FoundError>, 3> found{};
  /// Variance of one measured centre divided by the variance of the location, in its worst
  /// direction; 0 without a location.
  double valuation = 0;

  auto& operator[](ErrorKind kind) { return found.at(static_cast<std::size_t>(kind)); }
  const auto& operator[](ErrorKind kind) const { return found.at(static_cast<std::size_t>(kind)); }
  const std::optional<FoundError>& location() const { return found.front(); }
  bool is_significant() const {
    return std::ranges::all_of(found,
                               [](const auto& each) { return !each || each->is_significant; });
  }
};

struct KinematicsFit {
  machine::Kinematics corrected;   ///< the corrected model
  bool is_corrected = false;       ///< something was found and is corrected
  std::vector<AxisErrors> errors;  ///< in the order asked for
  std::vector<Spread> before;      ///< of each group, by the model
  std::vector<Spread> after;       ///< by the corrected model
};

struct FitOptions {
  bool directions = true;  ///< of the axes, in addition to their locations
  /// With directions: the tilt of a fitted axis around its carrier, which is also fitted, counts as
  /// the error of the carrier's zero.
  bool zeros = false;
  bool only_significant = false;  ///< corrects no error that is not significant
};

/// Location, and with `directions` the direction, of all axes together by least squares over the
/// distances of the sphere centres on the table from the mean of their group (Gauss-Newton; the
/// places of the sphere are eliminated): exact whatever the order of the axes and wherever the
/// others stand (decision 26). A value that the singular value decomposition of the positions
/// leaves undefined is not determined: first directions and zeros are given up, then locations.
KinematicsFit fit_kinematics(std::span<const PoseGroup> groups, const machine::Kinematics& model,
                             const MeasuringTool& tool, std::span<const machine::Axis> axes,
                             const FitOptions& options);

/// Difference of the axis angle between approaches from above and from below, in degrees, by least
/// squares. @pre both have the same positions.
double fit_backlash(const PoseGroup& from_below, const PoseGroup& from_above,
                    const machine::Kinematics& model, const MeasuringTool& tool,
                    machine::Axis axis);

/// Position error of the axis, in degrees: the mean size of the errors along the measuring circle
/// divided by its radius, by that model.
double mean_positioning_error(const PoseGroup& poses, const machine::Kinematics& model,
                              const MeasuringTool& tool, machine::Axis axis);

/// The radius of the circle that the sphere and the ball describe around each other, in mm.
double measuring_radius(const machine::Vec3& sphere, const machine::RotaryAxis& axis,
                        const MeasuringTool& tool);

}  // namespace fitgauge::probing
