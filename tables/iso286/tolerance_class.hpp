#pragma once

#include "base/result.hpp"
#include "tables/iso286/nominal_size.hpp"

namespace fitgauge::iso286 {

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

}  // namespace fitgauge::iso286
