#include "nc/machine/surface_solid.hpp"

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

MeshSolid::MeshSolid(const Mesh& mesh)
    : body_(mesh.body),
      place_(Transform::translation(mesh.origin) *
             Transform::orthogonal(Matrix3::spatial(mesh.spatial_angles_deg))),
      to_body_(place_.inverse()),
      box_(Box::nothing()) {
  for (const Triangle& triangle : body_->triangles()) {
    for (const Vec3& corner : triangle) box_.join({place_.point(corner), place_.point(corner)});
  }
}

Field MeshSolid::field(const Vec3& at) const {
  const Vec3 in_body = to_body_.point(at);
  const Vec3 nearest = body_->nearest(in_body).point;
  const Vec3 offset = in_body - nearest;
  const Vec3 outwards = body_->normal_at(nearest);
  const double sign = dot(offset, outwards) < 0 ? -1 : 1;
  const double distance = norm(offset);
  // Close to a face the offset is lost in rounding; the face's normal is not.
  const Vec3 away = distance < tolerance::kNanometre ? unit(outwards) : offset * (sign / distance);
  return {sign * distance, place_.direction(away)};
}

bool MeshSolid::is_inside(const Vec3& in_body, const Vec3& nearest) const {
  return dot(in_body - nearest, body_->normal_at(nearest)) < 0;
}

/// Tests whether the start is inside at the place where the ball would touch: nothing is between
/// them, and the nearest point of the mesh is quickly found there.
std::optional<double> MeshSolid::contact(const BallPath& ball) const {
  const BallPath path{to_body_.point(ball.start), to_body_.direction(ball.direction), ball.radius,
                      ball.longest};
  if (body_->nearest(path.start, ball.radius + tolerance::kContact)) return 0;
  const auto way = body_->contact(path);
  if (!way) {
    const Vec3 nearest = body_->nearest(path.start).point;
    return is_inside(path.start, nearest) ? std::optional(0.0) : std::nullopt;
  }
  constexpr double kBefore = 0.01;
  const double back = std::min(*way, kBefore);
  const Vec3 at = path.at(*way - back);
  const auto nearest = body_->nearest(at, ball.radius + 2 * back + kBefore);
  return nearest && is_inside(at, nearest->point) ? std::optional(0.0) : way;
}

}  // namespace fitgauge::machine
