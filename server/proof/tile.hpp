#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proof/frontier.hpp"

namespace fitgauge::tlog {

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

/// Reads what stands behind `tile/`: `0/x001/067`, `1/000.p/3`, `entries/x012/000`.
/// @returns none for any other spelling.
std::optional<Tile> parse_tile(std::string_view path);

/// `0/x001/067`: the inverse of parse_tile.
std::string tile_path(const Tile& tile);

/// Whether a tree of `size` leaves has all that the tile holds.
bool has_tile(std::uint64_t size, const Tile& tile);

}  // namespace fitgauge::tlog
