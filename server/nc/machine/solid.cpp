#include "nc/machine/solid.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {
namespace {

/// The field of a point whose offset from the nearest point of a convex body is `offset`.
Field outside(const Vec3& offset) {
  const double distance = norm(offset);
  return {distance, offset * (1 / distance)};
}

double with_sign_of(double sign, double value) { return sign < 0 ? -value : value; }

}  // namespace

std::optional<double> Solid::contact(const BallPath& ball) const {
  constexpr int kSteps = 200;  // a tangent halves its distance in each step
  double way = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Field at = field(ball.at(way));
    const double gap = at.distance - ball.radius;
    if (gap <= (step == 0 ? tolerance::kContact : tolerance::kRounding)) return way;
    const double slope = dot(at.gradient, ball.direction);
    const double next = slope < 0 ? way - gap / slope : std::numeric_limits<double>::infinity();
    if (next > ball.longest) return std::nullopt;
    if (next == way) return way;
    way = next;
  }
  return way;
}

BlockSolid::BlockSolid(const Block& block)
    : centre_((block.min + block.max) * 0.5), half_((block.max - block.min) * 0.5) {}

Field BlockSolid::field(const Vec3& at) const {
  const Vec3 from = at - centre_;
  Vec3 excess;  // how far the point lies beyond each pair of faces
  for (std::size_t axis = 0; axis < 3; ++axis) excess[axis] = std::abs(from[axis]) - half_[axis];

  std::size_t nearest = 0;
  if (excess.y > excess[nearest]) nearest = 1;
  if (excess.z > excess[nearest]) nearest = 2;
  const double beyond_faces =
      std::max(excess.x, 0.0) + std::max(excess.y, 0.0) + std::max(excess.z, 0.0);
  if (beyond_faces == std::max(excess[nearest], 0.0)) {  // inside, or beyond one face only
    Field field{excess[nearest], {0, 0, 0}};
    field.gradient[nearest] = with_sign_of(from[nearest], 1);
    return field;
  }
  Vec3 offset;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    offset[axis] = with_sign_of(from[axis], std::max(excess[axis], 0.0));
  }
  return outside(offset);
}

BossSolid::BossSolid(const Boss& boss)
    : centre_{boss.centre[0], boss.centre[1], boss.top - boss.height / 2},
      radius_(boss.diameter / 2),
      half_height_(boss.height / 2) {}

Field BossSolid::field(const Vec3& at) const {
  const Vec3 from = at - centre_;
  const double across = std::hypot(from.x, from.y);
  const Vec3 radial = across > 0 ? Vec3{from.x / across, from.y / across, 0} : Vec3{1, 0, 0};
  const Vec3 axial{0, 0, with_sign_of(from.z, 1)};
  const double beyond_side = across - radius_;
  const double beyond_end = std::abs(from.z) - half_height_;
  if (beyond_side > 0 && beyond_end > 0) return outside(radial * beyond_side + axial * beyond_end);
  return beyond_side > beyond_end ? Field{beyond_side, radial} : Field{beyond_end, axial};
}

Field SphereSolid::field(const Vec3& at) const {
  const Vec3 from = at - centre_;
  const double distance = norm(from);
  if (distance == 0) return {-radius_, {0, 0, 1}};
  return {distance - radius_, from * (1 / distance)};
}

}  // namespace fitgauge::machine
