#pragma once

#include "nc/machine/box_tree.hpp"
#include "nc/machine/geometry.hpp"
#include "nc/machine/machine_setup.hpp"
#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {

/// A signed distance to a boundary and its gradient, a unit vector away from the material: the
/// nearest point of the boundary is `at - distance * gradient`.
struct Field {
  double distance = 0;  ///< in mm, negative inside the material
  Vec3 gradient{0, 0, 1};

  Vec3 foot(const Vec3& at) const { return at - gradient * distance; }
};

/// Material that a feature adds. The distance is exact outside; inside it is negative and exact
/// wherever the nearest boundary is a face. Immutable: thread-safe.
class Solid {
 public:
  Solid& operator=(Solid&&) = delete;  // neither copied nor moved
  virtual ~Solid() = default;

  virtual Field field(const Vec3& at) const = 0;
  /// Whether `contact` is not exact, so that the path must be traced step by step.
  virtual bool is_traced() const { return false; }
  /// Returns the distance until the ball touches, 0 if it touches at the start. The default is for
  /// convex bodies, whose distance is convex along a line. Newton's steps never pass the contact:
  /// one for a face, a few for a rounding.
  virtual std::optional<double> contact(const BallPath& ball) const;
  /// Box around the material; infinite if the material is.
  virtual Box box() const = 0;
  /// Lowest z of the material, -infinity without a lower end.
  double bottom() const { return box().min.z; }
};

class BlockSolid final : public Solid {
 public:
  explicit BlockSolid(const Block& block);
  Field field(const Vec3& at) const override;
  Box box() const override { return {centre_ - half_, centre_ + half_}; }

 private:
  Vec3 centre_;
  Vec3 half_;
};

class BossSolid final : public Solid {
 public:
  explicit BossSolid(const Boss& boss);
  Field field(const Vec3& at) const override;
  Box box() const override {
    const Vec3 half{radius_, radius_, half_height_};
    return {centre_ - half, centre_ + half};
  }

 private:
  Vec3 centre_;
  double radius_;
  double half_height_;
};

class PlaneSolid final : public Solid {
 public:
  explicit PlaneSolid(const Plane& plane) : point_(plane.point), normal_(unit(plane.normal)) {}
  Field field(const Vec3& at) const override { return {dot(at - point_, normal_), normal_}; }
  Box box() const override { return Box::everything(); }

 private:
  Vec3 point_;
  Vec3 normal_;
};

class SphereSolid final : public Solid {
 public:
  explicit SphereSolid(const Sphere& sphere)
      : centre_(sphere.centre), radius_(sphere.diameter / 2) {}
  Field field(const Vec3& at) const override;
  Box box() const override {
    const Vec3 half{radius_, radius_, radius_};
    return {centre_ - half, centre_ + half};
  }

 private:
  Vec3 centre_;
  double radius_;
};

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
