#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/line_probing.hpp"

namespace fitgauge::probing::cycle_400_404 {

using namespace parameter;

constexpr std::array kParameters =
    join(line(kMeasuringAxisInPlane), std::array{kReferenceAngle, kPresetRow});

CycleResult<void> rotate(const CycleContext& context, ProbingMotion& motion) {
  const auto edge = TRY(probe_line(context, motion));
  double angle = workpiece_angle(context.machine.state().frames, motion.plane(), edge.direction()) -
                 context.arguments.number(307);
  // Along the secondary axis, that axis is the reference line, with Q307 = 90 or 0.
  if (edge.axis == 0) angle -= 90 * std::round(angle / 90);
  const Vec3 rotation = turned_rotation(context.machine.state().frames, motion.plane(), angle);
  return set_basic_rotation(context, rotation, context.arguments.whole(305));
}

CycleResult<void> set_rotation(const CycleContext& context) {
  TRY(ProbingMotion::begin(context));
  Vec3 rotation;
  rotation[index(context.machine.state().tool_axis())] = to_angle(context.arguments.number(307));
  return set_basic_rotation(context, rotation, context.arguments.whole(305));
}

constexpr std::array k404Parameters{
    kReferenceAngle,
    newer(choice(305, "Row of the preset table, 0 active at once, -1 row of the active preset", -1,
                 kLastRow, -1))};

constinit const TouchProbeCycle kCycle400 =
    cycle(400, "BASIC ROTATION", CycleKind::Alignment, kParameters, {},
          errors::kUnscaled | ErrorSet{1042, 1081, 1085}, after<begin_alignment, rotate>,
          "All parameters. With Q272 = 1 the line is compared with the secondary axis.");

constinit const TouchProbeCycle kCycle404 =
    cycle(404, "SET BASIC ROTATION", CycleKind::Alignment, k404Parameters, {},
          errors::kWithProbe | ErrorSet{1085}, set_rotation, "All parameters. No motion.");

}  // namespace fitgauge::probing::cycle_400_404
