#include "nc/machine/surface_solid.hpp"

#include <algorithm>
#include <limits>

#include "nc/machine/delaunay.hpp"
#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {
namespace {

std::vector<Triangle> triangles_of(const Surface& surface, const Triangulation& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({surface.points[a], surface.points[b], surface.points[c]});
  }
  return triangles;
}

}  // namespace

SurfaceSolid::SurfaceSolid(const Surface& surface)
    : SurfaceSolid(surface, delaunay(surface.points)) {}

SurfaceSolid::SurfaceSolid(const Surface& surface, const Triangulation& mesh)
    : top_(triangles_of(surface, mesh)) {
  for (const std::uint32_t point : mesh.hull) hull_.push_back(surface.points[point]);
  hull_.push_back(hull_.front());
}

Box SurfaceSolid::box() const {
  Box box = top_.box();
  box.min.z = -std::numeric_limits<double>::infinity();
  return box;
}

Field SurfaceSolid::field(const Vec3& at) const {
  const auto [point, triangle] = top_.nearest(at);
  const auto& [a, b, c] = *triangle;
  Candidate nearest{point, unit(cross(b - a, c - a))};
  bool inside = false;
  if (at.z < top_.highest()) {
    nearest = nearest_with_walls(at, nearest);
    const auto above = top_.height(at.x, at.y);
    inside = above && at.z < *above;
  }
  const Vec3 offset = at - nearest.point;
  const double distance = norm(offset);
  const double sign = inside ? -1 : 1;
  // Close to a face the offset is lost in rounding; the face's normal is not.
  return {sign * distance,
          distance < tolerance::kNanometre ? nearest.normal : offset * (sign / distance)};
}

SurfaceSolid::Candidate SurfaceSolid::nearest_with_walls(const Vec3& at,
                                                         const Candidate& top) const {
  Candidate best = top;
  double least = dot(at - best.point, at - best.point);
  for (std::size_t k = 0; k + 1 < hull_.size(); ++k) {
    const Vec3& a = hull_[k];
    const Vec3 along = hull_[k + 1] - a;
    const double length = along.x * along.x + along.y * along.y;
    const double part = ((at.x - a.x) * along.x + (at.y - a.y) * along.y) / length;
    Vec3 point = a + along * std::clamp(part, 0.0, 1.0);
    point.z = std::min(point.z, at.z);
    const double distance = dot(at - point, at - point);
    if (distance < least) {
      least = distance;
      best = {point, unit({along.y, -along.x, 0})};
    }
  }
  return best;
}

}  // namespace fitgauge::machine
