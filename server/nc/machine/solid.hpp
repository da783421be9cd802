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

}  // namespace fitgauge::machine
