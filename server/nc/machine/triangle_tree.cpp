#include "nc/machine/triangle_tree.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {
namespace {

double squared(const Vec3& v) { return dot(v, v); }

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& at) {
  const Vec3 along = b - a;
  const double length = squared(along);
  const double part = length > 0 ? std::clamp(dot(at - a, along) / length, 0.0, 1.0) : 0;
  return a + along * part;
}

/// Returns the smaller root of `square` w^2 + 2 `half` w + `rest` = 0, where the ball comes near;
/// none if it does not, or is already near. Written so that nothing cancels.
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

Box box_of(const Triangle& triangle) {
  Box box = Box::nothing();
  for (const Vec3& corner : triangle) box.join({corner, corner});
  return box;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the middle; any place serves for an endless box.
double middle(double low, double high) {
  const double sum = low + high;
  return std::isfinite(sum) ? sum / 2 : 0;
}

}  // namespace

Vec3 nearest_point(const Triangle& triangle, const Vec3& at) {
  const auto& [a, b, c] = triangle;
  const Vec3 normal = cross(b - a, c - a);
  const auto inside = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(to - from, at - from), normal) >= 0;
  };
  if (inside(a, b) && inside(b, c) && inside(c, a))
    return at - normal * (dot(at - a, normal) / squared(normal));
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
    // The contact surface of a ball and a triangle is convex: the face comes first if its foot is
    // inside.
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

TriangleTree::TriangleTree(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), tree_(triangles_, box_of) {}

std::optional<TriangleTree::Nearest> TriangleTree::nearest(const Vec3& at, double within) const {
  std::optional<Nearest> best;
  double least = within * within;
  tree_.near(at, least, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t t = begin; t < end; ++t) {
      const Vec3 point = nearest_point(triangles_[t], at);
      const double distance = squared(point - at);
      if (distance < least) {
        least = distance;
        best = {point, &triangles_[t]};
      }
    }
  });
  return best;
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& at) const {
  return *nearest(at, std::numeric_limits<double>::infinity());
}

std::optional<double> TriangleTree::contact(const BallPath& ball) const {
  std::optional<double> first;
  double longest = ball.longest;
  tree_.along(ball, longest, [&](std::uint32_t begin, std::uint32_t end, double way) {
    // Starts shortly before the box, where numbers and their rounding are small.
    constexpr double kBefore = 1;
    const double before = std::max(way - kBefore, 0.0);
    const BallPath rest = ball.from(before);
    for (std::uint32_t t = begin; t < end; ++t) {
      const auto touched = machine::contact(triangles_[t], rest);
      if (!touched || before + *touched > longest) continue;
      longest = before + *touched;
      first = longest;
    }
  });
  return first;
}

Vec3 TriangleTree::normal_at(const Vec3& point) const {
  constexpr double kThere = tolerance::kSamePoint;  // STL's floats do not resolve less
  constexpr double kSquared = 1.01 * kThere * kThere;
  Vec3 sum;
  tree_.near(point, kSquared, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t t = begin; t < end; ++t) {
      if (norm(nearest_point(triangles_[t], point) - point) > kThere) continue;
      const auto& [a, b, c] = triangles_[t];
      // Angles at which the edges are seen; an edge that ends at the point has none.
      double angle = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 to_first = triangles_[t][k] - point;
        const Vec3 to_second = triangles_[t][(k + 1) % 3] - point;
        if (norm(to_first) <= kThere || norm(to_second) <= kThere) continue;
        angle += std::atan2(norm(cross(to_first, to_second)), dot(to_first, to_second));
      }
      sum = sum + unit(cross(b - a, c - a)) * angle;
    }
  });
  return sum;
}

std::optional<double> TriangleTree::height(double x, double y) const {
  std::optional<double> found;
  const auto holds = [&](const Box& box) {
    return x >= box.min.x && x <= box.max.x && y >= box.min.y && y <= box.max.y;
  };
  tree_.any(holds, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t t = begin; t < end && !found; ++t) {
      const auto& [a, b, c] = triangles_[t];
      const double weight_a = area_from_above(b, c, x, y);
      const double weight_b = area_from_above(c, a, x, y);
      const double weight_c = area_from_above(a, b, x, y);
      if (weight_a < 0 || weight_b < 0 || weight_c < 0) continue;
      found = (weight_a * a.z + weight_b * b.z + weight_c * c.z) / (weight_a + weight_b + weight_c);
    }
    return found.has_value();
  });
  return found;
}

Box Box::nothing() {
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

Box Box::everything() {
  return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}

void Box::join(const Box& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis] = std::min(min[axis], other.min[axis]);
    max[axis] = std::max(max[axis], other.max[axis]);
  }
}

void Box::grow(double by) {
  const Vec3 side{by, by, by};
  min = min - side;
  max = max + side;
}

double Box::squared_distance(const Vec3& at) const {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double beyond = std::max({min[axis] - at[axis], at[axis] - max[axis], 0.0});
    sum += beyond * beyond;
  }
  return sum;
}

std::optional<double> Box::way_to(const BallPath& ball) const {
  double enters = 0;
  double leaves = ball.longest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = min[axis] - ball.radius - ball.start[axis];
    const double high = max[axis] + ball.radius - ball.start[axis];
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

std::vector<BoxTree::Item> BoxTree::build(const std::vector<Box>& boxes) {
  std::vector<Item> items;
  items.reserve(boxes.size());
  for (const Box& box : boxes) {
    Item& item = items.emplace_back();
    item.box = static_cast<std::uint32_t>(items.size() - 1);
    for (std::size_t axis = 0; axis < 3; ++axis)
      item.centre[axis] = middle(box.min[axis], box.max[axis]);
  }
  nodes_.reserve(boxes.size());
  if (!items.empty()) build(boxes, items, 0, static_cast<std::uint32_t>(items.size()));
  nodes_.shrink_to_fit();
  return items;
}

void BoxTree::build(const std::vector<Box>& boxes, std::vector<Item>& items, std::uint32_t begin,
                    std::uint32_t end) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({Box::nothing(), begin, end, 0});
  constexpr std::uint32_t kLeaf = 4;
  if (end - begin <= kLeaf) {
    for (std::uint32_t k = begin; k < end; ++k) nodes_[self].box.join(boxes[items[k].box]);
    return;
  }
  const auto first = items.begin();
  Box centres = Box::nothing();
  for (std::uint32_t k = begin; k < end; ++k) centres.join({items[k].centre, items[k].centre});
  const Vec3 size = centres.max - centres.min;
  const std::size_t longest = size.x >= size.y   ? (size.x >= size.z ? 0 : 2)
                              : size.y >= size.z ? 1
                                                 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      first + begin, first + middle, first + end,
      [longest](const Item& a, const Item& b) { return a.centre[longest] < b.centre[longest]; });
  build(boxes, items, begin, middle);
  nodes_[self].second = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, items, middle, end);
  nodes_[self].box = nodes_[self + 1].box;
  nodes_[self].box.join(nodes_[nodes_[self].second].box);
}

}  // namespace fitgauge::machine
