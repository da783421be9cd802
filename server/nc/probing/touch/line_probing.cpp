#include "nc/probing/touch/line_probing.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::probing {
namespace {

CycleResult<Vec3> touch(const CycleContext& context, ProbingMotion& motion, const Vec3& nominal,
                        const Vec3& direction) {
  const std::array touches{
      Touch{.start = nominal - direction * motion.start_distance(), .direction = direction}};
  const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
  return contacts.front().surface;
}

struct Edge {
  Point2 first;
  Point2 second;
};

/// Returns the edge on the touched side of the line through two ball centres.
Edge edge_of(const Contact& first, const Contact& second, const Vec3& touched, double radius) {
  const Vec3 along = second.ball_centre - first.ball_centre;
  Vec3 normal{-along.y, along.x, 0};
  const double length = norm(normal);
  if (length == 0) return {};
  normal = normal * ((dot(normal, touched) > 0 ? radius : -radius) / length);
  const Vec3 a = first.ball_centre + normal;
  const Vec3 b = second.ball_centre + normal;
  return {{a.x, a.y}, {b.x, b.y}};
}

}  // namespace

double ProbedLine::angle_deg() const {
  const Vec3 along = direction();
  if (axis == 2) return machine::degrees(std::atan(along.z / along[across]));
  double angle = machine::degrees(std::atan2(along.y, along.x));
  const double lowest = axis == 1 ? -90 : 0;
  if (angle <= lowest) angle += 180;
  if (angle > lowest + 180) angle -= 180;
  return angle;
}

CycleResult<ProbedLine> probe_line(const CycleContext& context, ProbingMotion& motion) {
  const auto direction = TRY(probing_direction(context));
  const std::array nominal{place_of(context, 263, 264, 261), place_of(context, 265, 266, 261)};
  ProbedLine line;
  line.axis = static_cast<std::size_t>(context.whole(272) - 1);
  line.across = line.axis == 0 || (line.axis == 2 && nominal[0].x == nominal[1].x) ? 1 : 0;
  if (nominal[0][line.across] == nominal[1][line.across])
    return nc_error(1081, "both points lie at the same place of the line");
  Vec3 along;
  along[line.axis] = direction;
  const Vec3 back = along * motion.start_distance();
  const Transit between = context.whole(301) == 1 ? Transit::ClearanceHeight : Transit::Straight;
  const std::array touches{
      Touch{.start = nominal[0] - back, .direction = along},
      Touch{.start = nominal[1] - back, .direction = along, .transit = between}};
  const auto contacts = TRY(motion.touch_all(touches, context.number(260)));
  line.first = contacts.front().ball_centre;
  line.second = contacts.back().ball_centre;
  for (std::size_t k = 0; k < 2; ++k)
    line.coordinates[k] = {nominal[k][line.axis], contacts[k].surface[line.axis]};
  return line;
}

CycleResult<int> probing_direction(const Arguments& arguments) {
  const int direction = arguments.whole(267);
  if (direction == 0) return nc_error(1042, "Q267 must be -1 or +1");
  return direction;
}

CycleResult<TouchedCoordinate> touch_coordinate(const CycleContext& context,
                                                ProbingMotion& motion) {
  const auto direction = TRY(probing_direction(context));
  TouchedCoordinate touched{.axis = static_cast<std::size_t>(context.whole(272) - 1),
                            .nominal = place_of(context, 263, 264, 261),
                            .surface = {}};
  Vec3 along;
  along[touched.axis] = direction;
  touched.surface = TRY(touch(context, motion, touched.nominal, along));
  return touched;
}

CycleResult<Vec3> touch_down(const CycleContext& context, ProbingMotion& motion,
                             const Vec3& nominal) {
  return touch(context, motion, nominal, {0, 0, -1});
}

CycleResult<Point2> intersection(Point2 a1, Point2 a2, Point2 b1, Point2 b2) {
  const Point2 a{a2.x - a1.x, a2.y - a1.y};
  const Point2 b{b2.x - b1.x, b2.y - b1.y};
  const double across = a.x * b.y - a.y * b.x;
  if (std::abs(across) <= tolerance::kParallelEdges * std::hypot(a.x, a.y) * std::hypot(b.x, b.y))
    return nc_error(1081, "the measured lines do not meet");
  const double part = ((b1.x - a1.x) * b.y - (b1.y - a1.y) * b.x) / across;
  return Point2{a1.x + part * a.x, a1.y + part * a.y};
}

CycleResult<Corner> corner_of(std::span<const Contact> contacts, std::span<const Touch> touches,
                              double ball_radius) {
  const Edge main = edge_of(contacts[0], contacts[1], touches[0].direction, ball_radius);
  const Edge secondary = edge_of(contacts[2], contacts[3], touches[2].direction, ball_radius);
  const auto point = TRY(intersection(main.first, main.second, secondary.first, secondary.second));
  return Corner{point, contacts[1].ball_centre - contacts[0].ball_centre};
}

}  // namespace fitgauge::probing
