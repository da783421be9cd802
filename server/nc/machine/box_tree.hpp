#pragma once

#include "nc/machine/geometry.hpp"

namespace fitgauge::machine {

/// A ball on a straight path; all in mm.
struct BallPath {
  Vec3 start;      ///< of its centre
  Vec3 direction;  ///< of length 1
  double radius = 0;
  double longest = 0;  ///< end of the path

  Vec3 at(double way) const { return start + direction * way; }
  /// The rest of the path from `way` on.
  BallPath from(double way) const { return {at(way), direction, radius, longest - way}; }
};

/// The points between two corners; may be endless.
struct Box {
  Vec3 min;
  Vec3 max;

  static Box nothing();
  static Box everything();

  void join(const Box& other);
  /// Moves every side outwards.
  void grow(double by);
  bool contains(const Vec3& at) const {
    return at.x >= min.x && at.x <= max.x && at.y >= min.y && at.y <= max.y && at.z >= min.z &&
           at.z <= max.z;
  }
  double squared_distance(const Vec3& at) const;
  /// The way after which the ball may touch something in the box: its centre enters the box grown
  /// by its radius.
  std::optional<double> way_to(const BallPath& ball) const;
};

/// A tree of boxes. The owner keeps its items in the order of the tree: a leaf is a range of
/// places. Immutable: thread-safe.
class BoxTree {
 public:
  BoxTree() = default;
  /// Brings the items into the order of the tree. @param box_of the box of an item
  template <class Kept, class BoxOf>
  BoxTree(std::vector<Kept>& items, const BoxOf& box_of) {
    std::vector<Box> boxes;
    boxes.reserve(items.size());
    for (const Kept& item : items) boxes.push_back(box_of(item));
    std::vector<Kept> ordered;
    ordered.reserve(items.size());
    for (const Item& item : build(boxes)) ordered.push_back(std::move(items[item.box]));
    items = std::move(ordered);
  }

  bool is_empty() const { return nodes_.empty(); }
  /// Bounds of all triangles. @pre not empty.
  const Box& all() const { return nodes_.front().box; }

  /// Calls visit(begin, end) for leaves with boxes not farther than the root of `squared`, which it
  /// may reduce, the nearer child first.
  template <class Visit>
  void near(const Vec3& at, const double& squared, const Visit& visit) const {
    nearest_first([&at](const Box& box) { return std::optional(box.squared_distance(at)); },
                  squared,
                  [&visit](std::uint32_t begin, std::uint32_t end, double) { visit(begin, end); });
  }

  /// Calls visit(begin, end, way) for the leaves that the ball may touch within `longest`, mostly
  /// nearest boxes first. `visit` may reduce `longest`.
  template <class Visit>
  void along(const BallPath& ball, const double& longest, const Visit& visit) const {
    nearest_first([&ball](const Box& box) { return box.way_to(ball); }, longest, visit);
  }

  /// Calls visit(begin, end) for the leaves with `holds(box)`, until one returns true.
  /// @returns whether one did.
  template <class Holds, class Visit>
  bool any(const Holds& holds, const Visit& visit) const {
    if (is_empty()) return false;
    Stack<std::uint32_t> open;
    open.push(0);
    while (!open.is_empty()) {
      const std::uint32_t index = open.pop();
      const Node& node = nodes_[index];
      if (!holds(node.box)) continue;
      if (node.second == 0) {
        if (visit(node.begin, node.end)) return true;
        continue;
      }
      open.push(node.second);
      open.push(index + 1);
    }
    return false;
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin;  ///< of its places
    std::uint32_t end;
    std::uint32_t second;  ///< the second child; the first follows its parent; 0 in a leaf
  };
  struct Item {
    Vec3 centre;
    std::uint32_t box;
  };
  /// A balanced tree of 32-bit counts is less deep.
  template <class T>
  struct Stack {
    void push(const T& value) { values[size++] = value; }
    T pop() { return values[--size]; }
    bool is_empty() const { return size == 0; }

    std::array<T, 64> values;
    std::size_t size = 0;
  };

  /// Calls visit(begin, end, way) for the leaves to whose boxes `way_to` leads within `longest`.
  template <class WayTo, class Visit>
  void nearest_first(const WayTo& way_to, const double& longest, const Visit& visit) const {
    if (is_empty()) return;
    struct Open {
      std::uint32_t index;
      double way;
    };
    Stack<Open> open;
    const auto push = [&](std::uint32_t index, const std::optional<double>& way) {
      if (way && *way <= longest) open.push({index, *way});
    };
    push(0, way_to(nodes_.front().box));
    while (!open.is_empty()) {
      const Open next = open.pop();
      if (next.way > longest) continue;
      const Node& node = nodes_[next.index];
      if (node.second == 0) {
        visit(node.begin, node.end, next.way);
        continue;
      }
      const auto first = way_to(nodes_[next.index + 1].box);
      const auto second = way_to(nodes_[node.second].box);
      const bool in_order = !second || (first && *first <= *second);
      push(in_order ? node.second : next.index + 1, in_order ? second : first);
      push(in_order ? next.index + 1 : node.second, in_order ? first : second);
    }
  }

  /// Builds the tree of boxes. @returns their numbers in its order
  std::vector<Item> build(const std::vector<Box>& boxes);
  void build(const std::vector<Box>& boxes, std::vector<Item>& items, std::uint32_t begin,
             std::uint32_t end);

  std::vector<Node> nodes_;
};

}  // namespace fitgauge::machine
