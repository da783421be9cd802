#pragma once

#include "base/length.hpp"
#include "metrology/gauging/conformance.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::gauging {

/// The verdict on a part. Rework: a hole too small or a shaft too large, more can be cut. Reject:
/// a hole too large or a shaft too small. Indeterminate: too near a limit for the uncertainty.
/// Unjudged: a value without limits.
enum class Verdict : std::uint8_t { Good, Rework, Reject, Indeterminate, Unjudged };
inline constexpr std::size_t kVerdicts = 5;

/// `good`, `rework`, `reject`, `indeterminate`, `unjudged`.
std::string_view word(Verdict verdict);
std::optional<Verdict> verdict_from_word(std::string_view text);

/// Orders verdicts: reject is the worst, before rework, indeterminate and good; least is none.
constexpr int severity(std::optional<Verdict> verdict) {
  constexpr std::array<int, kVerdicts> kSeverity = {1, 3, 4, 2, 0};
  return verdict ? kSeverity.at(static_cast<std::size_t>(*verdict)) : 0;
}

/// Kind of a measured value. A deviation is of a surface from its nominal form.
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
  return enum_of<Quantity>(text, kQuantityWords);
}

/// Whether it is the size of a hole or a shaft.
constexpr bool has_feature(Quantity quantity) { return quantity <= Quantity::PitchDiameter; }
/// Whether it may be 0 or less.
constexpr bool is_signed(Quantity quantity) {
  return quantity == Quantity::Position || quantity == Quantity::Distance ||
         quantity == Quantity::Deviation;
}

/// Verdicts beyond the two limits: rework if material can still be removed.
struct Beyond {
  Verdict above = Verdict::Reject;
  Verdict below = Verdict::Reject;

  constexpr Beyond() = default;
  constexpr Beyond(iso286::Feature feature)  // NOLINT(google-explicit-constructor)
      : above(feature == iso286::Feature::Hole ? Verdict::Reject : Verdict::Rework),
        below(feature == iso286::Feature::Hole ? Verdict::Rework : Verdict::Reject) {}
  /// An outside edge that is broken too little can be broken further, as a hole can be widened; the
  /// radius of an inside corner can be made smaller.
  constexpr Beyond(Quantity quantity, iso286::Feature feature, bool is_inside_corner = false)
      : Beyond(has_feature(quantity) ? Beyond(feature)
               : is_signed(quantity) ? Beyond()
               : is_inside_corner    ? Beyond(iso286::Feature::Shaft)
                                     : Beyond(iso286::Feature::Hole)) {}
};

/// The factor k that widens a standard uncertainty (JCGM 100, 6.2), an exact decimal > 0 with up to
/// six digits after the point.
class CoverageFactor {
 public:
  /// k = 2.
  constexpr CoverageFactor() = default;

  /// @errors RuleInvalid.
  static Result<CoverageFactor> parse(std::string_view text, bool exponent = false);
  static Result<CoverageFactor> from_millionths(std::int64_t millionths);

  constexpr std::int64_t millionths() const { return millionths_; }

  friend constexpr auto operator<=>(CoverageFactor, CoverageFactor) = default;

 private:
  explicit constexpr CoverageFactor(std::int64_t millionths) : millionths_(millionths) {}

  std::int64_t millionths_ = 2'000'000;
};

/// `2`, `1.96`.
std::string format(CoverageFactor factor);

/// The probability of conformance a good part has at least, in millionths: 0.5 <= p < 1.
class ConformanceProbability {
 public:
  /// 95 % (ISO 14253-1:2017).
  constexpr ConformanceProbability() = default;

  /// @errors RuleInvalid.
  static Result<ConformanceProbability> from_millionths(std::int64_t millionths);

  constexpr std::int64_t millionths() const { return millionths_; }
  constexpr double value() const { return static_cast<double>(millionths_) / 1e6; }

  friend constexpr auto operator<=>(ConformanceProbability, ConformanceProbability) = default;

 private:
  explicit constexpr ConformanceProbability(std::int64_t millionths) : millionths_(millionths) {}

  std::int64_t millionths_ = 950'000;
};

/// `0.95`
std::string format(ConformanceProbability probability);

/// Rule for comparing a measured value with the limits (ISO 14253-1).
class DecisionRule {
 public:
  enum class Kind : std::uint8_t { Simple, GuardBand, Conformance };

  /// Judges by the limits themselves.
  constexpr DecisionRule() = default;

  /// Judges by limits moved inwards and outwards by g = k·u.
  /// @errors RuleInvalid when the uncertainty is negative.
  static Result<DecisionRule> guard_band(Length standard_uncertainty, CoverageFactor factor = {});

  /// Decides by the probability that the true value is within the limits (JCGM 106:2012, clause 7).
  /// @errors RuleInvalid unless the uncertainty is above 0.
  static Result<DecisionRule> conformance(const KnownUncertainty& uncertainty,
                                          ConformanceProbability probability = {});

  constexpr Kind kind() const { return kind_; }
  constexpr Length standard_uncertainty() const { return standard_uncertainty_; }
  constexpr CoverageFactor coverage_factor() const { return coverage_factor_; }
  constexpr ConformanceProbability probability() const { return probability_; }
  /// Returns the uncertainty of rule conformance. @pre Kind::Conformance
  KnownUncertainty uncertainty() const { return {standard_uncertainty_, degrees_of_freedom_}; }

  friend constexpr bool operator==(const DecisionRule&, const DecisionRule&) = default;

 private:
  Kind kind_ = Kind::Simple;
  Length standard_uncertainty_;
  CoverageFactor coverage_factor_;
  ConformanceProbability probability_;
  double degrees_of_freedom_ = kExactly;
};

/// `simple`, `guard_band` or `conformance`.
std::string_view word(DecisionRule::Kind kind);
std::optional<DecisionRule::Kind> rule_from_word(std::string_view text);

/// Whether a guard band on either side leaves no value that is good.
bool has_no_acceptance(const DecisionRule& rule, Length tolerance);

struct GaugingResult {
  Verdict verdict = Verdict::Good;
  /// measured - upper limit when above (positive), measured - lower limit when below (negative),
  /// 0 inside; the rule does not change it.
  Length excess;

  friend bool operator==(const GaugingResult&, const GaugingResult&) = default;
};

/// Judges a measured value. Limits are inclusive: a part exactly on a limit is good. With a guard
/// band g = k·u it is good from lower + g to upper - g inclusive, rework or reject beyond lower - g
/// or upper + g, and indeterminate between; all compared exactly. By conformance it is good where
/// the probability of conformance reaches the rule's, rework or reject where that of nonconformance
/// does, and indeterminate between.
/// @param beyond verdicts on the two sides, which a feature implies
/// @pre lower_limit <= upper_limit, and no length is beyond ±kLongest
GaugingResult gauge(const Beyond& beyond, Length upper_limit, Length lower_limit, Length measured,
                    const DecisionRule& rule = {});

}  // namespace fitgauge::gauging
