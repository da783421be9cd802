#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::metrology {

/// How likely a hole and a shaft of a fit interfere, their sizes independent and in the middle of
/// their tolerances.
struct FitProbabilities {
  double normal = 0;   ///< standard deviations of a sixth of the tolerance
  double uniform = 0;  ///< every size inside the limits equally likely
};
FitProbabilities probability_of_interference(const iso286::Fit& fit);

/// Sizes as they were measured, in mm.
struct MeasuredSizes {
  long double mean = 0;
  long double standard_deviation = 0;  ///< overall, n - 1
};

/// The clearance of measured holes and shafts that meet by chance: the difference of two
/// independent normal sizes.
struct MeasuredClearance {
  long double mean = 0;
  long double standard_deviation = 0;
  double probability_of_interference = 0;
};
/// @pre one of them has spread
MeasuredClearance clearance_of(const MeasuredSizes& holes, const MeasuredSizes& shafts);

/// Bounds of clearance; interference is negative.
struct ClearanceBounds {
  Length least;
  Length most;
};

struct FoundFit {
  iso286::ClassId hole;
  iso286::ClassId shaft;
  bool preferred = false;  ///< by ISO 286-1:2010, figures B.2 (hole basis) and B.3 (shaft basis)
  Length least;            ///< clearance
  Length most;
};

/// Every fit whose clearances lie within the bounds: the preferred ones first, then those with the
/// widest range of clearance, which cost the least to make; by name where they are equal.
std::vector<FoundFit> find_fits(const iso286::ToleranceTables& tables, iso286::NominalSize size,
                                const ClearanceBounds& bounds);

/// Whether a fit is one of the preferred ones: `H7` and `g6`.
bool is_preferred(std::string_view hole, std::string_view shaft);

}  // namespace fitgauge::metrology
