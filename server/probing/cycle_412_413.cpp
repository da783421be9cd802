#include <array>

#include "probing/circle_probing.hpp"
#include "probing/cycles.hpp"
#include "probing/preset_circle.hpp"
#include "probing/preset_cycle.hpp"

namespace fitgauge::probing {
namespace {

using namespace parameter;

constexpr std::array kParameters =
    join(join(std::array{coordinate(321, "Centre, main axis"),
                         coordinate(322, "Centre, secondary axis"), length(262, "Nominal diameter"),
                         angle(325, "Starting angle", 360, 0), angle(247, "Stepping angle", 120),
                         kMeasuringHeight, kSetUpClearance, kClearanceHeight, kMoveToClearance},
              kPlaneDatum),
         std::array{newer(choice(423, "Number of touches", 3, 4, 4)),
                    newer(choice(365, "Traverse: 0 line, 1 arc", 0, 1, 1))});

CycleResult<void> set_datum(const CycleContext& context, Side side) {
  const Arguments& arguments = context.arguments;
  auto motion = begin_preset(context);
  if (!motion) return motion.error();
  const auto plan =
      circle_plan(arguments, *motion, side, {arguments.number(321), arguments.number(322)},
                  arguments.number(262));
  if (!plan) return plan.error();
  const auto contacts = motion->touch_all(circle_touches(*plan), arguments.number(260));
  if (!contacts) return contacts.error();
  const auto circle = circle_through(*contacts, side, motion->ball_radius());
  if (!circle) return circle.error();
  publish_circle(context, side, *circle, contacts->size());
  return finish_preset(context, *motion, plane_datum(arguments, circle->centre));
}

}  // namespace

constinit const TouchProbeCycle kCycle412{
    {.number = 412,
     .name = "DATUM INSIDE CIRCLE",
     .kind = CycleKind::Preset,
     .parameters = kParameters,
     .results = kPresetCircleResults,
     .simulated = "All parameters."},
    [](const CycleContext& context) { return set_datum(context, Side::Inside); }};

constinit const TouchProbeCycle kCycle413{
    {.number = 413,
     .name = "DATUM OUTSIDE CIRCLE",
     .kind = CycleKind::Preset,
     .parameters = kParameters,
     .results = kPresetCircleResults,
     .simulated = "All parameters."},
    [](const CycleContext& context) { return set_datum(context, Side::Outside); }};

}  // namespace fitgauge::probing
