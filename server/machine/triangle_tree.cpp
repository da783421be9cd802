#include "machine/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
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

/// The lesser root of `square` w^2 + 2 `half` w + `rest` = 0, which is where the ball comes near;
/// nothing when it does not, or is near already. Written so that nothing cancels.
std::optional<double> root_ahead(double square, double half, double rest) {
  if (half >= 0 || rest < 0) return std::nullopt;
  const double discriminant = half * half - square * rest;
  if (discriminant < 0) return std::nullopt;
  return rest / (std::sqrt(discriminant) - half);
}

std::optional<double> contact_with_corner(const Vec3& corner, const BallPath& ball) {
  const Vec3 from = ball.start - corner;
  return root_ahead(1, dot(from, ball.direction), squared(from) - ball.radius * ball.radius);
}

/// The edge without its ends.
std::optional<double> contact_with_edge(const Vec3& a, const Vec3& b, const BallPath& ball) {
  const Vec3 along = unit(b - a);
  const Vec3 from = ball.start - a;
  const double height = dot(from, along);
  const double climb = dot(ball.direction, along);
  const Vec3 across = from - along * height;
  const Vec3 heading = ball.direction - along * climb;
  const auto way = root_ahead(squared(heading), dot(across, heading),
                              squared(across) - ball.radius * ball.radius);
  if (!way) return std::nullopt;
  const double foot = height + climb * *way;
  return foot >= 0 && foot <= norm(b - a) ? way : std::nullopt;
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

std::optional<double> contact(const Triangle& triangle, const BallPath& ball) {
  const auto& [a, b, c] = triangle;
  Vec3 normal = unit(cross(b - a, c - a));
  double height = dot(ball.start - a, normal);
  if (height < 0) {
    normal = -normal;
    height = -height;
  }
  const double descent = -dot(ball.direction, normal);
  if (height >= ball.radius) {
    if (descent <= 0) return std::nullopt;
    // What a ball can touch of a triangle is convex: the face comes first where its foot is inside.
    const double way = (height - ball.radius) / descent;
    const Vec3 foot = ball.at(way) - normal * ball.radius;
    const auto inside = [&](const Vec3& from, const Vec3& to, const Vec3& third) {
      const Vec3 inward = cross(normal, to - from);
      return dot(foot - from, inward) * dot(third - from, inward) >= 0;
    };
    if (inside(a, b, c) && inside(b, c, a) && inside(c, a, b)) return way;
  }
  std::optional<double> first;
  const auto take = [&first](std::optional<double> way) {
    if (way && (!first || *way < *first)) first = way;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    take(contact_with_edge(triangle[k], triangle[(k + 1) % 3], ball));
    take(contact_with_corner(triangle[k], ball));
  }
  return first;
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

/// The way after which the ball may touch something in the box: its centre enters the box grown by
/// its radius.
std::optional<double> TriangleTree::way_to(const Box& box, const BallPath& ball) {
  double enters = 0;
  double leaves = ball.longest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis] - ball.radius - ball.start[axis];
    const double high = box.max[axis] + ball.radius - ball.start[axis];
    const double speed = ball.direction[axis];
    if (speed == 0) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    enters = std::max(enters, (speed > 0 ? low : high) / speed);
    leaves = std::min(leaves, (speed > 0 ? high : low) / speed);
  }
  return enters <= leaves ? std::optional(enters) : std::nullopt;
}

std::optional<double> TriangleTree::contact(const BallPath& ball) const {
  std::optional<double> first;
  struct Open {
    std::uint32_t index;
    double way;
  };
  std::array<Open, 64> open{};
  std::size_t size = 0;
  const auto push = [&](std::uint32_t index, std::optional<double> way) {
    if (way && (!first || *way < *first)) open[size++] = {index, *way};
  };
  push(0, way_to(nodes_.front().box, ball));
  while (size > 0) {
    const Open next = open[--size];
    if (first && next.way >= *first) continue;
    const Node& node = nodes_[next.index];
    if (node.second != 0) {
      const auto near = way_to(nodes_[next.index + 1].box, ball);
      const auto far = way_to(nodes_[node.second].box, ball);
      const bool in_order = !far || (near && *near <= *far);
      push(in_order ? node.second : next.index + 1, in_order ? far : near);
      push(in_order ? next.index + 1 : node.second, in_order ? near : far);
      continue;
    }
    // From shortly before the box, where the figures are small and so is their rounding.
    constexpr double kBefore = 1;
    const double begin = std::max(next.way - kBefore, 0.0);
    const BallPath rest = ball.from(begin);
    for (std::uint32_t t = node.begin; t < node.end; ++t) {
      const auto touched = machine::contact(triangles_[t], rest);
      if (!touched || *touched > rest.longest) continue;
      const double way = begin + *touched;
      if (!first || way < *first) first = way;
    }
  }
  return first;
}

Vec3 TriangleTree::normal_at(const Vec3& point) const {
  constexpr double kThere = 1e-9;  // mm: far below what STL's floats tell apart
  Vec3 sum;
  std::array<std::uint32_t, 64> open{};
  std::size_t size = 1;
  while (size > 0) {
    const std::uint32_t index = open[--size];
    const Node& node = nodes_[index];
    if (squared_distance(node.box, point) > kThere * kThere) continue;
    if (node.second != 0) {
      open[size++] = node.second;
      open[size++] = index + 1;
      continue;
    }
    for (std::uint32_t t = node.begin; t < node.end; ++t) {
      if (norm(nearest_point(triangles_[t], point) - point) > kThere) continue;
      const auto& [a, b, c] = triangles_[t];
      // The angles under which the edges are seen; one whose end is the point is not seen at all.
      double angle = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 to_first = triangles_[t][k] - point;
        const Vec3 to_second = triangles_[t][(k + 1) % 3] - point;
        if (norm(to_first) <= kThere || norm(to_second) <= kThere) continue;
        angle += std::atan2(norm(cross(to_first, to_second)), dot(to_first, to_second));
      }
      sum = sum + unit(cross(b - a, c - a)) * angle;
    }
  }
  return sum;
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
