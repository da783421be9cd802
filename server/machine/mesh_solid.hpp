#pragma once

#include <memory>

#include "machine/solid.hpp"
#include "machine/triangle_tree.hpp"

namespace fitgauge::machine {

/// The inside of a closed mesh whose triangles run counter-clockwise seen from outside.
class MeshSolid final : public Solid {
 public:
  /// @pre the mesh has its body.
  explicit MeshSolid(const Mesh& mesh);
  Field field(const Vec3& at) const override;
  std::optional<double> contact(const BallPath& ball) const override;
  double bottom() const override { return bottom_; }

 private:
  std::shared_ptr<const TriangleTree> body_;
  Transform place_;
  Transform to_body_;
  double bottom_;
};

}  // namespace fitgauge::machine
