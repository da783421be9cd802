#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/preset/preset_cycle.hpp"

namespace fitgauge::probing::alignment_cycles {

using machine::Axis;
using namespace parameter;

constexpr std::array k400Parameters =
    list(line(kMeasuringAxisInPlane), kReferenceAngle, kPresetRow);

CycleResult<void> rotate(const CycleContext& context, ProbingMotion& motion) {
  const auto edge = TRY(probe_line(context, motion));
  double angle = workpiece_angle(context.state().frames, motion.plane(), edge.direction(),
                                 context.number(307));
  // Along the secondary axis, that axis is the reference line, with Q307 = 90 or 0.
  if (edge.axis == 0) angle = std::remainder(angle, 90);
  const Vec3 rotation = turned_rotation(context.state().frames, motion.plane(), angle);
  return set_basic_rotation(context, rotation, context.whole(305));
}

CycleResult<void> set_rotation(const CycleContext& context) {
  TRY(ProbingMotion::begin(context));
  Vec3 rotation;
  rotation[index(context.state().tool_axis())] = to_angle(context.number(307));
  return set_basic_rotation(context, rotation, context.whole(305));
}

constexpr std::array k404Parameters =
    list(kReferenceAngle,
         newer(choice(305, "Row of the preset table, 0 active at once, -1 row of the active preset",
                      -1, kLastRow, -1)));

constexpr std::array kCompensation =
    list(kReferenceAngle, kPresetRow,
         newer(choice(402, "Compensate by: 0 basic rotation, 1 turning the table", 0, 1, 0)),
         newer(choice(337, "Set the table to zero: 0 no, 1 yes", 0, 1, 0)));

constexpr std::array k401Parameters =
    list(coordinates(268, "1st hole, main axis", "1st hole, secondary axis", "2nd hole, main axis",
                     "2nd hole, secondary axis"),
         kMeasuringHeight, kClearanceHeight, kCompensation);

constexpr std::array k402Parameters = list(
    coordinates(268, "1st stud, main axis", "1st stud, secondary axis"),
    length(313, "Diameter of the 1st stud"), coordinate(261, "Measuring height of the 1st stud"),
    coordinates(270, "2nd stud, main axis", "2nd stud, secondary axis"),
    length(314, "Diameter of the 2nd stud"), coordinate(315, "Measuring height of the 2nd stud"),
    kSetUpClearance, kClearanceHeight, kMoveToClearance, kCompensation);

/// The angle of the line between two centres less Q307, as basic rotation or by turning the table.
CycleResult<void> compensate(const CycleContext& context, const WorkingPlane& plane,
                             const Vec3& first, const Vec3& second) {
  const Vec3 direction = second - first;
  if (direction == Vec3{}) return nc_error(1081, "both centres are the same");
  const double angle =
      workpiece_angle(context.state().frames, plane, direction, context.number(307));
  if (context.whole(402) == 0) {
    const Vec3 rotation = turned_rotation(context.state().frames, plane, angle);
    return set_basic_rotation(context, rotation, context.whole(305));
  }
  const machine::Axis table = rotary_axis_around(plane.probe);
  TRY(align_rotary_axis(context, table, angle));
  if (context.whole(337) == 0) return {};
  return zero_rotary_axis(context, table, context.whole(305));
}

CycleResult<void> two_holes(const CycleContext& context, ProbingMotion& motion) {
  const std::array nominal{place_of(context, 268, 269, 261), place_of(context, 270, 271, 261)};
  const auto holes = probe_hole_centres(context, motion, nominal);
  if (!holes) {
    const std::array places{PlannedPlace{Side::Inside, nominal[0]},
                            PlannedPlace{Side::Inside, nominal[1]}};
    return with_part(holes.error(), context, motion.plane(), places);
  }
  return compensate(context, motion.plane(), holes->front(), holes->back());
}

CycleResult<Vec3> stud_centre(const CycleContext& context, ProbingMotion& motion,
                              const Vec3& nominal, double diameter) {
  const auto touches = circle_touches({.side = Side::Outside,
                                       .centre = nominal,
                                       .diameter = diameter,
                                       .start_distance = motion.start_distance(),
                                       .via_clearance = context.whole(301) == 1});
  const auto contacts = TRY(touch_part(context, motion, touches, {Side::Outside, nominal}));
  const auto circle = TRY(circle_through(contacts, Side::Outside, motion.ball_radius()));
  return circle.centre;
}

CycleResult<void> two_studs(const CycleContext& context, ProbingMotion& motion) {
  const auto first =
      TRY(stud_centre(context, motion, place_of(context, 268, 269, 261), context.number(313)));
  const auto second =
      TRY(stud_centre(context, motion, place_of(context, 270, 271, 315), context.number(314)));
  return compensate(context, motion.plane(), first, second);
}

constexpr std::array k403Parameters =
    list(line(kMeasuringAxis),
         choice(312, "Rotary axis: 0 by the measuring axis, 4 A, 5 B, 6 C", 0, 6, 0),
         choice(337, "Set the axis to zero: 0 no, 1 yes", 0, 1, 0), kTableRow, kTransfer,
         newer(angle(380, "Reference angle", 360, 0)));

constexpr std::array kAngleResults = results(150, Unit::Angle, "Measured angle");

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
  const int row = context.whole(305);
  if (row == 0 || context.whole(303) != 0) return zero_rotary_axis(context, rotary, row);
  machine::AxisWords offset;
  offset[rotary] = context.machine.position(machine::CoordinateSystem::Workpiece)[rotary];
  return context.host.write_datum(row, offset);
}

