#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace fitgauge::iso286 {

/// What is measured (ISO 286-1, 3.1.1 and 3.1.2): an internal feature of size, or an external one.
enum class Feature : std::uint8_t { Hole, Shaft };

/// `hole` or `shaft`.
constexpr std::string_view word(Feature feature) {
  return feature == Feature::Hole ? "hole" : "shaft";
}

constexpr std::optional<Feature> feature_from_word(std::string_view text) {
  if (text == "hole") return Feature::Hole;
  if (text == "shaft") return Feature::Shaft;
  return std::nullopt;
}

}  // namespace fitgauge::iso286
