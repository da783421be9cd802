#pragma once

#include "base/length.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::metrology {

/// Probabilities that a hole and a shaft interfere. Their sizes are independent and centred in
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

/// Returns every fit with clearances within the bounds: preferred ones first, then by the widest
/// range of clearance, which is the cheapest to make, then by name.
std::vector<FoundFit> find_fits(const iso286::ToleranceTables& tables, iso286::NominalSize size,
                                const ClearanceBounds& bounds);

/// Whether a fit is one of the preferred ones: `H7` and `g6`.
bool is_preferred(std::string_view hole, std::string_view shaft);

/// One side of a press fit, elastic. Lengths in mm, stresses in MPa.
struct PressedPart {
  double other_diameter_mm = 0;  ///< of the hub outside, of the shaft inside: 0 when it is solid
  double youngs_modulus_mpa = 210'000;
  double poisson_ratio = 0.3;
  double rz_um = 0;  ///< roughness, which pressing flattens
};

struct PressFit {
  double joint_diameter_mm = 0;
  double length_mm = 0;
  double friction = 0.12;
  PressedPart hub;
  PressedPart shaft;
};

/// The joint of an interference.
struct Pressure {
  double effective_um = 0;      ///< interference without the flattened part, 0.4 (Rz + Rz)
  double pressure_mpa = 0;      ///< in the joint
  double hub_stress_mpa = 0;    ///< equivalent stress (von Mises) in the bore of the hub
  double shaft_stress_mpa = 0;  ///< at the shaft; in its bore if it is hollow
  double axial_force_n = 0;     ///< that slips
  double torque_nm = 0;         ///< that slips
};

/// Computes Lamé's thick cylinders under plane stress (DIN 7190-1:2017 with its 0.4 Rz).
/// @param interference_um of the diameters, 0 or more
/// @errors FieldInvalid if the parts are not cylinders around each other.
Result<Pressure> press(const PressFit& fit, double interference_um);

struct Pair {
  std::size_t hole = 0;  ///< index in the request, from 0
  std::size_t shaft = 0;
  Length clearance;  ///< hole - shaft

  friend bool operator==(const Pair&, const Pair&) = default;
};

/// Pairs measured holes with measured shafts so that the sum of squares of clearance - target is
/// least. Every part of the smaller group gets a partner. Sorted by hole, ascending.
/// Squares are convex, so two sorted pairs are never worse than the crossed ones. A table of the
/// differences then finds the parts of the larger group that are left out.
/// @errors StatisticsTooFew without a hole or a shaft; FieldTooLong above kLargestPairing;
///   FiguresLimit where the thread's allowance is spent.
Result<std::vector<Pair>> pair(const std::vector<Length>& holes, const std::vector<Length>& shafts,
                               Length target);

/// Limit of the smaller count times (difference + 1): the cells of that table.
inline constexpr std::size_t kLargestPairing = 100'000'000;

}  // namespace fitgauge::metrology
