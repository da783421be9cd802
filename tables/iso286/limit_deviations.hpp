#pragma once

#include "base/length.hpp"
#include "tables/iso286/nominal_size.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {

/// The limit deviations from the nominal size: ES and EI of a hole, es and ei of a shaft
/// (ISO 286-1, 3.2.6).
struct LimitDeviations {
  Length upper;
  Length lower;

  friend constexpr auto operator<=>(const LimitDeviations&, const LimitDeviations&) = default;
};

class ToleranceTables;

/// Returns the deviations of a class for every size of one range of the tables. For a standard
/// class they are the deviations at its end. For a custom one, the deviations that its rows share
/// there, if they cover the range.
std::optional<LimitDeviations> deviations_in_range(const ToleranceTables& tables, ClassId id,
                                                   const NominalSizeRange& range);

/// Source of limits: the standard, or a custom tolerance class.
enum class Basis : std::uint8_t { Iso286, Custom };

/// `iso286` or `custom`.
constexpr std::string_view word(Basis basis) {
  return basis == Basis::Iso286 ? "iso286" : "custom";
}

/// The limits of size of one nominal size and class (ISO 286-1, 3.2.3), exact in nanometres.
struct LimitsOfSize {
  NominalSize nominal_size;
  ClassId class_id;
  Feature feature;
  Basis basis;
  LimitDeviations deviations;
  NominalSizeRange size_range;  ///< the step of the standard tolerance, or the custom column's row

  constexpr Length upper_limit() const { return nominal_size.length() + deviations.upper; }
  constexpr Length lower_limit() const { return nominal_size.length() + deviations.lower; }
  constexpr Length tolerance() const { return deviations.upper - deviations.lower; }
};

/// ISO 286-1, 3.3.
enum class FitKind : std::uint8_t { Clearance, Transition, Interference };

/// `clearance`, `transition` or `interference`.
std::string_view word(FitKind kind);

/// A hole and a shaft of one nominal size. Interference is negative clearance.
struct Fit {
  LimitsOfSize hole;
  LimitsOfSize shaft;

  Length max_clearance() const { return hole.deviations.upper - shaft.deviations.lower; }
  Length min_clearance() const { return hole.deviations.lower - shaft.deviations.upper; }

  /// EI - es = 0 is a clearance fit (3.3.4), ES - ei = 0 an interference fit (3.3.5).
  FitKind kind() const;
};

}  // namespace fitgauge::iso286
