#pragma once

#include <cstdint>
#include <string_view>

#include "base/digest.hpp"

/// The Merkle tree of RFC 6962, section 2.1, over SHA-256.
namespace fitgauge::tlog {

using Hash = Digest;

/// SHA-256(0x00 || data): what a leaf's data counts for in the tree.
Hash leaf_hash(std::string_view data);

/// SHA-256(0x01 || left || right).
Hash node_hash(const Hash& left, const Hash& right);

/// The root of the tree without leaves: SHA-256 of nothing.
Hash empty_root();

/// The same for many leaves and nodes in turn: the algorithm is set up once. Not thread-safe.
class TreeHasher {
 public:
  TreeHasher() = default;
  // Nothing is kept between two hashes: a copy is as good as a new one.
  TreeHasher(const TreeHasher&) {}
  TreeHasher& operator=(const TreeHasher&) { return *this; }
  TreeHasher(TreeHasher&&) noexcept = default;
  TreeHasher& operator=(TreeHasher&&) noexcept = default;
  ~TreeHasher() = default;

  Hash leaf(std::string_view data);
  Hash node(const Hash& left, const Hash& right);

 private:
  Sha256 sha_;
};

}  // namespace fitgauge::tlog
