#pragma once

#include <memory>

#include "nc/machine/solid.hpp"
#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {

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
