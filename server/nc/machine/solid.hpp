#pragma once

#include "nc/machine/box_tree.hpp"
#include "nc/machine/machine_setup.hpp"

namespace fitgauge::machine {

/// A signed distance to a boundary and its gradient, a unit vector away from the material: the
/// nearest point of the boundary is `at - distance * gradient`.
struct Field {
  double distance = 0;  ///< in mm, negative inside the material
  Vec3 gradient{0, 0, 1};

  Vec3 foot(const Vec3& at) const { return at - gradient * distance; }
};

/// Material that a feature adds. Immutable: thread-safe.
struct Solid {
  /// The distance is exact outside; inside it is negative and exact wherever the nearest boundary
  /// is a face.
  std::function<Field(const Vec3& at)> field;
  /// Box around the material; infinite if the material is.
  Box box;
  /// Whether `contact` is not exact, so that the path must be traced step by step.
  bool is_traced = false;
  /// As `contact`, of a body that is not convex.
  std::function<std::optional<double>(const BallPath& ball)> own_contact{};

  /// Returns the distance until the ball touches, 0 if it touches at the start. The distance to a
  /// convex body is convex along a line, so Newton's steps never pass the contact: one for a face,
  /// a few for a rounding.
  std::optional<double> contact(const BallPath& ball) const;
};

Solid solid_of(const Block& block);
Solid solid_of(const Boss& boss);
Solid solid_of(const Plane& plane);
Solid solid_of(const Sphere& sphere);
/// The material below a measured surface: the triangles of its points and the walls that fall from
/// their hull. @pre not all points are on one line in X and Y.
Solid solid_of(const Surface& surface);
/// The inside of a closed mesh whose triangles run counter-clockwise seen from outside. @pre the
/// mesh has its body.
Solid solid_of(const Mesh& mesh);

/// The void of a bore: a cone (cylinder without taper) with lobes around a tilted axis, open
/// upwards, closed by a flat bottom. Its fields measure the material around it: positive inside the
/// void. Immutable: thread-safe.
class BoreVoid {
 public:
  explicit BoreVoid(const Bore& bore);

  /// Distance to the wall, exact on both sides.
  Field wall(const Vec3& at) const;
  /// Distance to the bottom plane.
  Field floor(const Vec3& at) const;
  /// A lower bound of the distance to the wall, below it by at most `roughness`.
  double wall_bound(const Vec3& at) const;
  /// The largest error of `wall_bound`, in mm: 0 for a bore without lobes.
  double roughness() const { return 2 * amplitude_; }

  /// Returns how far a ball in the void can move along the unit vector `direction` until it touches
  /// wall or bottom: of a cylinder the solution of a quadratic. 0 if the ball is not in the void
  /// with room around it, or the bore has lobes or taper.
  /// @param with_floor whether there is material below the bottom
  double way_inside(const Vec3& centre, const Vec3& direction, double radius,
                    bool with_floor) const;

  /// Box around the void, extended up and down without end; everything if it is tilted or tapered.
  Box box() const;
  /// The highest z of the bottom.
  double floor_top() const;

 private:
  struct Local;  ///< a point in the coordinates of the bore

  Local local(const Vec3& at) const;
  double nearest_angle(const Local& point) const;

  Vec3 opening_;
  Matrix3 to_local_;
  Matrix3 from_local_;
  double depth_;
  double radius_;
  double amplitude_;  ///< 0 or more; a negative amplitude is a phase
  double lobes_;
  double phase_;   ///< radians
  double slope_;   ///< change of the radius per mm of depth
  double cosine_;  ///< of the cone's half angle
};

}  // namespace fitgauge::machine
