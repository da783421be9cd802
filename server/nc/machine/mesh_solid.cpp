#include "nc/machine/mesh_solid.hpp"

#include <algorithm>

#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {

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

/// Whether the start lies inside is told where the ball is about to touch: nothing lies between,
/// and there the nearest point of the mesh is found at once.
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
