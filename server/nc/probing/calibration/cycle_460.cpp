#include "nc/probing/calibration/probe_calibration.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"

namespace fitgauge::probing::cycle_460 {

using namespace parameter;

constexpr std::array kParameters{
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

CycleResult<void> calibrate(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const double radius = arguments.number(407);
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const auto measured =
      calibrator.measure([&](Point2 near) { return touch_sphere(calibrator, radius, near); });
  if (!measured) return measured.error();

  const machine::ProbeSystem probe = *context.machine.state().probe_system();
  ProbeCalibration found{.radius = measured->mean.radius - radius,
                         .centre_offset = calibrator.corrected_offset(measured->error),
                         .residual = measured->mean.residual};
  if (arguments.whole(433) == 1) {
    // The ball centre is one radius above the south pole, where the length ends.
    const double too_high = measured->mean.height - arguments.number(434);
    found.length = probe.length + too_high + *found.radius - probe.radius;
  }
  return calibrator.finish(found);
}

constinit const TouchProbeCycle kCycle460 =
    cycle(460, "CALIBRATION OF TS ON A SPHERE", CycleKind::Calibration, kParameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, calibrate,
          "From a position above the sphere: its top and equator, twice with the spindle turned by "
          "180 degrees; effective radius, CAL_OF1, CAL_OF2 and, with Q433, the effective length. "
          "The "
          "log TCHPRAUTO.html.",
          "Q455: the model of the probe triggers alike in all directions.");

}  // namespace fitgauge::probing::cycle_460
