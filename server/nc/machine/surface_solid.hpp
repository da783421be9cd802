#pragma once

#include <vector>

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
    Vec3 normal;  ///< of the face it lies on
  };
  /// The nearest point of the walls, or `top` when that is nearer.
  Candidate nearest_with_walls(const Vec3& at, const Candidate& top) const;

  TriangleTree top_;
  std::vector<Vec3> hull_;  ///< counter-clockwise, closed: the first point is also the last
};

}  // namespace fitgauge::machine
