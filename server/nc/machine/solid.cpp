#include "nc/machine/solid.hpp"

#include "nc/machine/tolerance.hpp"
#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {
namespace {

/// The field of a point whose offset from the nearest point of a convex body is `offset`.
Field outside(const Vec3& offset) {
  const double distance = norm(offset);
  return {distance, offset * (1 / distance)};
}

double with_sign_of(double sign, double value) { return sign < 0 ? -value : value; }

/// The box of half sides around a centre.
Box around(const Vec3& centre, const Vec3& half) { return {centre - half, centre + half}; }

/// The field of the side `sign` of a face that is near. Close to a face the offset is lost in
/// rounding; the face's normal is not.
Field near_face(const Vec3& offset, double sign, const Vec3& normal) {
  const double distance = norm(offset);
  return {sign * distance, distance < tolerance::kNanometre ? normal : offset * (sign / distance)};
}

/// A triangulated surface with the walls below its hull.
struct Ground {
  TriangleTree top;
  std::vector<Vec3> hull;  ///< counter-clockwise, closed: the first point is also the last

  struct Candidate {
    Vec3 point;
    Vec3 normal;  ///< of its face
  };
  /// The nearest point of the walls, or `top` when that is nearer.
  Candidate nearest_with_walls(const Vec3& at, const Candidate& best_of_top) const {
    Candidate best = best_of_top;
    double least = dot(at - best.point, at - best.point);
    for (std::size_t k = 0; k + 1 < hull.size(); ++k) {
      const Vec3& a = hull[k];
      const Vec3 along = hull[k + 1] - a;
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

  Field field(const Vec3& at) const {
    const auto [point, triangle] = top.nearest(at);
    const auto& [a, b, c] = *triangle;
    Candidate nearest{point, unit(cross(b - a, c - a))};
    bool inside = false;
    if (at.z < top.highest()) {
      nearest = nearest_with_walls(at, nearest);
      const auto above = top.height(at.x, at.y);
      inside = above && at.z < *above;
    }
    return near_face(at - nearest.point, inside ? -1 : 1, nearest.normal);
  }
};

/// A mesh at its place.
struct Body {
  std::shared_ptr<const TriangleTree> mesh;
  Transform place;
  Transform to_body;

  Field field(const Vec3& at) const {
    const Vec3 in_body = to_body.point(at);
    const Vec3 nearest = mesh->nearest(in_body).point;
    const Vec3 offset = in_body - nearest;
    const Vec3 outwards = mesh->normal_at(nearest);
    Field field = near_face(offset, dot(offset, outwards) < 0 ? -1 : 1, unit(outwards));
    field.gradient = place.direction(field.gradient);
    return field;
  }

  bool is_inside(const Vec3& in_body, const Vec3& nearest) const {
    return dot(in_body - nearest, mesh->normal_at(nearest)) < 0;
  }

  /// Tests whether the start is inside at the place where the ball would touch: nothing is between
  /// them, and the nearest point of the mesh is quickly found there.
  std::optional<double> contact(const BallPath& ball) const {
    const BallPath path{to_body.point(ball.start), to_body.direction(ball.direction), ball.radius,
                        ball.longest};
    if (mesh->nearest(path.start, ball.radius + tolerance::kContact)) return 0;
    const auto way = mesh->contact(path);
    if (!way) {
      const Vec3 nearest = mesh->nearest(path.start).point;
      return is_inside(path.start, nearest) ? std::optional(0.0) : std::nullopt;
    }
    constexpr double kBefore = 0.01;
    const double back = std::min(*way, kBefore);
    const Vec3 at = path.at(*way - back);
    const auto nearest = mesh->nearest(at, ball.radius + 2 * back + kBefore);
    return nearest && is_inside(at, nearest->point) ? std::optional(0.0) : way;
  }
};

}  // namespace

std::optional<double> Solid::contact(const BallPath& ball) const {
  if (own_contact) return own_contact(ball);
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

Solid solid_of(const Block& block) {
  const Vec3 centre = (block.min + block.max) * 0.5;
  const Vec3 half = (block.max - block.min) * 0.5;
  const auto field = [=](const Vec3& at) {
    const Vec3 from = at - centre;
    Vec3 excess;  // how far the point lies beyond each pair of faces
    for (std::size_t axis = 0; axis < 3; ++axis) excess[axis] = std::abs(from[axis]) - half[axis];

    std::size_t nearest = 0;
    if (excess.y > excess[nearest]) nearest = 1;
    if (excess.z > excess[nearest]) nearest = 2;
    Vec3 offset;
    for (std::size_t axis = 0; axis < 3; ++axis)
      offset[axis] = with_sign_of(from[axis], std::max(excess[axis], 0.0));
    const double beyond_faces = std::abs(offset.x) + std::abs(offset.y) + std::abs(offset.z);
    if (beyond_faces != std::max(excess[nearest], 0.0)) return outside(offset);
    Field inside{excess[nearest], {0, 0, 0}};  // or beyond one face only
    inside.gradient[nearest] = with_sign_of(from[nearest], 1);
    return inside;
  };
  return {field, around(centre, half)};
}

Solid solid_of(const Boss& boss) {
  const Vec3 centre{boss.centre[0], boss.centre[1], boss.top - boss.height / 2};
  const double radius = boss.diameter / 2;
  const double half_height = boss.height / 2;
  const auto field = [=](const Vec3& at) {
    const Vec3 from = at - centre;
    const double across = std::hypot(from.x, from.y);
    const Vec3 radial = across > 0 ? Vec3{from.x / across, from.y / across, 0} : Vec3{1, 0, 0};
    const Vec3 axial{0, 0, with_sign_of(from.z, 1)};
    const double beyond_side = across - radius;
    const double beyond_end = std::abs(from.z) - half_height;
    if (beyond_side > 0 && beyond_end > 0)
      return outside(radial * beyond_side + axial * beyond_end);
    return beyond_side > beyond_end ? Field{beyond_side, radial} : Field{beyond_end, axial};
  };
  return {field, around(centre, {radius, radius, half_height})};
}

Solid solid_of(const Plane& plane) {
  const auto field = [point = plane.point, normal = unit(plane.normal)](const Vec3& at) {
    return Field{dot(at - point, normal), normal};
  };
  return {field, Box::everything()};
}

Solid solid_of(const Sphere& sphere) {
  const double radius = sphere.diameter / 2;
  const auto field = [radius, centre = sphere.centre](const Vec3& at) {
    const Vec3 from = at - centre;
    const double distance = norm(from);
    return distance == 0 ? Field{-radius, {0, 0, 1}}
                         : Field{distance - radius, from * (1 / distance)};
  };
  return {field, around(sphere.centre, {radius, radius, radius})};
}

Solid solid_of(const Surface& surface) {
  const Triangulation mesh = delaunay(surface.points);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
    triangles.push_back({surface.points[a], surface.points[b], surface.points[c]});
  Ground ground{TriangleTree(std::move(triangles)), {}};
  for (const std::uint32_t point : mesh.hull) ground.hull.push_back(surface.points[point]);
  ground.hull.push_back(ground.hull.front());
  Box box = ground.top.box();
  box.min.z = -std::numeric_limits<double>::infinity();
  return {std::bind_front(&Ground::field, std::move(ground)), box, true};
}

Solid solid_of(const Mesh& mesh) {
  const Transform place = Transform::translation(mesh.origin) *
                          Transform::orthogonal(Matrix3::spatial(mesh.spatial_angles_deg));
  const Body body{mesh.body, place, place.inverse()};
  Box box = Box::nothing();
  for (const Triangle& triangle : mesh.body->triangles()) {
    for (const Vec3& corner : triangle) box.join({place.point(corner), place.point(corner)});
  }
  return {std::bind_front(&Body::field, body), box, false, std::bind_front(&Body::contact, body)};
}

}  // namespace fitgauge::machine
