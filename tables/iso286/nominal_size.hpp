#pragma once

#include "base/length.hpp"
#include "base/result.hpp"

namespace fitgauge::iso286 {

/// The feature (ISO 286-1, 3.1.1 and 3.1.2): an internal feature of size, or an external one.
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

/// The largest nominal size ISO 286-1 has numbers for (its Table 1 ends there).
inline constexpr Length kLargestNominalSize = Length::millimetres(3150);

/// A nominal size D with 0 < D <= 3150 mm (ISO 286-1, 3.2.1).
class NominalSize {
 public:
  /// @errors SizeOutOfRange.
  static Result<NominalSize> make(Length size);

  /// Reads a size in mm; the whole text is the number.
  /// @errors LengthMalformed, LengthTooFine, SizeOutOfRange.
  static Result<NominalSize> parse_mm(std::string_view text, LengthSyntax syntax = {});

  constexpr Length length() const { return size_; }

  friend constexpr auto operator<=>(NominalSize, NominalSize) = default;

 private:
  explicit constexpr NominalSize(Length size) : size_(size) {}

  Length size_;
};

/// A step of the tables: over < D <= up_to.
struct NominalSizeRange {
  Length over;
  Length up_to;

  constexpr bool contains(NominalSize size) const {
    return over < size.length() && size.length() <= up_to;
  }
  constexpr bool contains(const NominalSizeRange& other) const {
    return over <= other.over && other.up_to <= up_to;
  }

  friend constexpr auto operator<=>(const NominalSizeRange&, const NominalSizeRange&) = default;
};

/// `over 18 up to and including 30 mm`, as the standard words it.
std::string format_range(const NominalSizeRange& range);

}  // namespace fitgauge::iso286
