#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing::cycle_401_402 {

using namespace parameter;

constexpr std::array kCompensation{
    kReferenceAngle, kPresetRow,
    newer(choice(402, "Compensate by: 0 basic rotation, 1 turning the table", 0, 1, 0)),
    newer(choice(337, "Set the table to zero: 0 no, 1 yes", 0, 1, 0))};

constexpr std::array k401Parameters = join(
    std::array{coordinate(268, "1st hole, main axis"), coordinate(269, "1st hole, secondary axis"),
               coordinate(270, "2nd hole, main axis"), coordinate(271, "2nd hole, secondary axis"),
               kMeasuringHeight, kClearanceHeight},
    kCompensation);

constexpr std::array k402Parameters = join(
    std::array{coordinate(268, "1st stud, main axis"), coordinate(269, "1st stud, secondary axis"),
               length(313, "Diameter of the 1st stud"),
               coordinate(261, "Measuring height of the 1st stud"),
               coordinate(270, "2nd stud, main axis"), coordinate(271, "2nd stud, secondary axis"),
               length(314, "Diameter of the 2nd stud"),
               coordinate(315, "Measuring height of the 2nd stud"), kSetUpClearance,
               kClearanceHeight, kMoveToClearance},
    kCompensation);

/// The angle of the line between two centres less Q307, as basic rotation or by turning the table.
CycleResult<void> compensate(const CycleContext& context, const WorkingPlane& plane, Point2 first,
                             Point2 second) {
  const Arguments& arguments = context.arguments;
  const Vec3 direction{second.x - first.x, second.y - first.y, 0};
  if (direction == Vec3{}) return nc_error(1081, "both centres are the same");
  const double angle =
      workpiece_angle(context.machine.state().frames, plane, direction) - arguments.number(307);
  if (arguments.whole(402) == 0) {
    const Vec3 rotation = turned_rotation(context.machine.state().frames, plane, angle);
    return set_basic_rotation(context, rotation, arguments.whole(305));
  }
  const machine::Axis table = rotary_axis_around(plane.probe);
  TRY(align_rotary_axis(context, table, angle));
  if (arguments.whole(337) == 0) return {};
  return zero_rotary_axis(context, table, arguments.whole(305));
}

CycleResult<void> two_holes(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const std::array nominal{Point2{arguments.number(268), arguments.number(269)},
                           Point2{arguments.number(270), arguments.number(271)}};
  const double height = arguments.number(261);
  const auto holes = probe_hole_centres(motion, nominal, height, arguments.number(260));
  if (!holes) {
    const std::array places{PlannedPlace{Side::Inside, {nominal[0].x, nominal[0].y, height}},
                            PlannedPlace{Side::Inside, {nominal[1].x, nominal[1].y, height}}};
    return with_part(holes.error(), context, motion.plane(), places);
  }
  return compensate(context, motion.plane(), holes->front(), holes->back());
}

CycleResult<Point2> stud_centre(const CycleContext& context, ProbingMotion& motion, Point2 nominal,
                                double diameter, double height) {
  const Arguments& arguments = context.arguments;
  const auto touches =
      circle_touches({.side = Side::Outside,
                      .centre = nominal,
                      .diameter = diameter,
                      .height = height,
                      .start_distance = motion.start_distance(arguments.number(320)),
                      .via_clearance = arguments.whole(301) == 1});
  const PlannedPlace place{Side::Outside, {nominal.x, nominal.y, height}};
  const auto contacts = TRY(touch_part(context, motion, touches, arguments.number(260), place));
  const auto circle = TRY(circle_through(contacts, Side::Outside, motion.ball_radius()));
  return circle.centre;
}

CycleResult<void> two_studs(const CycleContext& context, ProbingMotion& motion) {
  const Arguments& arguments = context.arguments;
  const auto first =
      TRY(stud_centre(context, motion, {arguments.number(268), arguments.number(269)},
                      arguments.number(313), arguments.number(261)));
  const auto second =
      TRY(stud_centre(context, motion, {arguments.number(270), arguments.number(271)},
                      arguments.number(314), arguments.number(315)));
  return compensate(context, motion.plane(), first, second);
}

constinit const TouchProbeCycle kCycle401 =
    cycle(401, "ROT OF 2 HOLES", CycleKind::Alignment, k401Parameters, {},
          errors::kUnscaled | ErrorSet{1081, 1085, 1100}, after<begin_alignment, two_holes>,
          "All parameters; holes are touched from their nominal centre.");

constinit const TouchProbeCycle kCycle402 =
    cycle(402, "ROT OF 2 STUDS", CycleKind::Alignment, k402Parameters, {},
          errors::kUnscaled | ErrorSet{1081, 1085, 1100}, after<begin_alignment, two_studs>,
          "All parameters.");

}  // namespace fitgauge::probing::cycle_401_402
