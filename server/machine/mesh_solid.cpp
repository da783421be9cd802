#include "machine/mesh_solid.hpp"

#include <algorithm>
#include <limits>

namespace fitgauge::machine {

MeshSolid::MeshSolid(const Mesh& mesh)
    : body_(mesh.body),
      place_(Transform::translation(mesh.origin) *
             Transform::orthogonal(Matrix3::spatial(mesh.spatial_angles_deg))),
      to_body_(place_.inverse()),
      bottom_(std::numeric_limits<double>::infinity()) {
  for (const Triangle& triangle : body_->triangles()) {
    for (const Vec3& corner : triangle) bottom_ = std::min(bottom_, place_.point(corner).z);
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
  constexpr double kOnFace = 1e-6;
  const Vec3 away = distance < kOnFace ? unit(outwards) : offset * (sign / distance);
  return {sign * distance, place_.direction(away)};
}

std::optional<double> MeshSolid::contact(const BallPath& ball) const {
  if (field(ball.start).distance - ball.radius <= kNoClearance) return 0;
  return body_->contact(
      {to_body_.point(ball.start), to_body_.direction(ball.direction), ball.radius, ball.longest});
}

}  // namespace fitgauge::machine
