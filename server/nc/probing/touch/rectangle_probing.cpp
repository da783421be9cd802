#include "nc/probing/touch/rectangle_probing.hpp"

#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing {
namespace {

/// Between two faces around the corner of a stud, or through the centre of a pocket.
void go_around(Touch& next, const Touch& last, const RectanglePlan& plan) {
  if (plan.via_clearance) {
    next.transit = Transit::ClearanceHeight;
  } else if (plan.side == Side::Inside) {
    next.waypoints = {{plan.centre.x, plan.centre.y, plan.height}};
  } else {
    const bool last_along_main = last.direction.x != 0;
    next.waypoints = {last_along_main ? Vec3{last.start.x, next.start.y, plan.height}
                                      : Vec3{next.start.x, last.start.y, plan.height}};
  }
}

}  // namespace

std::array<Touch, 2> width_touches(Side side, const Vec3& centre, std::size_t axis, double width,
                                   double start_distance) {
  const double outwards = side == Side::Inside ? 1 : -1;
  const double offset = std::max(0.0, width / 2 - outwards * start_distance);
  Vec3 up;
  up[axis] = 1;
  return {Touch{.start = centre + up * offset, .direction = up * outwards},
          Touch{.start = centre - up * offset, .direction = up * -outwards}};
}

CycleResult<Rectangle> probe_rectangle(const CycleContext& context, ProbingMotion& motion,
                                       const RectanglePlan& plan, double clearance_height) {
  const Vec3 centre{plan.centre.x, plan.centre.y, plan.height};
  const auto main = width_touches(plan.side, centre, 0, plan.length_main, plan.start_distance);
  const auto secondary =
      width_touches(plan.side, centre, 1, plan.length_secondary, plan.start_distance);
  // Around the rectangle, so that no way leads across it.
  std::array touches{main[0], secondary[0], main[1], secondary[1]};
  for (std::size_t i = 1; i < touches.size(); ++i) go_around(touches[i], touches[i - 1], plan);
  const PlannedPlace place{plan.side, centre, 0,
                           std::array{plan.length_main, plan.length_secondary}};
  const auto contacts = TRY(touch_part(context, motion, touches, clearance_height, place));
  const double x1 = contacts[0].surface.x;
  const double x2 = contacts[2].surface.x;
  const double y1 = contacts[1].surface.y;
  const double y2 = contacts[3].surface.y;
  return Rectangle{{(x1 + x2) / 2, (y1 + y2) / 2}, x1 - x2, y1 - y2};
}

}  // namespace fitgauge::probing
