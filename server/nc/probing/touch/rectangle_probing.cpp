#include "nc/probing/touch/rectangle_probing.hpp"

#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing {
namespace {

/// Between two faces around the corner of a stud, or through the centre of a pocket.
void go_around(Touch& next, const Touch& last, Side side, const Vec3& centre) {
  const bool last_along_main = last.direction.x != 0;
  next.waypoints = {side == Side::Inside ? centre
                    : last_along_main    ? Vec3{last.start.x, next.start.y, centre.z}
                                         : Vec3{next.start.x, last.start.y, centre.z}};
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
                                       Side side, Point2 at, const std::array<double, 2>& length) {
  const Vec3 centre{at.x, at.y, context.number(261)};
  const double distance = motion.start_distance();
  const auto main = width_touches(side, centre, 0, length[0], distance);
  const auto secondary = width_touches(side, centre, 1, length[1], distance);
  // Around the rectangle, so that no way leads across it.
  std::array touches{main[0], secondary[0], main[1], secondary[1]};
  for (std::size_t i = 1; i < touches.size(); ++i) {
    if (context.whole(301) == 1) {
      touches[i].transit = Transit::ClearanceHeight;
    } else {
      go_around(touches[i], touches[i - 1], side, centre);
    }
  }
  const auto contacts = TRY(touch_part(context, motion, touches, {side, centre, 0, length}));
  const double x1 = contacts[0].surface.x;
  const double x2 = contacts[2].surface.x;
  const double y1 = contacts[1].surface.y;
  const double y2 = contacts[3].surface.y;
  return Rectangle{{(x1 + x2) / 2, (y1 + y2) / 2}, {x1 - x2, y1 - y2}};
}

}  // namespace fitgauge::probing
