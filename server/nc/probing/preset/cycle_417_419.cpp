#include <array>

#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/probing/touch/line_probing.hpp"

namespace fitgauge::probing::cycle_417_419 {

using namespace parameter;

constexpr std::array k417Parameters{coordinate(263, "Point, main axis"),
                                    coordinate(264, "Point, secondary axis"),
                                    coordinate(294, "Point, probe axis"),
                                    kSetUpClearance,
                                    kClearanceHeight,
                                    kTableRow,
                                    coordinate(333, "New datum in the probe axis", 0),
                                    kTransfer};

constexpr std::array k419Parameters{coordinate(263, "Point, main axis"),
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

CycleResult<void> in_probe_axis(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  auto motion = begin_preset(context);
  if (!motion) return motion.error();
  const Vec3 nominal{arguments.number(263), arguments.number(264), arguments.number(294)};
  const auto surface = touch_down(*motion, nominal, arguments.number(320), arguments.number(260));
  if (!surface) return surface.error();
  return set_datum_of_axis(context, motion->plane(), *surface, 2);
}

CycleResult<void> in_one_axis(const CycleContext& context) {
  auto motion = begin_preset(context);
  if (!motion) return motion.error();
  const auto touched = touch_coordinate(context, *motion);
  if (!touched) return touched.error();
  return set_datum_of_axis(context, motion->plane(), touched->surface, touched->axis);
}

constinit const TouchProbeCycle kCycle417{
    {.number = 417,
     .name = "DATUM IN TS AXIS",
     .kind = CycleKind::Preset,
     .parameters = k417Parameters,
     .results = kResults,
     .errors = errors::kTouching | errors::kUnscaled | errors::kDatumTransfer,
     .simulated = "All parameters."},
    in_probe_axis};

constinit const TouchProbeCycle kCycle419{
    {.number = 419,
     .name = "DATUM IN ONE AXIS",
     .kind = CycleKind::Preset,
     .parameters = k419Parameters,
     .results = kResults,
     .errors = errors::kTouching | errors::kUnscaled | errors::kDatumTransfer | ErrorSet{1042},
     .simulated = "All parameters."},
    in_one_axis};

}  // namespace fitgauge::probing::cycle_417_419
