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

CycleResult<void> in_probe_axis(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const Vec3 nominal{arguments.number(263), arguments.number(264), arguments.number(294)};
  const auto surface =
      TRY(touch_down(motion, nominal, arguments.number(320), arguments.number(260)));
  return set_datum_of_axis(context, motion.plane(), surface, 2);
}

CycleResult<void> in_one_axis(const CycleContext& context, ProbingMotion& motion) {
  const auto touched = TRY(touch_coordinate(context, motion));
  return set_datum_of_axis(context, motion.plane(), touched.surface, touched.axis);
}

constinit const TouchProbeCycle kCycle417 =
    cycle(417, "DATUM IN TS AXIS", CycleKind::Preset, k417Parameters, kResults,
          errors::kDatumTransfer, after<begin_preset, in_probe_axis>, "All parameters.");

constinit const TouchProbeCycle kCycle419 = cycle(
    419, "DATUM IN ONE AXIS", CycleKind::Preset, k419Parameters, kResults,
    errors::kDatumTransfer | ErrorSet{1042}, after<begin_preset, in_one_axis>, "All parameters.");

}  // namespace fitgauge::probing::cycle_417_419
