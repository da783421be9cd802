#pragma once

#include "nc/machine/triangle_tree.hpp"

/// Closed meshes whose figures are known, and STL files of them.
namespace fitgauge::machine {

using Triangles = std::vector<Triangle>;

/// Two triangles for each cell of a grid that closes in both directions.
inline Triangles closed_grid(int rows, int columns, const std::function<Vec3(int, int)>& corner) {
  Triangles triangles;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const Vec3 a = corner(i, j);
      const Vec3 b = corner((i + 1) % rows, j);
      const Vec3 c = corner((i + 1) % rows, (j + 1) % columns);
      const Vec3 d = corner(i, (j + 1) % columns);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

/// Corners on the torus around Z.
inline Triangles torus(double radius, double tube, int rows, int columns) {
  return closed_grid(rows, columns, [=](int i, int j) {
    const double u = 2 * kPi * i / rows;
    const double v = 2 * kPi * j / columns;
    const double across = radius + tube * std::cos(v);
    return Vec3{across * std::cos(u), across * std::sin(u), tube * std::sin(v)};
  });
}

/// A ring from z = -height to 0 whose hole and outside are regular prisms with corners on the
/// circles.
inline Triangles ring(double inside, double outside, double height, int corners) {
  return closed_grid(corners, 4, [=](int i, int j) {
    const double angle = 2 * kPi * i / corners;
    const double radius = j == 0 || j == 3 ? inside : outside;
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), j < 2 ? -height : 0};
  });
}

inline Triangles box(const Vec3& min, const Vec3& max) {
  const auto corner = [&](int k) {
    return Vec3{(k & 1) != 0 ? max.x : min.x, (k & 2) != 0 ? max.y : min.y,
                (k & 4) != 0 ? max.z : min.z};
  };
  Triangles triangles;
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    triangles.push_back({corner(a), corner(b), corner(c)});
    triangles.push_back({corner(a), corner(c), corner(d)});
  }
  return triangles;
}

/// Of edge length 2.
inline Triangles icosahedron() {
  const double golden = (1 + std::sqrt(5)) / 2;
  std::vector<Vec3> corners;
  for (const double one : {-1.0, 1.0}) {
    for (const double phi : {-golden, golden}) {
      corners.push_back({0, one, phi});
      corners.push_back({one, phi, 0});
      corners.push_back({phi, 0, one});
    }
  }
  Triangles triangles;
  const auto is_edge = [](const Vec3& a, const Vec3& b) { return std::abs(norm(b - a) - 2) < 0.1; };
  for (std::size_t a = 0; a < corners.size(); ++a) {
    for (std::size_t b = a + 1; b < corners.size(); ++b) {
      for (std::size_t c = b + 1; c < corners.size(); ++c) {
        const Triangle t{corners[a], corners[b], corners[c]};
        if (!is_edge(t[0], t[1]) || !is_edge(t[1], t[2]) || !is_edge(t[2], t[0])) continue;
        const bool out = dot(cross(t[1] - t[0], t[2] - t[0]), t[0]) > 0;
        triangles.push_back(out ? t : Triangle{t[0], t[2], t[1]});
      }
    }
  }
  return triangles;
}

inline Triangles turned_round(Triangles triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

inline std::string binary_stl(const Triangles& triangles) {
  std::string bytes(80, ' ');
  const auto add = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    for (int k = 0; k < 3; ++k) add(0.0F);
    for (const Vec3& corner : triangle) {
      for (std::size_t k = 0; k < 3; ++k) add(static_cast<float>(corner[k]));
    }
    add(std::uint16_t{0});
  }
  return bytes;
}

inline std::string text_stl(const Triangles& triangles) {
  std::string text = "solid part of a test\n";
  for (const Triangle& triangle : triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const Vec3& p : triangle) {
      char line[100];
      std::snprintf(line, sizeof line, "   vertex %.17g %.17g %.17e\n", p.x, p.y, p.z);
      text += line;
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid\n";
}

}  // namespace fitgauge::machine
