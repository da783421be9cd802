#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing::cycle_412_413 {

using namespace parameter;

constexpr std::array kParameters = join(
    join(circle(coordinate(321, "Centre, main axis"), coordinate(322, "Centre, secondary axis")),
         kPlaneDatum),
    std::array{kTouches, kTraverse});

CycleResult<void> set_datum(const CycleContext& context, ProbingMotion& motion, Side side) {
  const Arguments& arguments = context.arguments;
  const auto probed =
      TRY(probe_circle(context, motion, side, {arguments.number(321), arguments.number(322)}));
  publish_circle(context, side, probed);
  return finish_preset(context, motion, plane_datum(arguments, probed.circle.centre));
}

constinit const TouchProbeCycle kCycle412 =
    cycle(412, "DATUM INSIDE CIRCLE", CycleKind::Preset, kParameters, kPresetCircleResults,
          errors::kDatumTransfer | errors::kCircle, after<begin_preset, set_datum, Side::Inside>,
          "All parameters.");

constinit const TouchProbeCycle kCycle413 =
    cycle(413, "DATUM OUTSIDE CIRCLE", CycleKind::Preset, kParameters, kPresetCircleResults,
          errors::kDatumTransfer | errors::kCircle, after<begin_preset, set_datum, Side::Outside>,
          "All parameters.");

}  // namespace fitgauge::probing::cycle_412_413
