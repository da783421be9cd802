#pragma once

#include <cstdint>
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
  // Standard uncertainties of the two, in the same units:
  std::int64_t temperature_uncertainty = 0;
  std::int64_t expansion_uncertainty = 0;

  friend bool operator==(const ThermalBody&, const ThermalBody&) = default;
};

inline constexpr std::int64_t kLargestExpansion = 1'000'000'000;    ///< 1000 µm/(m·K)
inline constexpr std::int64_t kLargestUncertainty = 1'000'000'000;  ///< 1000 K, 1000 µm/(m·K)
inline constexpr std::int64_t kColdest = -273'150'000;
inline constexpr std::int64_t kHottest = 10'000'000'000;

/// The size at 20 °C of a part that was read on a scale: reading (1 + αs(ts - 20)) / (1 + αp(tp -
/// 20)), exactly, then rounded to the nearest nanometre.
/// @pre 0 <= expansion <= kLargestExpansion and kColdest <= temperature <= kHottest, of both
Length size_at_20_degrees(Length reading, const ThermalBody& part, const ThermalBody& scale);

/// The standard uncertainty that the temperatures and expansions add to a size at 20 °C, in pm: of
/// first order and as if none knew of another (JCGM 100:2008, 5.1.2), with the sensitivities L α /
/// (1
/// + α(t - 20)) to a temperature and L (t - 20) / (1 + α(t - 20)) to an expansion.
/// @param corrected as of size_at_20_degrees
std::int64_t added_uncertainty(Length corrected, const ThermalBody& part, const ThermalBody& scale);

/// √(u² + added²), rounded up to the nanometre. @param added_pm in pm
Length combined_uncertainty(Length u, std::int64_t added_pm);

/// A material by name, with the mean coefficient near 20 °C and where it is from.
struct Material {
  std::string_view name;
  std::int64_t expansion;  ///< as ThermalBody has it
  std::string_view source;
  std::int64_t uncertainty = 0;  ///< standard, of the coefficient; 0: its source does not say
};
std::span<const Material> materials();
/// Null for a name there is no material of.
const Material* find_material(std::string_view name);

}  // namespace fitgauge::gauging
