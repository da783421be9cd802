#include <array>

#include "nc/probing/calibration/probe_calibration.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"

namespace fitgauge::probing::cycle_462_463 {

using namespace parameter;

constexpr std::array k462Parameters{kStandardRadius, kSetUpClearance, kStandardTouches,
                                    kFirstAngle};
constexpr std::array k463Parameters{kStandardRadius, kSetUpClearance, kMoveToClearance,
                                    kStandardTouches, kFirstAngle};

/// The height of the ball centre: in a ring where it stands. A stud's upper edge is taken to lie
/// the clearance below the probe, and is touched one ball diameter lower.
double measuring_height(ProbeCalibrator& calibrator, Side side, double q320) {
  const ProbingMotion& motion = calibrator.motion();
  const double height = calibrator.start().z;
  if (side == Side::Inside) return height + motion.ball_radius();
  return height - motion.start_distance(q320) - motion.ball_radius();
}

CycleResult<void> calibrate(const CycleContext& context, Side side) {
  const Arguments& arguments = context.arguments;
  auto calibrator = ProbeCalibrator::begin(context);
  if (!calibrator) return calibrator.error();
  const double height = measuring_height(*calibrator, side, arguments.number(320));
  const auto measured = calibrator->measure(
      [&](Point2 near) { return calibrator->touch_around(side, near, height); });
  if (!measured) return measured.error();
  const double radius = measured->mean.radius - arguments.number(407);
  return calibrator->finish({.radius = side == Side::Inside ? -radius : radius,
                             .centre_offset = calibrator->corrected_offset(measured->error),
                             .residual = measured->mean.residual});
}

constinit const TouchProbeCycle kCycle462{
    {.number = 462,
     .name = "CALIBRATION OF TS IN RING",
     .kind = CycleKind::Calibration,
     .parameters = k462Parameters,
     .errors = errors::kTouching | errors::kUnscaled | ErrorSet{1075, 1080},
     .simulated = "From a position in the ring at measuring height, twice with the spindle turned "
                  "by 180 degrees; effective radius, CAL_OF1, CAL_OF2. The log TCHPRAUTO.html."},
    [](const CycleContext& context) { return calibrate(context, Side::Inside); }};

constinit const TouchProbeCycle kCycle463{
    {.number = 463,
     .name = "TS CALIBRATION ON STUD",
     .kind = CycleKind::Calibration,
     .parameters = k463Parameters,
     .errors = errors::kTouching | errors::kUnscaled | ErrorSet{1075, 1080},
     .simulated =
         "From a position SET_UP + Q320 above the stud, which is touched one ball diameter "
         "below its edge, twice with the spindle turned by 180 degrees; effective radius, "
         "CAL_OF1, CAL_OF2. The log TCHPRAUTO.html."},
    [](const CycleContext& context) { return calibrate(context, Side::Outside); }};

}  // namespace fitgauge::probing::cycle_462_463
