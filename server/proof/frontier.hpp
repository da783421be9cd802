#pragma once

#include "base/digest.hpp"

namespace fitgauge::tlog {

/// The Merkle tree of RFC 6962, section 2.1, over SHA-256.

using Hash = Digest;

/// SHA-256(0x00 || data): the hash of a leaf.
Hash leaf_hash(std::string_view data);

/// The root of the tree without leaves: SHA-256 of nothing.
Hash empty_root();

/// Hashes many leaves and nodes in turn: the algorithm is set up once. Not thread-safe.
class TreeHasher {
 public:
  TreeHasher() = default;
  // Stateless between two hashes, so a copy is equivalent.
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
  /// @param size and `roots` as of `subtrees(0, size)`, in that order.
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

/// Returns the hash of a complete subtree; may throw errors of its storage.
using NodeReader = std::function<Hash(const Node& node)>;

/// The audit path of the leaf `index` in the tree of `size` leaves, from the leaf up (RFC 6962,
/// 2.1.1).
/// @pre index < size.
std::vector<Hash> inclusion_proof(std::uint64_t index, std::uint64_t size, const NodeReader& read);

/// Hashes of a full tile, and levels of the tree in it (C2SP tlog-tiles).
inline constexpr unsigned kTileWidth = 256;
inline constexpr unsigned kTileHeight = 8;

/// A tile: hashes of the subtrees (8 * level, kTileWidth * index …), or a bundle of entries.
struct Tile {
  enum class Kind { Hashes, Entries };

  Kind kind = Kind::Hashes;
  unsigned level = 0;  ///< 0 to 7; always 0 for entries
  std::uint64_t index = 0;
  unsigned width = kTileWidth;  ///< 1 to 256; below 256 it is partial

  friend bool operator==(const Tile&, const Tile&) = default;

  /// The first of its subtrees or entries.
  std::uint64_t begin() const { return index * kTileWidth; }
  std::uint64_t end() const { return begin() + width; }
};

/// Reads the path after `tile/`: `0/x001/067`, `1/000.p/3`, `entries/x012/000`.
/// @returns none for any other spelling.
std::optional<Tile> parse_tile(std::string_view path);

/// Whether a tree of `size` leaves has everything in the tile.
bool has_tile(std::uint64_t size, const Tile& tile);

}  // namespace fitgauge::tlog