CycleResult<void> align_line(const CycleContext& context) {
  const int wanted = context.whole(312);
  if (wanted > 0 && wanted < 4) return nc_error(1019, "Q312 is 0, 4 (A), 5 (B) or 6 (C)");
  TRY(check_transfer(context));
  auto motion = TRY(begin_alignment(context));
  const auto edge = TRY(probe_line(context, motion));
  const auto [around, angle] = misalignment(edge, motion.plane());
  const Axis rotary = rotary_axis_around(around);
  if (wanted != 0 && rotary != static_cast<Axis>(wanted - 1))
    return nc_error(1019, "this rotary axis does not turn the measured line");
  context.host.set_q(150, to_angle(angle), Unit::Angle);
  const bool in_plane = around == motion.plane().probe;
  const double target = in_plane ? context.number(380) : 0;
  // A line has no direction, so half a turn more is the same target. The turn from the nominal
  // angle is reduced, and not the one from the measured angle, so that it jumps at neither.
  const double nominal = edge.axis == 0 ? 90 : 0;
  const double turn = angle - nominal + std::remainder(nominal - target, 180);
  TRY(align_rotary_axis(context, rotary, turn));
  return context.whole(337) == 0 ? CycleResult<void>() : zero(context, rotary);
}

constexpr std::array k405Parameters = list(
    circle(coordinates(321, "Centre, main axis",
                       "Centre, secondary axis; 0: the hole comes to the positive secondary axis")),
    choice(337, "Set to zero: 0 the table, else the row of the datum table for its offset", 0, 9999,
           0));

double angle_of(const Vec3& point) { return machine::degrees(std::atan2(point.y, point.x)); }

CycleResult<void> align_hole(const CycleContext& context, ProbingMotion& motion) {
  const Vec3 nominal = place_of(context, 321, 322, 261);
  const auto probed = TRY(probe_circle(context, motion, Side::Inside, nominal));
  const double wanted = nominal.y == 0 ? 90 : angle_of(nominal);
  const double misalignment = std::remainder(angle_of(probed.circle.centre) - wanted, 360);
  context.host.set_q(150, to_angle(misalignment), Unit::Angle);
  const machine::Axis table = rotary_axis_around(motion.plane().probe);
  TRY(align_rotary_axis(context, table, misalignment));
  const int row = context.whole(337);
  if (row == 0) return zero_rotary_axis(context, table, 0);
  machine::AxisWords offset;
  offset[table] = to_angle(misalignment);
  return context.host.write_datum(row, offset);
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(400, "BASIC ROTATION", CycleKind::Alignment, k400Parameters, {},
          errors::kUnscaled | ErrorSet{1042, 1081, 1085}, after<begin_alignment, rotate>,
          "All parameters. With Q272 = 1 the line is compared with the secondary axis."),
    cycle(404, "SET BASIC ROTATION", CycleKind::Alignment, k404Parameters, {},
          errors::kWithProbe | ErrorSet{1085}, set_rotation, "All parameters. No motion."),
    cycle(401, "ROT OF 2 HOLES", CycleKind::Alignment, k401Parameters, {},
          errors::kUnscaled | ErrorSet{1081, 1085, 1100}, after<begin_alignment, two_holes>,
          "All parameters; holes are touched from their nominal centre."),
    cycle(402, "ROT OF 2 STUDS", CycleKind::Alignment, k402Parameters, {},
          errors::kUnscaled | ErrorSet{1081, 1085, 1100}, after<begin_alignment, two_studs>,
          "All parameters."),
    cycle(403, "ROT IN ROTARY AXIS", CycleKind::Alignment, k403Parameters, kAngleResults,
          errors::kUnscaled | ErrorSet{1019, 1042, 1043, 1078, 1081, 1085, 1100}, align_line,
          "All parameters. Q380 counts in the working plane; half a turn more is the same line.",
          "Rotary axes of a head: they cannot turn the workpiece."),
    cycle(405, "ROT IN C AXIS", CycleKind::Alignment, k405Parameters, kAngleResults,
          errors::kUnscaled | errors::kCircle | ErrorSet{1043, 1100},
          after<begin_alignment, align_hole>,
          "All parameters; the datum must lie in the centre of the table.")};

}  // namespace fitgauge::probing::alignment_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kAlignmentCycles = alignment_cycles::kCycles;
