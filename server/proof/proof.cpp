#include "proof/proof.hpp"

#include <algorithm>
#include <bit>

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

Hash root_of(std::uint64_t size, const NodeReader& read) { return range_root(0, size, read); }

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

std::vector<Hash> consistency_proof(std::uint64_t old_size, std::uint64_t size,
                                    const NodeReader& read) {
  if (old_size == 0 || old_size == size) return {};
  std::vector<Hash> path;
  std::uint64_t begin = 0;
  std::uint64_t end = size;
  // Down to the subtree that the old tree ends with.
  while (old_size != end) {
    const std::uint64_t middle = begin + split_of(end - begin);
    if (old_size <= middle) {
      path.push_back(range_root(middle, end, read));
      end = middle;
    } else {
      path.push_back(range_root(begin, middle, read));
      begin = middle;
    }
  }
  // The verifier knows the old root; where that is this subtree, it is left out.
  if (begin != 0) path.push_back(range_root(begin, end, read));
  std::reverse(path.begin(), path.end());
  return path;
}

bool proves_inclusion(std::uint64_t index, std::uint64_t size, const Hash& leaf,
                      std::span<const Hash> path, const Hash& root) {
  if (index >= size) return false;
  TreeHasher hasher;
  std::uint64_t node = index;
  std::uint64_t last = size - 1;
  Hash hash = leaf;
  for (const Hash& beside : path) {
    if (last == 0) return false;
    if ((node & 1U) != 0 || node == last) {
      hash = hasher.node(beside, hash);
      while ((node & 1U) == 0 && node != 0) {
        node >>= 1U;
        last >>= 1U;
      }
    } else {
      hash = hasher.node(hash, beside);
    }
    node >>= 1U;
    last >>= 1U;
  }
  return last == 0 && hash == root;
}

bool proves_consistency(std::uint64_t old_size, std::uint64_t size, std::span<const Hash> path,
                        const Hash& old_root, const Hash& root) {
  if (old_size > size) return false;
  if (old_size == size) return path.empty() && old_root == root;
  if (old_size == 0) return path.empty() && old_root == empty_root();
  std::vector<Hash> nodes;
  if (std::has_single_bit(old_size)) nodes.push_back(old_root);
  nodes.insert(nodes.end(), path.begin(), path.end());
  if (nodes.empty()) return false;

  std::uint64_t node = old_size - 1;
  std::uint64_t last = size - 1;
  while ((node & 1U) != 0) {
    node >>= 1U;
    last >>= 1U;
  }
  TreeHasher hasher;
  Hash old_hash = nodes.front();
  Hash new_hash = nodes.front();
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (last == 0) return false;
    if ((node & 1U) != 0 || node == last) {
      old_hash = hasher.node(nodes[i], old_hash);
      new_hash = hasher.node(nodes[i], new_hash);
      while ((node & 1U) == 0 && node != 0) {
        node >>= 1U;
        last >>= 1U;
      }
    } else {
      new_hash = hasher.node(new_hash, nodes[i]);
    }
    node >>= 1U;
    last >>= 1U;
  }
  return last == 0 && old_hash == old_root && new_hash == root;
}

}  // namespace fitgauge::tlog
