#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/preset/preset_cycle.hpp"

namespace fitgauge::probing::preset_cycles {

using Touches = std::array<Touch, 4>;
using namespace parameter;

constexpr std::array kWidth =
    list(coordinates(321, "Centre, main axis", "Centre, secondary axis"), length(311, "Width"),
         kMeasuringAxisInPlane, kMeasuringHeight, kSetUpClearance, kClearanceHeight);
constexpr std::array kWidthDatum =
    list(kTableRow, coordinate(405, "New datum", 0), kTransfer, kProbeAxisDatum);

constexpr std::array k408Parameters = list(kWidth, kMoveToClearance, kWidthDatum);
constexpr std::array k409Parameters = list(kWidth, kWidthDatum);

constexpr std::array kWidthResults = list(results(157, Unit::Length, "Position of the centre line"),
                                          results(166, Unit::Length, "Measured width"));

CycleResult<void> width_datum(const CycleContext& context, ProbingMotion& motion, Side side) {
  const auto axis = static_cast<std::size_t>(context.whole(272) - 1);
  const Vec3 centre = place_of(context, 321, 322, 261);
  auto touches = width_touches(side, centre, axis, context.number(311), motion.start_distance());
  const bool moves = touches[0].start != touches[1].start;
  if (moves && (side == Side::Outside || context.whole(301) == 1))
    touches[1].transit = Transit::ClearanceHeight;
  const auto contacts = TRY(
      touch_part(context, motion, touches, width_place(side, centre, axis, context.number(311))));

  const double first = contacts.front().surface[axis];
  const double second = contacts.back().surface[axis];
  DatumPoint found{.point = centre};
  found.point[axis] = (first + second) / 2;
  found.axes[axis] = true;
  found.datum[axis] = context.number(405);
  set_lengths(context.host, 157, {found.point[axis]});
  set_lengths(context.host, 166, {std::abs(first - second)});
  return finish_preset(context, motion, found);
}

constexpr std::array k410Parameters =
    list(coordinates(321, "Centre, main axis", "Centre, secondary axis"),
         length(323, "Length, main axis"), length(324, "Length, secondary axis"), kMeasuringHeight,
         kSetUpClearance, kClearanceHeight, kMoveToClearance, kPlaneDatum);

CycleResult<void> rectangle_datum(const CycleContext& context, ProbingMotion& motion, Side side) {
  const auto rectangle =
      TRY(probe_rectangle(context, motion, side, place_of(context, 321, 322, 261),
                          {context.number(323), context.number(324)}));
  set_lengths(context.host, 151, {rectangle.centre.x, rectangle.centre.y});
  set_lengths(context.host, 154, {rectangle.length[0], rectangle.length[1]});
  return finish_preset(context, motion, plane_datum(context, rectangle.centre));
}

constexpr std::array k412Parameters =
    list(circle(coordinates(321, "Centre, main axis", "Centre, secondary axis")), kPlaneDatum,
         kTouches, kTraverse);

CycleResult<void> circle_datum(const CycleContext& context, ProbingMotion& motion, Side side) {
  const auto probed = TRY(probe_circle(context, motion, side, place_of(context, 321, 322, 261)));
  publish_circle(context, side, probed);
  return finish_preset(context, motion, plane_datum(context, probed.circle.centre));
}

constexpr std::array kCorner{kMeasuringHeight, kSetUpClearance, kClearanceHeight, kMoveToClearance,
                             choice(304, "Basic rotation: 0 no, 1 yes", 0, 1, 0)};

constexpr std::array k414Parameters =
    list(coordinates(263, "1st point, main axis", "1st point, secondary axis"),
         length(326, "Spacing in the main axis"),
         coordinates(296, "3rd point, main axis", "3rd point, secondary axis"),
         length(327, "Spacing in the secondary axis"), kCorner, kPlaneDatum);

constexpr std::array k415Parameters =
    list(coordinates(263, "Corner, main axis", "Corner, secondary axis"),
         length(326, "Corner to the 2nd point in the main axis"),
         length(327, "Corner to the 4th point in the secondary axis"),
         choice(308, "Corner: 1 lower left, 2 lower right, 3 upper right, 4 upper left", 1, 4),
         kCorner, kPlaneDatum);

constexpr std::array kCornerResults =
    results(151, Unit::Length, "Corner, main axis", "Corner, secondary axis");

double sign(double value) { return value < 0 ? -1 : 1; }

void connect(Touches& touches, bool via_clearance, const Vec3& around_corner) {
  for (std::size_t i = 1; i < touches.size(); ++i)
    touches[i].transit = via_clearance ? Transit::ClearanceHeight : Transit::Straight;
  touches[2].waypoints = {around_corner};
}

/// Touches an outside corner. The place of the 1st point relative to the 3rd shows which corner it
/// is. Points 1 and 2 are on the edge along the main axis, 3 and 4 on the other edge.
CycleResult<Touches> outside_touches(const Arguments& arguments, double start_distance) {
  const Vec3 first = place_of(arguments, 263, 264, 261);
  const Vec3 third = place_of(arguments, 296, 297, 261);
  if (first.x == third.x || first.y == third.y)
    return nc_error(1081, "the 1st and 3rd point do not say where the corner lies");
  // Unit steps from the corner into the part.
  const Vec3 main{sign(first.x - third.x), 0, 0};
  const Vec3 secondary{0, sign(third.y - first.y), 0};
  const Vec3 below = first - secondary * start_distance;
  const Vec3 beside = third - main * start_distance;
  Touches touches{Touch{.start = below, .direction = secondary},
                  Touch{.start = below + main * arguments.number(326), .direction = secondary},
                  Touch{.start = beside, .direction = main},
                  Touch{.start = beside + secondary * arguments.number(327), .direction = main}};
  connect(touches, arguments.whole(301) == 1, {beside.x, below.y, first.z});
  return touches;
}

/// Touches an inside corner from a point that keeps the start distance to both edges.
Touches inside_touches(const Arguments& arguments, double start_distance) {
  const int corner = arguments.whole(308);
  const Vec3 main{corner == 1 || corner == 4 ? 1.0 : -1.0, 0, 0};
  const Vec3 secondary{0, corner <= 2 ? 1.0 : -1.0, 0};
  const Vec3 vertex = place_of(arguments, 263, 264, 261);
  const Vec3 start = vertex + (main + secondary) * start_distance;
  const Vec3 along_main = vertex + main * arguments.number(326) + secondary * start_distance;
  const Vec3 along_secondary = vertex + secondary * arguments.number(327) + main * start_distance;
  Touches touches{Touch{.start = start, .direction = -secondary},
                  Touch{.start = along_main, .direction = -secondary},
                  Touch{.start = start, .direction = -main},
                  Touch{.start = along_secondary, .direction = -main}};
  connect(touches, arguments.whole(301) == 1, start);
  return touches;
}

CycleResult<void> corner_datum(const CycleContext& context, ProbingMotion& motion, bool inside) {
  const double start_distance = motion.start_distance();
  const auto touches = TRY(inside ? CycleResult<Touches>(inside_touches(context, start_distance))
                                  : outside_touches(context, start_distance));
  const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
  const auto corner = TRY(corner_of(contacts, touches, motion.ball_radius()));
  set_lengths(context.host, 151, {corner.point.x, corner.point.y});
  std::optional<double> rotation;
  if (context.whole(304) == 1)
    rotation = workpiece_angle(context.state().frames, motion.plane(), corner.direction);
  return finish_preset(context, motion, plane_datum(context, corner.point), rotation);
}

constexpr std::array k416Parameters = list(kBoltCircle, kPlaneDatum, newer(kSetUpClearance));

constexpr std::array k418Parameters =
    list(coordinates(268, "1st hole, main axis", "1st hole, secondary axis", "2nd hole, main axis",
                     "2nd hole, secondary axis"),
         coordinates(316, "3rd hole, main axis", "3rd hole, secondary axis", "4th hole, main axis",
                     "4th hole, secondary axis"),
         kMeasuringHeight, kClearanceHeight, kPlaneDatum);

constexpr std::array k418Results =
    results(151, Unit::Length, "Intersection, main axis", "Intersection, secondary axis");

CycleResult<void> bolt_circle(const CycleContext& context, ProbingMotion& motion) {
  const auto probed = TRY(probe_bolt_circle(context, motion));
  publish_circle(context, Side::Inside, probed);
  return finish_preset(context, motion, plane_datum(context, probed.circle.centre));
}

CycleResult<void> four_holes(const CycleContext& context, ProbingMotion& motion) {
  std::vector<Vec3> nominal;
  for (const int main : {268, 270, 316, 318})
    nominal.push_back(place_of(context, main, main + 1, 261));
  const auto centre = TRY(probe_hole_centres(context, motion, nominal));
  const auto point = TRY(intersection(centre[0], centre[2], centre[1], centre[3]));
  set_lengths(context.host, 151, {point.x, point.y});
  return finish_preset(context, motion, plane_datum(context, point));
}

constexpr std::array k417Parameters =
    list(coordinates(263, "Point, main axis", "Point, secondary axis"),
         coordinate(294, "Point, probe axis"), kSetUpClearance, kClearanceHeight, kTableRow,
         coordinate(333, "New datum in the probe axis", 0), kTransfer);

constexpr std::array k419Parameters =
    list(coordinates(263, "Point, main axis", "Point, secondary axis"), kMeasuringHeight,
         kSetUpClearance, kClearanceHeight, kMeasuringAxis, kDirection, kTableRow,
         coordinate(333, "New datum", 0), kTransfer);

constexpr std::array kCoordinateResults = results(160, Unit::Length, "Measured coordinate");

CycleResult<void> in_probe_axis(const CycleContext& context, ProbingMotion& motion) {
  const Vec3 nominal = place_of(context, 263, 264, 294);
  const auto surface = TRY(touch_down(context, motion, nominal));
  return set_datum_of_axis(context, motion.plane(), surface, 2);
}

CycleResult<void> in_one_axis(const CycleContext& context, ProbingMotion& motion) {
  const auto touched = TRY(touch_coordinate(context, motion));
  return set_datum_of_axis(context, motion.plane(), touched.surface, touched.axis);
}

constexpr std::array k247Parameters{ranged(339, "Number or name of the preset", Unit::None,
                                           {0, 65535}, {}, ValueKind::NumberOrText)};

/// Returns the row whose column DOC has the name.
CycleResult<int> named_row(const machine::PresetTable& presets, const std::string& name) {
  const auto found = std::ranges::find_if(
      presets.rows(), [&](const auto& row) { return row.second.comment == name; });
  if (found == presets.rows().end()) return nc_error(1011, "no preset is named \"" + name + '"');
  return found->first;
}

CycleResult<void> activate(const CycleContext& context) {
  if (const std::string* name = context.text(q(339))) {
    const auto row = TRY(named_row(context.state().presets, *name));
    return context.machine.activate_preset(row);
  }
  const double number = context.number(339);
  if (number != std::nearbyint(number)) return nc_error(1011, "Q339 must be a whole number");
  return context.machine.activate_preset(static_cast<int>(number));
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(408, "SLOT CENTER REF PT", CycleKind::Preset, k408Parameters, kWidthResults,
          errors::kDatumTransfer, after<begin_preset, width_datum, Side::Inside>,
          "All parameters."),
    cycle(409, "RIDGE CENTER REF PT", CycleKind::Preset, k409Parameters, kWidthResults,
          errors::kDatumTransfer, after<begin_preset, width_datum, Side::Outside>,
          "All parameters."),
    cycle(410, "DATUM INSIDE RECTAN.", CycleKind::Preset, k410Parameters, kRectangleResults,
          errors::kDatumTransfer, after<begin_preset, rectangle_datum, Side::Inside>,
          "All parameters; moves at measuring height are paraxial."),
    cycle(411, "DATUM OUTS. RECTAN.", CycleKind::Preset, k410Parameters, kRectangleResults,
          errors::kDatumTransfer, after<begin_preset, rectangle_datum, Side::Outside>,
          "All parameters; moves at measuring height are paraxial."),
    cycle(412, "DATUM INSIDE CIRCLE", CycleKind::Preset, k412Parameters, kPresetCircleResults,
          errors::kDatumTransfer | errors::kCircle, after<begin_preset, circle_datum, Side::Inside>,
          "All parameters."),
    cycle(413, "DATUM OUTSIDE CIRCLE", CycleKind::Preset, k412Parameters, kPresetCircleResults,
          errors::kDatumTransfer | errors::kCircle,
          after<begin_preset, circle_datum, Side::Outside>, "All parameters."),
    cycle(414, "DATUM OUTSIDE CORNER", CycleKind::Preset, k414Parameters, kCornerResults,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, corner_datum, false>,
          "All parameters. With Q304 = 1 the angle of the edge along the main axis becomes "
          "the basic rotation."),
    cycle(415, "DATUM INSIDE CORNER", CycleKind::Preset, k415Parameters, kCornerResults,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, corner_datum, true>,
          "All parameters. With Q304 = 1 the angle of the edge along the main axis becomes "
          "the basic rotation."),
    cycle(416, "DATUM CIRCLE CENTER", CycleKind::Preset, k416Parameters, kPresetCircleResults,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, bolt_circle>,
          "All parameters; holes are touched from their nominal centre, Q320 counts in the "
          "probe axis only."),
    cycle(418, "DATUM FROM 4 HOLES", CycleKind::Preset, k418Parameters, k418Results,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, four_holes>,
          "All parameters; the lines join holes 1 and 3, 2 and 4."),
    cycle(417, "DATUM IN TS AXIS", CycleKind::Preset, k417Parameters, kCoordinateResults,
          errors::kDatumTransfer, after<begin_preset, in_probe_axis>, "All parameters."),
    cycle(419, "DATUM IN ONE AXIS", CycleKind::Preset, k419Parameters, kCoordinateResults,
          errors::kDatumTransfer | ErrorSet{1042}, after<begin_preset, in_one_axis>,
          "All parameters."),
    {{.family = CycleFamily::CyclDef,
      .number = 247,
      .name = "PRESETTING",
      .kind = CycleKind::Preset,
      .parameters = k247Parameters,
      .errors = ErrorSet{1011},
      .simulated = "Activates the row and resets datum shift, mirroring, rotation and scaling. No "
                   "motion."},
     activate}};

}  // namespace fitgauge::probing::preset_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kPresetCycles = preset_cycles::kCycles;
