#include "nc/machine/solid.hpp"

#include "nc/machine/delaunay.hpp"
#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {
namespace {

/// The field of a point whose offset from the nearest point of a convex body is `offset`.
Field outside(const Vec3& offset) {
  const double distance = norm(offset);
  return {distance, offset * (1 / distance)};
}

double with_sign_of(double sign, double value) { return sign < 0 ? -value : value; }

std::vector<Triangle> triangles_of(const Surface& surface, const Triangulation& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({surface.points[a], surface.points[b], surface.points[c]});
  }
  return triangles;
}

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
