#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/probing/touch/rectangle_probing.hpp"

namespace fitgauge::probing::cycle_410_411 {

using namespace parameter;

constexpr std::array kParameters =
    join(std::array{coordinate(321, "Centre, main axis"), coordinate(322, "Centre, secondary axis"),
                    length(323, "Length, main axis"), length(324, "Length, secondary axis"),
                    kMeasuringHeight, kSetUpClearance, kClearanceHeight, kMoveToClearance},
         kPlaneDatum);

constexpr std::array<CycleOutput, 4> kResults{{{151, "Centre, main axis", Unit::Length},
                                               {152, "Centre, secondary axis", Unit::Length},
                                               {154, "Length, main axis", Unit::Length},
                                               {155, "Length, secondary axis", Unit::Length}}};

CycleResult<void> set_datum(const CycleContext& context, ProbingMotion& motion, Side side) {
  const Arguments& arguments = context.arguments;
  const RectanglePlan plan{.side = side,
                           .centre = {arguments.number(321), arguments.number(322)},
                           .length_main = arguments.number(323),
                           .length_secondary = arguments.number(324),
                           .height = arguments.number(261),
                           .start_distance = motion.start_distance(arguments.number(320)),
                           .via_clearance = arguments.whole(301) == 1};
  const auto rectangle = TRY(probe_rectangle(context, motion, plan, arguments.number(260)));
  set_length(context.host, 151, rectangle.centre.x);
  set_length(context.host, 152, rectangle.centre.y);
  set_length(context.host, 154, rectangle.length_main);
  set_length(context.host, 155, rectangle.length_secondary);
  return finish_preset(context, motion, plane_datum(arguments, rectangle.centre));
}

constinit const TouchProbeCycle kCycle410 =
    cycle(410, "DATUM INSIDE RECTAN.", CycleKind::Preset, kParameters, kResults,
          errors::kDatumTransfer, after<begin_preset, set_datum, Side::Inside>,
          "All parameters; moves at measuring height are paraxial.");

constinit const TouchProbeCycle kCycle411 =
    cycle(411, "DATUM OUTS. RECTAN.", CycleKind::Preset, kParameters, kResults,
          errors::kDatumTransfer, after<begin_preset, set_datum, Side::Outside>,
          "All parameters; moves at measuring height are paraxial.");

}  // namespace fitgauge::probing::cycle_410_411
