#include <array>

#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/probing/touch/single_touch.hpp"

namespace fitgauge::probing::cycle_419 {

using namespace parameter;

constexpr std::array kParameters{coordinate(263, "Point, main axis"),
                                 coordinate(264, "Point, secondary axis"),
                                 kMeasuringHeight,
                                 kSetUpClearance,
                                 kClearanceHeight,
                                 kMeasuringAxis,
                                 kDirection,
                                 kTableRow,
                                 coordinate(333, "New datum", 0),
                                 kTransfer};

constexpr std::array<CycleOutput, 1> kResults{{{160, "Measured coordinate", Unit::Length}}};

CycleResult<void> set_datum(const CycleContext& context) {
  auto motion = begin_preset(context);
  if (!motion) return motion.error();
  const auto touched = touch_coordinate(context, *motion);
  if (!touched) return touched.error();
  return set_datum_of_axis(context, motion->plane(), touched->surface, touched->axis);
}

constinit const TouchProbeCycle kCycle419{
    {.number = 419,
     .name = "DATUM IN ONE AXIS",
     .kind = CycleKind::Preset,
     .parameters = kParameters,
     .results = kResults,
     .errors = errors::kTouching | errors::kUnscaled | errors::kDatumTransfer | ErrorSet{1042},
     .simulated = "All parameters."},
    set_datum};

}  // namespace fitgauge::probing::cycle_419
