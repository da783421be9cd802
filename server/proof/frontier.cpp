#include "proof/frontier.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>
#include <utility>

namespace fitgauge::tlog {
namespace {

/// The root of the leaves [begin, end), whose subtrees are complete but for the last.
Hash range_root(std::uint64_t begin, std::uint64_t end, const NodeReader& read) {
  const std::vector<Node> nodes = subtrees(begin, end);
  if (nodes.empty()) return empty_root();
  TreeHasher hasher;
  Hash root = read(nodes.back());
  for (auto node = nodes.rbegin() + 1; node != nodes.rend(); ++node) {
    root = hasher.node(read(*node), root);
  }
  return root;
}

/// The largest power of two below `size`: where the tree of RFC 6962 splits.
std::uint64_t split_of(std::uint64_t size) { return std::bit_floor(size - 1); }

}  // namespace

Hash TreeHasher::leaf(std::string_view data) {
  constexpr std::array<std::uint8_t, 1> kLeaf{0};
  return sha_.update(kLeaf).update(data).finish();
}

Hash TreeHasher::node(const Hash& left, const Hash& right) {
  constexpr std::array<std::uint8_t, 1> kNode{1};
  return sha_.update(kNode).update(left).update(right).finish();
}

Hash leaf_hash(std::string_view data) { return TreeHasher().leaf(data); }

Hash node_hash(const Hash& left, const Hash& right) { return TreeHasher().node(left, right); }

Hash empty_root() { return sha256(""); }

std::vector<Node> subtrees(std::uint64_t begin, std::uint64_t end) {
  std::vector<Node> nodes;
  while (begin < end) {
    const auto room = static_cast<unsigned>(std::bit_width(end - begin) - 1);
    const unsigned aligned = begin == 0 ? room : static_cast<unsigned>(std::countr_zero(begin));
    const unsigned level = std::min(room, aligned);
    nodes.push_back({level, begin >> level});
    begin += std::uint64_t{1} << level;
  }
  return nodes;
}

Frontier::Frontier(std::uint64_t size, std::vector<Hash> roots)
    : size_(size), roots_(std::move(roots)) {
  if (roots_.size() != static_cast<std::size_t>(std::popcount(size))) {
    throw std::invalid_argument("a frontier has one root for each set bit of its size");
  }
}

unsigned Frontier::append(const Hash& leaf) {
  completed_.assign(1, leaf);
  // Each trailing one of the size is a subtree that the new one completes to twice its size.
  for (std::uint64_t bits = size_; (bits & 1U) != 0; bits >>= 1U) {
    completed_.push_back(hasher_.node(roots_.back(), completed_.back()));
    roots_.pop_back();
  }
  roots_.push_back(completed_.back());
  ++size_;
  return static_cast<unsigned>(completed_.size());
}

Hash Frontier::root() {
  if (roots_.empty()) return empty_root();
  Hash root = roots_.back();
  for (std::size_t i = roots_.size() - 1; i-- > 0;) root = hasher_.node(roots_[i], root);
  return root;
}

std::vector<Hash> inclusion_proof(std::uint64_t index, std::uint64_t size, const NodeReader& read) {
  std::vector<Hash> path;
  std::uint64_t begin = 0;
  std::uint64_t end = size;
  while (end - begin > 1) {
    const std::uint64_t middle = begin + split_of(end - begin);
    if (index < middle) {
      path.push_back(range_root(middle, end, read));
      end = middle;
    } else {
      path.push_back(range_root(begin, middle, read));
      begin = middle;
    }
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace fitgauge::tlog
