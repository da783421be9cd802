#include "nc/machine/box_tree.hpp"

namespace fitgauge::machine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the middle; any place serves for an endless box.
double middle(double low, double high) {
  const double sum = low + high;
  return std::isfinite(sum) ? sum / 2 : 0;
}

}  // namespace

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

BoxTree::BoxTree(const std::vector<Box>& boxes, std::vector<std::uint32_t>& order) {
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
  order.clear();
  order.reserve(items.size());
  for (const Item& item : items) order.push_back(item.box);
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
