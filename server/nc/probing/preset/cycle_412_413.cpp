#include <array>

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

CycleResult<void> set_datum(const CycleContext& context, Side side) {
  const Arguments& arguments = context.arguments;
  auto motion = begin_preset(context);
  if (!motion) return motion.error();
  const auto probed =
      probe_circle(context, *motion, side, {arguments.number(321), arguments.number(322)});
  if (!probed) return probed.error();
  publish_circle(context, side, *probed);
  return finish_preset(context, *motion, plane_datum(arguments, probed->circle.centre));
}

constinit const TouchProbeCycle kCycle412{
    {.number = 412,
     .name = "DATUM INSIDE CIRCLE",
     .kind = CycleKind::Preset,
     .parameters = kParameters,
     .results = kPresetCircleResults,
     .errors = errors::kTouching | errors::kUnscaled | errors::kDatumTransfer | errors::kCircle,
     .simulated = "All parameters."},
    [](const CycleContext& context) { return set_datum(context, Side::Inside); }};

constinit const TouchProbeCycle kCycle413{
    {.number = 413,
     .name = "DATUM OUTSIDE CIRCLE",
     .kind = CycleKind::Preset,
     .parameters = kParameters,
     .results = kPresetCircleResults,
     .errors = errors::kTouching | errors::kUnscaled | errors::kDatumTransfer | errors::kCircle,
     .simulated = "All parameters."},
    [](const CycleContext& context) { return set_datum(context, Side::Outside); }};

}  // namespace fitgauge::probing::cycle_412_413
