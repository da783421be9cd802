#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "metrology/gauging/verdict.hpp"
#include "tables/iso286/feature.hpp"

namespace fitgauge::gauging {

/// The kind of a measured value. A radius and a chamfer are those of an outside edge (ISO 2768-1,
/// table 2); a deviation is that of a surface from its nominal form.
enum class Quantity : std::uint8_t {
  Diameter,
  Width,
  PitchDiameter,
  Position,
  Distance,
  Radius,
  Chamfer,
  Deviation
};

inline constexpr std::array<std::string_view, 8> kQuantityWords = {
    "diameter", "width",  "pitch_diameter", "position",
    "distance", "radius", "chamfer",        "deviation"};

/// `diameter`, `pitch_diameter`.
constexpr std::string_view word(Quantity quantity) {
  return kQuantityWords.at(static_cast<std::size_t>(quantity));
}
constexpr std::optional<Quantity> quantity_from_word(std::string_view text) {
  for (std::size_t i = 0; i < kQuantityWords.size(); ++i) {
    if (kQuantityWords.at(i) == text) return static_cast<Quantity>(i);
  }
  return std::nullopt;
}

/// Whether it is the size of a hole or a shaft.
constexpr bool has_feature(Quantity quantity) { return quantity <= Quantity::PitchDiameter; }
/// Whether it may be 0 or less.
constexpr bool is_signed(Quantity quantity) {
  return quantity == Quantity::Position || quantity == Quantity::Distance ||
         quantity == Quantity::Deviation;
}

/// The verdicts beyond the two limits: rework where material can still be removed.
struct Beyond {
  Verdict above = Verdict::Reject;
  Verdict below = Verdict::Reject;

  constexpr Beyond() = default;
  constexpr Beyond(iso286::Feature feature)  // NOLINT(google-explicit-constructor)
      : above(feature == iso286::Feature::Hole ? Verdict::Reject : Verdict::Rework),
        below(feature == iso286::Feature::Hole ? Verdict::Rework : Verdict::Reject) {}
  /// An edge that is broken too little can be broken further, as a hole can be widened.
  constexpr Beyond(Quantity quantity, iso286::Feature feature)
      : Beyond(has_feature(quantity) ? Beyond(feature)
               : is_signed(quantity) ? Beyond()
                                     : Beyond(iso286::Feature::Hole)) {}
};

}  // namespace fitgauge::gauging
