#include "machine/triangle_tree.hpp"

#include <algorithm>
#include <limits>

namespace fitgauge::machine {
namespace {

double squared(const Vec3& v) { return dot(v, v); }

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& at) {
  const Vec3 along = b - a;
  const double length = squared(along);
  const double part = length > 0 ? std::clamp(dot(at - a, along) / length, 0.0, 1.0) : 0;
  return a + along * part;
}

/// Twice the area of a, b, c seen from above; positive counter-clockwise.
double area_from_above(const Vec3& a, const Vec3& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

Vec3 nearest_point(const Triangle& triangle, const Vec3& at) {
  const auto& [a, b, c] = triangle;
  const Vec3 normal = cross(b - a, c - a);
  const auto inside = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(to - from, at - from), normal) >= 0;
  };
  if (inside(a, b) && inside(b, c) && inside(c, a)) {
    return at - normal * (dot(at - a, normal) / squared(normal));
  }
  Vec3 nearest = nearest_on_segment(a, b, at);
  for (const Vec3& other : {nearest_on_segment(b, c, at), nearest_on_segment(c, a, at)}) {
    if (squared(other - at) < squared(nearest - at)) nearest = other;
  }
  return nearest;
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  nodes_.reserve(triangles_.size());
  build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (std::uint32_t t = begin; t < end; ++t) {
    for (const Vec3& p : triangles_[t]) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] = std::min(box.min[axis], p[axis]);
        box.max[axis] = std::max(box.max[axis], p[axis]);
      }
    }
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({box, begin, end, 0});
  constexpr std::uint32_t kLeaf = 4;
  if (end - begin <= kLeaf) return;

  const Vec3 size = box.max - box.min;
  const std::size_t longest = size.x >= size.y   ? (size.x >= size.z ? 0 : 2)
                              : size.y >= size.z ? 1
                                                 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto first = triangles_.begin();
  const auto centre = [longest](const Triangle& t) {
    return t[0][longest] + t[1][longest] + t[2][longest];
  };
  std::nth_element(first + begin, first + middle, first + end,
                   [&](const Triangle& a, const Triangle& b) { return centre(a) < centre(b); });
  build(begin, middle);
  nodes_[self].second = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

double TriangleTree::squared_distance(const Box& box, const Vec3& at) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double beyond = std::max({box.min[axis] - at[axis], at[axis] - box.max[axis], 0.0});
    sum += beyond * beyond;
  }
  return sum;
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& at) const {
  Nearest best{triangles_.front()[0], &triangles_.front()};
  double least = std::numeric_limits<double>::infinity();
  std::array<std::uint32_t, 64> open{};  // a balanced tree of 32-bit counts is less deep
  std::size_t size = 1;
  while (size > 0) {
    const std::uint32_t index = open[--size];
    const Node& node = nodes_[index];
    if (squared_distance(node.box, at) >= least) continue;
    if (node.second == 0) {
      for (std::uint32_t t = node.begin; t < node.end; ++t) {
        const Vec3 point = nearest_point(triangles_[t], at);
        const double distance = squared(point - at);
        if (distance < least) {
          least = distance;
          best = {point, &triangles_[t]};
        }
      }
      continue;
    }
    std::uint32_t near = index + 1;
    std::uint32_t far = node.second;
    if (squared_distance(nodes_[far].box, at) < squared_distance(nodes_[near].box, at)) {
      std::swap(near, far);
    }
    open[size++] = far;
    open[size++] = near;
  }
  return best;
}

std::optional<double> TriangleTree::height(double x, double y) const {
  std::array<std::uint32_t, 64> open{};
  std::size_t size = 1;
  while (size > 0) {
    const std::uint32_t index = open[--size];
    const Node& node = nodes_[index];
    const Box& box = node.box;
    if (x < box.min.x || x > box.max.x || y < box.min.y || y > box.max.y) continue;
    if (node.second != 0) {
      open[size++] = node.second;
      open[size++] = index + 1;
      continue;
    }
    for (std::uint32_t t = node.begin; t < node.end; ++t) {
      const auto& [a, b, c] = triangles_[t];
      const double weight_a = area_from_above(b, c, x, y);
      const double weight_b = area_from_above(c, a, x, y);
      const double weight_c = area_from_above(a, b, x, y);
      if (weight_a < 0 || weight_b < 0 || weight_c < 0) continue;
      return (weight_a * a.z + weight_b * b.z + weight_c * c.z) / (weight_a + weight_b + weight_c);
    }
  }
  return std::nullopt;
}

}  // namespace fitgauge::machine
