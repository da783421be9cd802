#pragma once

#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing {

namespace parameter {

/// Parameters of 460, 462 and 463 for touching a standard.
inline constexpr CycleParameter kStandardRadius{.id = q(407),
                                                .meaning = "Exact radius of the standard",
                                                .unit = Unit::Length,
                                                .range = {0.0001, 99.9999}};
inline constexpr CycleParameter kStandardTouches = choice(423, "Number of touches", 3, 8, 4);
inline constexpr CycleParameter kFirstAngle{.id = q(380),
                                            .meaning = "Angle of the first touch",
                                            .unit = Unit::Angle,
                                            .range = {0, 360},
                                            .default_value = 0};

}  // namespace parameter

/// The circle, or sphere, of the ball centres around a standard as the control computes them with
/// the probe data it has; in plane coordinates.
struct RoundStandard {
  Point2 centre;
  double height = 0;    ///< of a sphere's centre
  double radius = 0;    ///< of the ball centres, not of the surface
  double residual = 0;  ///< largest distance of a touch from the circle
};

/// A standard measured with the spindle at 0 and at 180 degrees.
struct ReversalResult {
  RoundStandard mean;
  machine::Vec3 error;  ///< of CAL_OF1 and CAL_OF2: to be added, in machine coordinates
};

/// The result of a calibration; values it does not determine stay as they are in the tables.
struct ProbeCalibration {
  std::optional<double> radius{};                        ///< effective ball radius, in mm
  std::optional<std::array<double, 2>> centre_offset{};  ///< CAL_OF1, CAL_OF2, with CAL_ANG 0
  std::optional<double> length{};                        ///< effective length, in mm
  double residual = 0;
};

/// The calibration of the touch probe in the spindle, which is above or in the standard. The
/// computed ball centre is off by the error of CAL_OF1 and CAL_OF2, and to the other side after the
/// spindle turns by 180 degrees: the middle of both is right. Not thread-safe; lives within one
/// execution. After an error no table has changed.
class ProbeCalibrator {
 public:
  using Pass = std::function<CycleResult<RoundStandard>(Point2 near)>;

  /// @errors 1007 and 1008 with scaling or mirror active, 1075 in a tilted plane, and those of
  ///   ProbingMotion::begin.
  static CycleResult<ProbeCalibrator> begin(const CycleContext& context);

  ProbingMotion& motion() { return motion_; }
  /// Position of the ball's south pole at the beginning, in plane coordinates: its height is the
  /// clearance height.
  const Vec3& start() const { return start_; }

  /// Touches Q423 times around a point from the angle Q380 on, the ball centre at `height`.
  CycleResult<RoundStandard> touch_around(Side side, Point2 centre, double height);

  /// Probes once from the current position to find the standard, then once at its centre for each
  /// position of the spindle. Ends at the clearance height over the centre.
  CycleResult<ReversalResult> measure(const Pass& pass);

  /// Writes tool.t and tchprobe.tp, then the log TCHPRAUTO.html.
  /// @errors 1080 a radius or length that is not positive.
  CycleResult<void> finish(const ProbeCalibration& found);

  /// CAL_OF1 and CAL_OF2 for spindle angle 0, with their error corrected.
  std::array<double, 2> corrected_offset(const Vec3& error) const;

 private:
  ProbeCalibrator(const CycleContext& context, const ProbingMotion& motion);

  CycleResult<RoundStandard> turned(double spindle_deg, const Pass& pass, Point2 near);
  CycleResult<void> move_over(Point2 centre);

  const CycleContext& context_;
  ProbingMotion motion_;
  Vec3 start_;
};

}  // namespace fitgauge::probing
