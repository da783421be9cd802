#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/line_probing.hpp"

namespace fitgauge::probing::cycle_403 {

using machine::Axis;
using namespace parameter;

constexpr std::array kParameters =
    join(line(kMeasuringAxis),
         std::array{choice(312, "Rotary axis: 0 by the measuring axis, 4 A, 5 B, 6 C", 0, 6, 0),
                    choice(337, "Set the axis to zero: 0 no, 1 yes", 0, 1, 0), kTableRow, kTransfer,
                    newer(angle(380, "Reference angle", 360, 0))});

constexpr std::array<CycleOutput, 1> kResults{{{150, "Measured angle", Unit::Angle}}};

/// The axis around which the line is turned, and the right-handed angle.
struct Misalignment {
  Axis around;
  double angle_deg;
};

Misalignment misalignment(const ProbedLine& edge, const WorkingPlane& plane) {
  if (edge.axis != 2) return {plane.probe, edge.angle_deg()};
  // From the secondary to the probe axis it is right-handed around the main axis; from the main
  // axis left-handed around the secondary one.
  if (edge.across == 1) return {plane.main, edge.angle_deg()};
  return {plane.secondary, -edge.angle_deg()};
}

CycleResult<void> zero(const CycleContext& context, Axis rotary) {
  const Arguments& arguments = context.arguments;
  const int row = arguments.whole(305);
  if (row == 0 || arguments.whole(303) != 0) return zero_rotary_axis(context, rotary, row);
  machine::AxisWords offset;
  offset[rotary] = context.machine.position(machine::CoordinateSystem::Workpiece)[rotary];
  return context.host.write_datum(row, offset);
}

CycleResult<void> align(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const int wanted = arguments.whole(312);
  if (wanted > 0 && wanted < 4) return nc_error(1019, "Q312 is 0, 4 (A), 5 (B) or 6 (C)");
  auto motion = TRY(begin_alignment(context));
  const auto edge = TRY(probe_line(context, motion));
  const auto [around, angle] = misalignment(edge, motion.plane());
  const Axis rotary = rotary_axis_around(around);
  if (wanted != 0 && rotary != static_cast<Axis>(wanted - 1)) {
    return nc_error(1019, "this rotary axis does not turn the measured line");
  }
  context.host.set_q(150, to_angle(angle), Unit::Angle);
  const bool in_plane = around == motion.plane().probe;
  const double target = in_plane ? arguments.number(380) : 0;
  TRY(align_rotary_axis(context, rotary, angle - target));
  return arguments.whole(337) == 0 ? CycleResult<void>() : zero(context, rotary);
}

constinit const TouchProbeCycle kCycle403 =
    cycle(403, "ROT IN ROTARY AXIS", CycleKind::Alignment, kParameters, kResults,
          errors::kUnscaled | ErrorSet{1019, 1042, 1043, 1081, 1085, 1100}, align,
          "All parameters. Q380 counts in the working plane.",
          "Rotary axes of a head: they cannot turn the workpiece.");

}  // namespace fitgauge::probing::cycle_403
