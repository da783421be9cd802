#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/length.hpp"

namespace fitgauge::gauging {

// Sizes are those at 20 °C (ISO 1:2022): a part and the scale it is measured with are mostly not.

/// Temperature of a body in millionths of a degree Celsius, and its coefficient of linear expansion
/// in millionths of µm/(m·K).
struct ThermalBody {
  std::int64_t temperature = 20'000'000;
  std::int64_t expansion = 0;

  friend bool operator==(const ThermalBody&, const ThermalBody&) = default;
};

inline constexpr std::int64_t kLargestExpansion = 1'000'000'000;  ///< 1000 µm/(m·K)
inline constexpr std::int64_t kColdest = -273'150'000;
inline constexpr std::int64_t kHottest = 10'000'000'000;

/// The size at 20 °C of a part that was read on a scale: reading (1 + αs(ts - 20)) / (1 + αp(tp -
/// 20)), exactly, then rounded to the nearest nanometre.
/// @pre 0 <= expansion <= kLargestExpansion and kColdest <= temperature <= kHottest, of both
Length size_at_20_degrees(Length reading, const ThermalBody& part, const ThermalBody& scale);

/// A material by name, with the mean coefficient near 20 °C and where it is from.
struct Material {
  std::string_view name;
  std::int64_t expansion;  ///< as ThermalBody has it
  std::string_view source;
};
std::span<const Material> materials();
/// None for a name there is no material of.
std::optional<std::int64_t> expansion_of(std::string_view material);

}  // namespace fitgauge::gauging
