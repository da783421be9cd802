#include "proof/frontier.hpp"

#include <bit>
#include <stdexcept>
#include <utility>

namespace fitgauge::tlog {

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

}  // namespace fitgauge::tlog
