#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing::cycle_405 {

using namespace parameter;

constexpr std::array kParameters = join(
    circle(coordinate(321, "Centre, main axis"),
           coordinate(322,
                      "Centre, secondary axis; 0: the hole comes to the positive secondary axis")),
    std::array{choice(337,
                      "Set to zero: 0 the table, else the row of the datum table for its offset", 0,
                      9999, 0)});

constexpr std::array<CycleOutput, 1> kResults{{{150, "Measured angle", Unit::Angle}}};

double angle_of(Point2 point) { return machine::degrees(std::atan2(point.y, point.x)); }

CycleResult<void> align(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const Point2 nominal{arguments.number(321), arguments.number(322)};
  const auto probed = TRY(probe_circle(context, motion, Side::Inside, nominal));
  const double wanted = nominal.y == 0 ? 90 : angle_of(nominal);
  const double misalignment = std::remainder(angle_of(probed.circle.centre) - wanted, 360);
  context.host.set_q(150, to_angle(misalignment), Unit::Angle);
  const machine::Axis table = rotary_axis_around(motion.plane().probe);
  TRY(align_rotary_axis(context, table, misalignment));
  const int row = arguments.whole(337);
  if (row == 0) return zero_rotary_axis(context, table, 0);
  machine::AxisWords offset;
  offset[table] = to_angle(misalignment);
  return context.host.write_datum(row, offset);
}

constinit const TouchProbeCycle kCycle405 =
    cycle(405, "ROT IN C AXIS", CycleKind::Alignment, kParameters, kResults,
          errors::kUnscaled | errors::kCircle | ErrorSet{1043, 1100}, after<begin_alignment, align>,
          "All parameters; the datum must lie in the centre of the table.");

}  // namespace fitgauge::probing::cycle_405
