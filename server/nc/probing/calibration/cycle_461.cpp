#include <array>

#include "nc/probing/calibration/probe_calibration.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"

namespace fitgauge::probing::cycle_461 {

using namespace parameter;

constexpr std::array kParameters{
    coordinate(434, "Coordinate of the touched surface in the probe axis")};

CycleResult<void> calibrate(const CycleContext& context) {
  auto calibrator = ProbeCalibrator::begin(context);
  if (!calibrator) return calibrator.error();
  const auto contact = calibrator->motion().probe({0, 0, -1});
  if (!contact) return contact.error();
  const double too_high = contact->surface.z - context.arguments.number(434);
  return calibrator->finish({.length = context.machine.state().probe_system()->length + too_high});
}

constinit const TouchProbeCycle kCycle461{
    {.number = 461,
     .name = "TS CALIBRATION OF TOOL LENGTH",
     .kind = CycleKind::Calibration,
     .parameters = kParameters,
     .errors = errors::kTouching | errors::kUnscaled | ErrorSet{1075, 1080},
     .simulated = "One touch against the probe axis from where the probe stands, such as on the "
                  "calibration ring; the effective length. The log TCHPRAUTO.html."},
    calibrate};

}  // namespace fitgauge::probing::cycle_461
