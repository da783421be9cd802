#include "nc/probing/touch/corner_probing.hpp"

#include <cmath>

#include "nc/machine/tolerance.hpp"

namespace fitgauge::probing {
namespace {

struct Edge {
  Point2 first;
  Point2 second;
};

/// The edge beside the line through two ball centres, on the side that was touched.
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

CycleResult<Point2> intersection(Point2 a1, Point2 a2, Point2 b1, Point2 b2) {
  const Point2 a{a2.x - a1.x, a2.y - a1.y};
  const Point2 b{b2.x - b1.x, b2.y - b1.y};
  const double across = a.x * b.y - a.y * b.x;
  if (std::abs(across) <= tolerance::kParallelEdges * std::hypot(a.x, a.y) * std::hypot(b.x, b.y)) {
    return nc_error(1081, "the measured lines do not meet");
  }
  const double part = ((b1.x - a1.x) * b.y - (b1.y - a1.y) * b.x) / across;
  return Point2{a1.x + part * a.x, a1.y + part * a.y};
}

CycleResult<Corner> corner_of(std::span<const Contact> contacts, std::span<const Touch> touches,
                              double ball_radius) {
  const Edge main = edge_of(contacts[0], contacts[1], touches[0].direction, ball_radius);
  const Edge secondary = edge_of(contacts[2], contacts[3], touches[2].direction, ball_radius);
  const auto point = intersection(main.first, main.second, secondary.first, secondary.second);
  if (!point) return point.error();
  return Corner{*point, contacts[1].ball_centre - contacts[0].ball_centre};
}

}  // namespace fitgauge::probing
