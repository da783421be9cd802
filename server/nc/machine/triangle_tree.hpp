#pragma once

#include "nc/machine/box_tree.hpp"

namespace fitgauge::machine {

using Triangle = std::array<Vec3, 3>;

/// The point of a triangle that is nearest to `at`.
Vec3 nearest_point(const Triangle& triangle, const Vec3& at);

/// The way after which the ball touches the triangle, in closed form: its face from either side, an
/// edge or a corner. Nothing when it passes by or overlaps the triangle at the start.
std::optional<double> contact(const Triangle& triangle, const BallPath& ball);

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
  /// Returns the nearest point, or nothing if it is not nearer than `within`; fast for small
  /// distances.
  std::optional<Nearest> nearest(const Vec3& at, double within) const;
  /// Returns the shortest way after which the ball touches a triangle that it does not overlap at
  /// the start.
  std::optional<double> contact(const BallPath& ball) const;
  /// The sum of the unit normals of the triangles that have `point`, each by the angle it takes
  /// there. With `point` the nearest of a closed mesh, its side is the side of the mesh (Baerentzen
  /// and Aanaes, Signed distance computation using the angle weighted pseudonormal, 2005).
  Vec3 normal_at(const Vec3& point) const;
  /// Returns the z of a triangle above or below (x, y); none outside of all triangles.
  std::optional<double> height(double x, double y) const;

  const Box& box() const { return tree_.all(); }
  double highest() const { return tree_.all().max.z; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  std::vector<Triangle> triangles_;  ///< in the tree's order
  BoxTree tree_;
};

// stl_file.cpp
/// Reads the triangles of an STL file, binary or text, in the file's unit. Normals are ignored: the
/// order of a triangle's corners defines the outside.
/// @errors FieldInvalid: the file is not STL, or the wrong line or triangle.
Result<std::vector<Triangle>> read_stl(std::string_view bytes);

/// Checks if the triangles bound a body: each has an area, each edge is shared by two in opposite
/// directions, and the volume is positive.
/// @errors FieldInvalid: the mesh is empty, degenerate, open, or inverted, and the place.
Result<void> check_closed(const std::vector<Triangle>& triangles);

/// Returns the volume in the cube of the triangles' unit.
double volume(const std::vector<Triangle>& triangles);

// delaunay.cpp
/// A Delaunay triangulation of points in X and Y.
struct Triangulation {
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise, indices of points
  std::vector<std::uint32_t> hull;                      ///< counter-clockwise
};

/// Triangulates the points; empty if all are on one line. Points at one X and Y are used once.
/// Orientations are exact on a grid of 1 nm; four points on one circle may have either diagonal.
/// @pre coordinates are within ±1e6 mm.
Triangulation delaunay(const std::vector<Vec3>& points);

}  // namespace fitgauge::machine
