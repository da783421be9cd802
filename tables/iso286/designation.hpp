#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "tables/iso286/nominal_size.hpp"

namespace fitgauge::iso286 {

/// A nominal size with the name of a tolerance class: `25 H7`. The name is grammatical, but only
/// ToleranceTables::find_class knows whether there is such a class: shops name columns of their
/// own.
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
};

/// Reads `25H7/g6`, with or without blanks around the stroke, each part with or without Ⓔ.
/// @errors FitMalformed, also for two holes, two shafts or the shaft first; those of
///   parse_designation.
Result<FitDesignation> parse_fit_designation(std::string_view text);

/// Reads the two parts apart: `25H7` and `g6`. Errors as above.
Result<FitDesignation> parse_fit_designation(std::string_view hole, std::string_view shaft_class);

}  // namespace fitgauge::iso286
