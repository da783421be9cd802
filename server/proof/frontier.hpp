#pragma once

#include <cstdint>
#include <vector>

#include "proof/tree_hash.hpp"

namespace fitgauge::tlog {

/// A complete subtree of 2^level leaves, the `index`-th of its level from the left.
struct Node {
  unsigned level = 0;
  std::uint64_t index = 0;

  friend bool operator==(const Node&, const Node&) = default;
};

/// The complete subtrees that tile the leaves [begin, end) from left to right, largest possible
/// first: one for each set bit of `size` when begin is 0.
std::vector<Node> subtrees(std::uint64_t begin, std::uint64_t end);

/// The right edge of a growing tree: the roots of its complete subtrees, one for each bit of its
/// size. Appending is O(1) on average and needs nothing else of the tree. Not thread-safe.
class Frontier {
 public:
  Frontier() = default;
  /// @param size and `roots` those of `subtrees(0, size)`, in that order.
  Frontier(std::uint64_t size, std::vector<Hash> roots);

  /// @returns how many complete subtrees ended with this leaf: level 0 always, so at least 1. Their
  ///   roots are completed(0), completed(1), …
  unsigned append(const Hash& leaf);

  /// The root of the subtree of 2^level leaves that the last append completed.
  const Hash& completed(unsigned level) const { return completed_.at(level); }

  std::uint64_t size() const { return size_; }
  Hash root();

 private:
  std::uint64_t size_ = 0;
  std::vector<Hash> roots_;
  std::vector<Hash> completed_;
  TreeHasher hasher_;
};

}  // namespace fitgauge::tlog
