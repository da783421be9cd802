#include "proof/tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

namespace fitgauge::tlog {
namespace {

/// The index has at most 5 groups of three digits: 256 * 10^15 subtrees are more than there will
/// be.
constexpr std::size_t kMostGroups = 5;
constexpr unsigned kMostLevel = 7;

bool is_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// A decimal number without leading zeros, up to `most`.
std::optional<unsigned> number(std::string_view text, unsigned most) {
  if (text.empty() || !is_digits(text) || (text.size() > 1 && text.front() == '0')) return {};
  unsigned value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || value > most) return {};
  return value;
}

std::vector<std::string_view> split(std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t slash = std::min(path.find('/', at), path.size());
    parts.push_back(path.substr(at, slash - at));
    at = slash + 1;
  }
  return parts;
}

/// `x001/x234/067`: groups of three digits, all but the last marked.
std::optional<std::uint64_t> index_of(const std::vector<std::string_view>& groups) {
  if (groups.empty() || groups.size() > kMostGroups) return {};
  std::uint64_t index = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::string_view digits = groups[i];
    if (i + 1 < groups.size()) {
      if (!digits.starts_with('x')) return {};
      digits.remove_prefix(1);
    }
    if (digits.size() != 3 || !is_digits(digits)) return {};
    if (i == 0 && groups.size() > 1 && digits == "000") return {};
    for (const char digit : digits) index = index * 10 + static_cast<unsigned>(digit - '0');
  }
  return index;
}

}  // namespace

std::optional<Tile> parse_tile(std::string_view path) {
  std::vector<std::string_view> parts = split(path);
  Tile tile;
  if (parts.front() == "entries") {
    tile.kind = Tile::Kind::Entries;
  } else {
    const auto level = number(parts.front(), kMostLevel);
    if (!level) return {};
    tile.level = *level;
  }
  parts.erase(parts.begin());
  constexpr std::string_view kPartial = ".p";
  if (parts.size() >= 2 && parts[parts.size() - 2].ends_with(kPartial)) {
    const auto width = number(parts.back(), kTileWidth - 1);
    if (!width || *width == 0) return {};
    tile.width = *width;
    parts.pop_back();
    parts.back().remove_suffix(kPartial.size());
  }
  const auto index = index_of(parts);
  if (!index) return {};
  tile.index = *index;
  return tile;
}

std::string tile_path(const Tile& tile) {
  std::string index = fmt::format("{:03}", tile.index % 1000);
  for (std::uint64_t rest = tile.index / 1000; rest != 0; rest /= 1000) {
    index = fmt::format("x{:03}/{}", rest % 1000, index);
  }
  const std::string partial =
      tile.width == kTileWidth ? std::string() : fmt::format(".p/{}", tile.width);
  if (tile.kind == Tile::Kind::Entries) return fmt::format("entries/{}{}", index, partial);
  return fmt::format("{}/{}{}", tile.level, index, partial);
}

bool has_tile(std::uint64_t size, const Tile& tile) {
  return tile.end() <= size >> (kTileHeight * tile.level);
}

}  // namespace fitgauge::tlog
