#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/probing/touch/circle_probing.hpp"
#include "nc/probing/touch/line_probing.hpp"

namespace fitgauge::probing::cycle_416_418 {

using namespace parameter;

constexpr std::array k416Parameters =
    join(join(kBoltCircle, kPlaneDatum), std::array{newer(kSetUpClearance)});

constexpr std::array k418Parameters = join(
    std::array{coordinate(268, "1st hole, main axis"), coordinate(269, "1st hole, secondary axis"),
               coordinate(270, "2nd hole, main axis"), coordinate(271, "2nd hole, secondary axis"),
               coordinate(316, "3rd hole, main axis"), coordinate(317, "3rd hole, secondary axis"),
               coordinate(318, "4th hole, main axis"), coordinate(319, "4th hole, secondary axis"),
               kMeasuringHeight, kClearanceHeight},
    kPlaneDatum);

constexpr std::array<CycleOutput, 2> k418Results{
    {{151, "Intersection, main axis", Unit::Length},
     {152, "Intersection, secondary axis", Unit::Length}}};

CycleResult<void> bolt_circle(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const auto probed = TRY(probe_bolt_circle(context, motion));
  publish_circle(context, Side::Inside, probed);
  return finish_preset(context, motion, plane_datum(arguments, probed.circle.centre));
}

CycleResult<void> four_holes(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  std::vector<Point2> nominal;
  for (const int main : {268, 270, 316, 318}) {
    nominal.push_back({arguments.number(main), arguments.number(main + 1)});
  }
  const auto holes =
      TRY(probe_hole_centres(motion, nominal, arguments.number(261), arguments.number(260)));
  const auto& centre = holes;
  const auto point = TRY(intersection(centre[0], centre[2], centre[1], centre[3]));
  set_length(context.host, 151, point.x);
  set_length(context.host, 152, point.y);
  return finish_preset(context, motion, plane_datum(arguments, point));
}

constinit const TouchProbeCycle kCycle416 =
    cycle(416, "DATUM CIRCLE CENTER", CycleKind::Preset, k416Parameters, kPresetCircleResults,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, bolt_circle>,
          "All parameters; holes are touched from their nominal centre, Q320 counts in the "
          "probe axis only.");

constinit const TouchProbeCycle kCycle418 =
    cycle(418, "DATUM FROM 4 HOLES", CycleKind::Preset, k418Parameters, k418Results,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, four_holes>,
          "All parameters; the lines join holes 1 and 3, 2 and 4.");

}  // namespace fitgauge::probing::cycle_416_418
