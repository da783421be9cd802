#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/probing/touch/line_probing.hpp"

namespace fitgauge::probing::cycle_414_415 {

using namespace parameter;

constexpr std::array kCommon{kMeasuringHeight, kSetUpClearance, kClearanceHeight, kMoveToClearance,
                             choice(304, "Basic rotation: 0 no, 1 yes", 0, 1, 0)};

constexpr std::array k414Parameters =
    join(join(std::array{coordinate(263, "1st point, main axis"),
                         coordinate(264, "1st point, secondary axis"),
                         length(326, "Spacing in the main axis"),
                         coordinate(296, "3rd point, main axis"),
                         coordinate(297, "3rd point, secondary axis"),
                         length(327, "Spacing in the secondary axis")},
              kCommon),
         kPlaneDatum);

constexpr std::array k415Parameters = join(
    join(std::array{coordinate(263, "Corner, main axis"), coordinate(264, "Corner, secondary axis"),
                    length(326, "Corner to the 2nd point in the main axis"),
                    length(327, "Corner to the 4th point in the secondary axis"),
                    choice(308, "Corner: 1 lower left, 2 lower right, 3 upper right, 4 upper left",
                           1, 4)},
         kCommon),
    kPlaneDatum);

constexpr std::array<CycleOutput, 2> kResults{
    {{151, "Corner, main axis", Unit::Length}, {152, "Corner, secondary axis", Unit::Length}}};

using Touches = std::array<Touch, 4>;

double sign(double value) { return value < 0 ? -1 : 1; }

void connect(Touches& touches, bool via_clearance, const Vec3& around_corner) {
  for (std::size_t i = 1; i < touches.size(); ++i) {
    touches[i].transit = via_clearance ? Transit::ClearanceHeight : Transit::Straight;
  }
  touches[2].waypoints = {around_corner};
}

/// Touches an outside corner. The place of the 1st point relative to the 3rd shows which corner it
/// is. Points 1 and 2 are on the edge along the main axis, 3 and 4 on the other edge.
CycleResult<Touches> outside_touches(const Arguments& arguments, double start_distance) {
  const double height = arguments.number(261);
  const Vec3 first{arguments.number(263), arguments.number(264), height};
  const Vec3 third{arguments.number(296), arguments.number(297), height};
  if (first.x == third.x || first.y == third.y) {
    return nc_error(1081, "the 1st and 3rd point do not say where the corner lies");
  }
  // Unit steps from the corner into the part.
  const Vec3 main{sign(first.x - third.x), 0, 0};
  const Vec3 secondary{0, sign(third.y - first.y), 0};
  const Vec3 below = first - secondary * start_distance;
  const Vec3 beside = third - main * start_distance;
  Touches touches{Touch{.start = below, .direction = secondary},
                  Touch{.start = below + main * arguments.number(326), .direction = secondary},
                  Touch{.start = beside, .direction = main},
                  Touch{.start = beside + secondary * arguments.number(327), .direction = main}};
  connect(touches, arguments.whole(301) == 1, {beside.x, below.y, height});
  return touches;
}

/// Touches an inside corner from a point that keeps the start distance to both edges.
Touches inside_touches(const Arguments& arguments, double start_distance) {
  const int corner = arguments.whole(308);
  const Vec3 main{corner == 1 || corner == 4 ? 1.0 : -1.0, 0, 0};
  const Vec3 secondary{0, corner <= 2 ? 1.0 : -1.0, 0};
  const Vec3 vertex{arguments.number(263), arguments.number(264), arguments.number(261)};
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

CycleResult<void> set_datum(const CycleContext& context, ProbingMotion& motion, bool inside) {
  const Arguments& arguments = context.arguments;
  const double start_distance = motion.start_distance(arguments.number(320));
  const auto touches = TRY(inside ? CycleResult<Touches>(inside_touches(arguments, start_distance))
                                  : outside_touches(arguments, start_distance));
  const auto contacts = TRY(motion.touch_all(touches, arguments.number(260)));
  const auto corner = TRY(corner_of(contacts, touches, motion.ball_radius()));
  set_length(context.host, 151, corner.point.x);
  set_length(context.host, 152, corner.point.y);
  std::optional<double> rotation;
  if (arguments.whole(304) == 1) {
    rotation = workpiece_angle(context.machine.state().frames, motion.plane(), corner.direction);
  }
  return finish_preset(context, motion, plane_datum(arguments, corner.point), rotation);
}

constinit const TouchProbeCycle kCycle414 =
    cycle(414, "DATUM OUTSIDE CORNER", CycleKind::Preset, k414Parameters, kResults,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, set_datum, false>,
          "All parameters. With Q304 = 1 the angle of the edge along the main axis becomes "
          "the basic rotation.");

constinit const TouchProbeCycle kCycle415 =
    cycle(415, "DATUM INSIDE CORNER", CycleKind::Preset, k415Parameters, kResults,
          errors::kDatumTransfer | ErrorSet{1081}, after<begin_preset, set_datum, true>,
          "All parameters. With Q304 = 1 the angle of the edge along the main axis becomes "
          "the basic rotation.");

}  // namespace fitgauge::probing::cycle_414_415
