#include "nc/probing/calibration/probe_calibration.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"

namespace fitgauge::probing::calibration_cycles {

using namespace parameter;

constexpr std::array k460Parameters{
    kStandardRadius,
    kSetUpClearance,
    kMoveToClearance,
    kStandardTouches,
    kFirstAngle,
    choice(433, "Calibrate the length: 0 no, 1 yes", 0, 1, 0),
    coordinate(434, "Coordinate of the sphere's centre in the probe axis", 0),
    newer(choice(455, "Number of points of the 3-D calibration", 0, 30, 0))};

/// The sphere through a horizontal circle and a point near its pole.
RoundStandard sphere_through(const RoundStandard& circle, const Vec3& pole) {
  const double beside = std::hypot(pole.x - circle.centre.x, pole.y - circle.centre.y);
  const double above = pole.z - circle.height;
  const double rise =
      (above * above + beside * beside - circle.radius * circle.radius) / (2 * above);
  return {circle.centre, circle.height + rise, std::hypot(circle.radius, rise), circle.residual};
}

/// Touches the sphere from above and around its equator.
CycleResult<RoundStandard> touch_sphere(ProbeCalibrator& calibrator, double radius, Point2 near) {
  ProbingMotion& motion = calibrator.motion();
  const double start_height = calibrator.start().z;
  const std::array down{Touch{.start = {near.x, near.y, start_height + motion.ball_radius()},
                              .direction = {0, 0, -1}}};
  const auto contacts = TRY(motion.touch_all(down, start_height));
  const Vec3 pole = contacts.front().ball_centre;
  const double equator = pole.z - (radius + motion.ball_radius());
  const auto circle = TRY(calibrator.touch_around(Side::Outside, near, equator));
  return sphere_through(circle, pole);
}

CycleResult<void> calibrate_on_sphere(const CycleContext& context) {
  const double radius = context.number(407);
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const auto measured =
      calibrator.measure([&](Point2 near) { return touch_sphere(calibrator, radius, near); });
  if (!measured) return measured.error();

  const machine::ProbeSystem probe = *context.state().probe_system();
  ProbeCalibration found{.radius = measured->mean.radius - radius,
                         .centre_offset = calibrator.corrected_offset(measured->error),
                         .residual = measured->mean.residual};
  if (context.whole(433) == 1) {
    // The ball centre is one radius above the south pole, where the length ends.
    const double too_high = measured->mean.height - context.number(434);
    found.length = probe.length + too_high + *found.radius - probe.radius;
  }
  return calibrator.finish(found);
}

constexpr std::array k461Parameters{
    coordinate(434, "Coordinate of the touched surface in the probe axis")};

CycleResult<void> calibrate_length(const CycleContext& context) {
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const auto contact = TRY(calibrator.motion().probe({0, 0, -1}));
  const double too_high = contact.surface.z - context.number(434);
  return calibrator.finish({.length = context.state().probe_system()->length + too_high});
}

constexpr std::array k462Parameters{kStandardRadius, kSetUpClearance, kStandardTouches,
                                    kFirstAngle};
constexpr std::array k463Parameters{kStandardRadius, kSetUpClearance, kMoveToClearance,
                                    kStandardTouches, kFirstAngle};

/// Returns the height of the ball centre. In a ring it is the present height. The upper edge of a
/// stud is assumed at the clearance below the probe, and is touched one ball diameter lower.
double measuring_height(ProbeCalibrator& calibrator, Side side, double q320) {
  const ProbingMotion& motion = calibrator.motion();
  const double height = calibrator.start().z;
  if (side == Side::Inside) return height + motion.ball_radius();
  return height - motion.start_distance(q320) - motion.ball_radius();
}

CycleResult<void> calibrate_radius(const CycleContext& context, Side side) {
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const double height = measuring_height(calibrator, side, context.number(320));
  const auto measured =
      calibrator.measure([&](Point2 near) { return calibrator.touch_around(side, near, height); });
  if (!measured) return measured.error();
  const double radius = measured->mean.radius - context.number(407);
  return calibrator.finish({.radius = side == Side::Inside ? -radius : radius,
                            .centre_offset = calibrator.corrected_offset(measured->error),
                            .residual = measured->mean.residual});
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(460, "CALIBRATION OF TS ON A SPHERE", CycleKind::Calibration, k460Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, calibrate_on_sphere,
          "From a position above the sphere: its top and equator, twice with the spindle turned by "
          "180 degrees; effective radius, CAL_OF1, CAL_OF2 and, with Q433, the effective length. "
          "The "
          "log TCHPRAUTO.html.",
          "Q455: the model of the probe triggers alike in all directions."),
    cycle(461, "TS CALIBRATION OF TOOL LENGTH", CycleKind::Calibration, k461Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, calibrate_length,
          "One touch against the probe axis from where the probe stands, such as on the "
          "calibration ring; the effective length. The log TCHPRAUTO.html."),
    cycle(462, "CALIBRATION OF TS IN RING", CycleKind::Calibration, k462Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, with<calibrate_radius, Side::Inside>,
          "From a position in the ring at measuring height, twice with the spindle turned "
          "by 180 degrees; effective radius, CAL_OF1, CAL_OF2. The log TCHPRAUTO.html."),
    cycle(463, "TS CALIBRATION ON STUD", CycleKind::Calibration, k463Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, with<calibrate_radius, Side::Outside>,
          "From a position SET_UP + Q320 above the stud, which is touched one ball diameter "
          "below its edge, twice with the spindle turned by 180 degrees; effective radius, "
          "CAL_OF1, CAL_OF2. The log TCHPRAUTO.html.")};

}  // namespace fitgauge::probing::calibration_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kCalibrationCycles = calibration_cycles::kCycles;
