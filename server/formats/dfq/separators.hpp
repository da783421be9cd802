#pragma once

#include <cstdint>
#include <string_view>

namespace fitgauge::aqdef {

/// How much more room separate() needs than a text has bytes.
inline constexpr std::size_t kSeparateRoom = 8;

/// Behind what separate() has written.
struct Separated {
  std::uint32_t* starts = nullptr;
  std::uint32_t* values = nullptr;
};

/// Takes a line of values apart.
/// @param starts gets where each field begins but the first: behind each separator
/// @param values gets for each separator of values how many separators there are up to it
/// @pre both have room for as many as the text has bytes, and kSeparateRoom
Separated separate(std::string_view text, std::uint32_t* starts, std::uint32_t* values);

}  // namespace fitgauge::aqdef
