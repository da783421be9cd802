#pragma once

#include "base/length.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::gauging {

/// The nearest whole number that a double keeps in its decimal digits: a record spells it as
/// RFC 8785 does. @pre |value| < 9e18
inline std::int64_t to_15_digits(double value) {
  constexpr std::int64_t kLimit = 1'000'000'000'000'000;
  const std::int64_t whole = std::llround(value);
  std::int64_t step = 1;
  while (whole / step >= kLimit) step *= 10;
  return (whole + step / 2) / step * step;
}

/// The limits of a value, which both belong to the good ones.
struct Limits {
  Length upper;
  Length lower;

  friend bool operator==(const Limits&, const Limits&) = default;
};

/// The degrees of freedom of an uncertainty that is known exactly.
inline constexpr double kExactly = std::numeric_limits<double>::infinity();

/// A standard uncertainty above 0 with its degrees of freedom.
struct KnownUncertainty {
  Length u;
  double degrees_of_freedom = kExactly;

  // NOLINTNEXTLINE(google-explicit-constructor): a length is one that is known exactly
  KnownUncertainty(Length u_, double degrees_of_freedom_ = kExactly)
      : u(u_), degrees_of_freedom(degrees_of_freedom_) {}
};

/// The factor k whose interval covers 95.45 %: the quantile t(0.9545, ν), in millionths (JCGM
/// 100:2008, G.6.4); at most a million. @pre degrees_of_freedom > 0, finite
std::int64_t coverage_millionths(double degrees_of_freedom);

/// Returns the probability that the true value is within the limits, without prior knowledge:
/// normal around the measured value (JCGM 106:2012, clause 7), Student's t with degrees of freedom.
double conformance_probability(const Limits& limits, Length measured,
                               const KnownUncertainty& uncertainty);
/// Returns the probability that it is outside: 1 - conformance_probability, with all its digits.
double nonconformance_probability(const Limits& limits, Length measured,
                                  const KnownUncertainty& uncertainty);

/// Returns the distance inside both limits, in standard uncertainties, at which a value conforms
/// with exactly this probability: the coverage factor of an equivalent guard band. None if not even
/// the middle of the limits conforms. @pre 0.5 <= probability < 1
std::optional<double> guard_band_factor(Length tolerance, const KnownUncertainty& uncertainty,
                                        double probability);

/// Facts of a value other than its verdict.
struct ConformanceFigures {
  std::int64_t probability = 0;  ///< of conformance, in 1e-9
  std::int64_t guard_band = 0;   ///< in fm, of which 15 digits count

  friend bool operator==(const ConformanceFigures&, const ConformanceFigures&) = default;
};

/// Returns the figures; none if not even the middle of the limits conforms with this probability.
/// @pre as conformance_probability
std::optional<ConformanceFigures> conformance_figures(const Limits& limits, Length measured,
                                                      const KnownUncertainty& uncertainty,
                                                      double probability);

// Sizes refer to 20 °C (ISO 1:2022); a part and its scale mostly have another temperature.

/// Temperature of a body in millionths of a degree Celsius, and its coefficient of linear expansion
/// in millionths of µm/(m·K).
struct ThermalBody {
  std::int64_t temperature = 20'000'000;
  std::int64_t expansion = 0;
  // Standard uncertainties of temperature and expansion, in their units:
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

/// Returns the standard uncertainty in pm that temperatures and expansions add to a size at 20 °C:
/// of first order, for independent quantities (JCGM 100:2008, 5.1.2). The sensitivity to a
/// temperature is L α / (1 + α(t - 20)), to an expansion L (t - 20) / (1 + α(t - 20)).
/// @param corrected as of size_at_20_degrees
std::int64_t added_uncertainty(Length corrected, const ThermalBody& part, const ThermalBody& scale);

/// √(u² + added²), rounded up to the nanometre. @param added_pm in pm
Length combined_uncertainty(Length u, std::int64_t added_pm);

/// Standard uncertainty in µm as in measurements, rounded up to the nanometre. None if it is not a
/// length.
std::optional<Length> rounded_up(double micrometres);

/// A material by name, with its mean coefficient near 20 °C and the source.
struct Material {
  std::string_view name;
  std::int64_t expansion;  ///< as ThermalBody has it
  std::string_view source;
  std::int64_t uncertainty = 0;  ///< standard uncertainty of the coefficient; 0: unknown
};
std::span<const Material> materials();
/// Null for a name there is no material of.
const Material* find_material(std::string_view name);

/// The verdict on a part. Rework: a hole too small or a shaft too large, more can be cut. Reject:
/// a hole too large or a shaft too small. Indeterminate: too near a limit for the uncertainty.
/// Unjudged: a value without limits.
enum class Verdict : std::uint8_t { Good, Rework, Reject, Indeterminate, Unjudged };
inline constexpr std::size_t kVerdicts = 5;

inline constexpr std::string_view kVerdictWords[kVerdicts] = {"good", "rework", "reject",
                                                              "indeterminate", "unjudged"};
constexpr std::string_view word(Verdict verdict) { return word_of(verdict, kVerdictWords); }
constexpr std::optional<Verdict> verdict_from_word(std::string_view text) {
  return enum_of<Verdict>(text, kVerdictWords);
}

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

/// An exact decimal with up to six digits after the point, within the bounds of its kind.
template <class Kind>
class Millionths {
 public:
  /// The usual value.
  constexpr Millionths() = default;

  /// @errors RuleInvalid.
  static Result<Millionths> from_millionths(std::int64_t millionths) {
    if (millionths >= Kind::kLeast && millionths <= Kind::kMost) return Millionths(millionths);
    return Error{ErrorCode::RuleInvalid, std::string(Kind::kRefusal)};
  }

  constexpr std::int64_t millionths() const { return millionths_; }
  constexpr double value() const { return static_cast<double>(millionths_) / 1e6; }

  friend constexpr auto operator<=>(Millionths, Millionths) = default;
  /// `2`, `1.96`.
  friend std::string format(Millionths decimal) { return format_decimal(decimal.millionths_, 6); }

 private:
  explicit constexpr Millionths(std::int64_t millionths) : millionths_(millionths) {}

  std::int64_t millionths_ = Kind::kUsual;
};

struct CoverageFactorKind {
  static constexpr std::int64_t kUsual = 2'000'000;
  static constexpr std::int64_t kLeast = 1;
  static constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  static constexpr std::string_view kRefusal = "the coverage factor must be above 0; 2 is usual";
};
/// The factor k > 0 that widens a standard uncertainty (JCGM 100, 6.2).
using CoverageFactor = Millionths<CoverageFactorKind>;

struct ConformanceProbabilityKind {
  static constexpr std::int64_t kUsual = 950'000;  ///< ISO 14253-1:2017
  static constexpr std::int64_t kLeast = 500'000;
  static constexpr std::int64_t kMost = 999'999;
  static constexpr std::string_view kRefusal =
      "the probability of conformance must be at least 0.5 and below 1; 0.95 is usual";
};
/// The probability of conformance a good part has at least: 0.5 <= p < 1.
using ConformanceProbability = Millionths<ConformanceProbabilityKind>;

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

inline constexpr std::string_view kRuleWords[] = {"simple", "guard_band", "conformance"};
constexpr std::string_view word(DecisionRule::Kind kind) { return word_of(kind, kRuleWords); }
constexpr std::optional<DecisionRule::Kind> rule_from_word(std::string_view text) {
  return enum_of<DecisionRule::Kind>(text, kRuleWords);
}

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
