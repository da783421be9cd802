#include "nc/probing/calibration/probe_calibration.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"

namespace fitgauge::probing::cycle_461_463 {

using namespace parameter;

constexpr std::array k461Parameters{
    coordinate(434, "Coordinate of the touched surface in the probe axis")};

CycleResult<void> calibrate_length(const CycleContext& context) {
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const auto contact = TRY(calibrator.motion().probe({0, 0, -1}));
  const double too_high = contact.surface.z - context.arguments.number(434);
  return calibrator.finish({.length = context.machine.state().probe_system()->length + too_high});
}

constinit const TouchProbeCycle kCycle461 =
    cycle(461, "TS CALIBRATION OF TOOL LENGTH", CycleKind::Calibration, k461Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, calibrate_length,
          "One touch against the probe axis from where the probe stands, such as on the "
          "calibration ring; the effective length. The log TCHPRAUTO.html.");

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
  const Arguments& arguments = context.arguments;
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const double height = measuring_height(calibrator, side, arguments.number(320));
  const auto measured =
      calibrator.measure([&](Point2 near) { return calibrator.touch_around(side, near, height); });
  if (!measured) return measured.error();
  const double radius = measured->mean.radius - arguments.number(407);
  return calibrator.finish({.radius = side == Side::Inside ? -radius : radius,
                            .centre_offset = calibrator.corrected_offset(measured->error),
                            .residual = measured->mean.residual});
}

constinit const TouchProbeCycle kCycle462 =
    cycle(462, "CALIBRATION OF TS IN RING", CycleKind::Calibration, k462Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, with<calibrate_radius, Side::Inside>,
          "From a position in the ring at measuring height, twice with the spindle turned "
          "by 180 degrees; effective radius, CAL_OF1, CAL_OF2. The log TCHPRAUTO.html.");

constinit const TouchProbeCycle kCycle463 =
    cycle(463, "TS CALIBRATION ON STUD", CycleKind::Calibration, k463Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, with<calibrate_radius, Side::Outside>,
          "From a position SET_UP + Q320 above the stud, which is touched one ball diameter "
          "below its edge, twice with the spindle turned by 180 degrees; effective radius, "
          "CAL_OF1, CAL_OF2. The log TCHPRAUTO.html.");

}  // namespace fitgauge::probing::cycle_461_463
