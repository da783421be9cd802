#pragma once

#include "nc/machine/solid.hpp"
#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {

/// The material below a measured surface: the triangles of its points and the walls that fall from
/// their hull.
class SurfaceSolid final : public Solid {
 public:
  /// @pre not all points are on one line in X and Y.
  explicit SurfaceSolid(const Surface& surface);
  Field field(const Vec3& at) const override;
  bool is_traced() const override { return true; }
  Box box() const override;

 private:
  SurfaceSolid(const Surface& surface, const struct Triangulation& mesh);

  struct Candidate {
    Vec3 point;
    Vec3 normal;  ///< of its face
  };
  /// The nearest point of the walls, or `top` when that is nearer.
  Candidate nearest_with_walls(const Vec3& at, const Candidate& top) const;

  TriangleTree top_;
  std::vector<Vec3> hull_;  ///< counter-clockwise, closed: the first point is also the last
};

/// The inside of a closed mesh whose triangles run counter-clockwise seen from outside.
class MeshSolid final : public Solid {
 public:
  /// @pre the mesh has its body.
  explicit MeshSolid(const Mesh& mesh);
  Field field(const Vec3& at) const override;
  std::optional<double> contact(const BallPath& ball) const override;
  Box box() const override { return box_; }

 private:
  bool is_inside(const Vec3& in_body, const Vec3& nearest) const;

  std::shared_ptr<const TriangleTree> body_;
  Transform place_;
  Transform to_body_;
  Box box_;
};

}  // namespace fitgauge::machine
