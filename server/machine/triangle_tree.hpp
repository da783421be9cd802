#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "machine/geometry.hpp"

namespace fitgauge::machine {

using Triangle = std::array<Vec3, 3>;

/// The point of a triangle that is nearest to `at`.
Vec3 nearest_point(const Triangle& triangle, const Vec3& at);

/// Triangles in a tree of boxes. Immutable: thread-safe.
class TriangleTree {
 public:
  /// @pre at least one triangle.
  explicit TriangleTree(std::vector<Triangle> triangles);

  struct Nearest {
    Vec3 point;
    const Triangle* triangle;
  };
  /// The point of all triangles that is nearest to `at`, and the triangle it is of.
  Nearest nearest(const Vec3& at) const;
  /// The z of a triangle above or below (x, y), or nothing outside of all.
  std::optional<double> height(double x, double y) const;
  double highest() const { return nodes_.front().box.max.z; }

 private:
  struct Box {
    Vec3 min;
    Vec3 max;
  };
  struct Node {
    Box box;
    std::uint32_t begin;  ///< of its triangles
    std::uint32_t end;
    std::uint32_t second;  ///< the second child; the first follows its parent; 0 in a leaf
  };

  void build(std::uint32_t begin, std::uint32_t end);
  static double squared_distance(const Box& box, const Vec3& at);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace fitgauge::machine
