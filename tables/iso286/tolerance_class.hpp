#pragma once

#include "base/length.hpp"

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
  static Result<NominalSize> parse_mm(std::string_view text, DecimalSyntax syntax = {});

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

/// The standard tolerance grades IT01 to IT18, finest first (ISO 286-1, 3.2.8.2).
enum class StandardToleranceGrade : std::uint8_t {  // clang-format off
  IT01, IT0, IT1, IT2, IT3, IT4, IT5, IT6, IT7, IT8, IT9, IT10, IT11, IT12, IT13, IT14, IT15, IT16,
  IT17, IT18 };  // clang-format on
inline constexpr std::size_t kGradeCount = 20;

/// The fundamental deviation identifiers in alphabetical order, upper case for holes and lower case
/// for shafts (ISO 286-1, 4.1.4).
enum class DeviationLetter : std::uint8_t {  // clang-format off
  A, B, C, CD, D, E, EF, F, FG, G, H, J, JS, K, M, N, P, R, S, T, U, V, X, Y, Z, ZA, ZB,
  ZC };  // clang-format on
inline constexpr std::size_t kLetterCount = 28;

/// Returns the number of a grade as written in a class: `7`, `01`.
std::string_view text(StandardToleranceGrade grade);

/// `H` for holes, `h` for shafts.
std::string_view text(DeviationLetter letter, Feature feature);

/// A tolerance class of the standard (ISO 286-1, 3.2.8.5): H7, js01.
struct ToleranceClass {
  Feature feature = Feature::Hole;
  DeviationLetter letter = DeviationLetter::H;
  StandardToleranceGrade grade = StandardToleranceGrade::IT7;

  friend constexpr auto operator<=>(const ToleranceClass&, const ToleranceClass&) = default;
};

std::string name(const ToleranceClass& tolerance_class);

/// Returns the standard class with this name, whether it is defined for any size or not; none for
/// `H19`, `I7`, `h7x` and the names of custom columns.
std::optional<ToleranceClass> class_from_name(std::string_view name);

/// Whether `name` may name a column: `[A-Za-z][A-Za-z0-9_]{0,15}`.
bool is_class_name(std::string_view name);

/// A name with an upper-case first letter belongs to holes.
/// @pre is_class_name(name)
Feature feature_of_name(std::string_view name);

/// A class as an index. Classes of the standard have the same id in every table; ids of custom
/// columns follow and belong to the ToleranceTables that gave them.
struct ClassId {
  std::uint16_t index = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): the zero is the compiler's
  friend constexpr auto operator<=>(ClassId, ClassId) = default;
};

/// Ids below are classes of the standard.
inline constexpr std::size_t kStandardClassCount = 2 * kLetterCount * kGradeCount;

constexpr ClassId class_id(const ToleranceClass& c) {
  const auto feature = static_cast<std::size_t>(c.feature);
  const auto letter = static_cast<std::size_t>(c.letter);
  const auto grade = static_cast<std::size_t>(c.grade);
  return {static_cast<std::uint16_t>((feature * kLetterCount + letter) * kGradeCount + grade)};
}

/// @pre id.index < kStandardClassCount
constexpr ToleranceClass standard_class(ClassId id) {
  const std::size_t letter = id.index / kGradeCount;
  return {static_cast<Feature>(letter / kLetterCount),
          static_cast<DeviationLetter>(letter % kLetterCount),
          static_cast<StandardToleranceGrade>(id.index % kGradeCount)};
}

/// A nominal size with the name of a tolerance class: `25 H7`. The name is grammatical, but only
/// ToleranceTables::find_class knows whether the class exists: shops name custom classes.
struct Designation {
  NominalSize nominal_size;
  std::string class_name;
  bool has_envelope = false;  ///< the modifier Ⓔ of ISO 14405-1
};

/// Reads `25H7`, `25 H7`, `Ø25H7`, `⌀25 h7`, `25,5g6`, `25H7(E)`, `25 H7 Ⓔ`. There are no
/// exponents: `25e8` is class e8.
/// @errors DesignationMalformed, LengthTooFine, SizeOutOfRange.
Result<Designation> parse_designation(std::string_view text);

/// A nominal size with the classes of a hole and a shaft: `25 H7/g6`.
struct FitDesignation {
  NominalSize nominal_size;
  std::string hole_class;
  std::string shaft_class;
  bool has_envelope = false;  ///< both have Ⓔ
};

/// Reads `25H7/g6`, with or without blanks around the stroke, each part with or without Ⓔ.
/// @errors FitMalformed, also for two holes, two shafts or the shaft first; those of
///   parse_designation.
Result<FitDesignation> parse_fit_designation(std::string_view text);

/// Reads the two parts apart: `25H7` and `g6`. Errors as above.
Result<FitDesignation> parse_fit_designation(std::string_view hole, std::string_view shaft_class);

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
constexpr std::string_view word(FitKind kind) {
  return word_of(kind, {"clearance", "transition", "interference"});
}

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
