#pragma once

#include "proof/frontier.hpp"

namespace fitgauge::tlog {

/// `0/x001/067`: the inverse of parse_tile.
inline std::string tile_path(const Tile& tile) {
  std::string index = fmt::format("{:03}", tile.index % 1000);
  for (std::uint64_t rest = tile.index / 1000; rest != 0; rest /= 1000) {
    index = fmt::format("x{:03}/{}", rest % 1000, index);
  }
  const std::string partial =
      tile.width == kTileWidth ? std::string() : fmt::format(".p/{}", tile.width);
  if (tile.kind == Tile::Kind::Entries) return fmt::format("entries/{}{}", index, partial);
  return fmt::format("{}/{}{}", tile.level, index, partial);
}

}  // namespace fitgauge::tlog
