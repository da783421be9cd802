#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "base/length.hpp"

namespace fitgauge::gauging {

/// The limits of size a true value conforms to.
struct ConformanceLimits {
  Length upper;
  Length lower;
};

/// The degrees of freedom of an uncertainty that is known exactly.
inline constexpr double kExactly = std::numeric_limits<double>::infinity();

/// A standard uncertainty above 0, and how well it is known itself.
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

/// The probability that the true value lies within the limits, with nothing known of it before:
/// normal about the measured one (JCGM 106:2012, clause 7), Student's t with degrees of freedom.
double conformance_probability(const ConformanceLimits& limits, Length measured,
                               const KnownUncertainty& uncertainty);
/// The probability that it lies outside: 1 - the above, without losing its digits.
double nonconformance_probability(const ConformanceLimits& limits, Length measured,
                                  const KnownUncertainty& uncertainty);

/// How far inside both limits a value lies that conforms with just this probability, in standard
/// uncertainties: the coverage factor of a guard band that decides the same; none where not even
/// the middle of the limits conforms. @pre 0.5 <= probability < 1
std::optional<double> guard_band_factor(Length tolerance, const KnownUncertainty& uncertainty,
                                        double probability);

/// What is said of a value beside its verdict.
struct ConformanceFigures {
  std::int64_t probability = 0;  ///< of conformance, in 1e-9
  std::int64_t guard_band = 0;   ///< in fm, of which 15 digits count

  friend bool operator==(const ConformanceFigures&, const ConformanceFigures&) = default;
};

/// None where not even the middle of the limits conforms with the probability asked for.
/// @pre as of the functions above
std::optional<ConformanceFigures> conformance_figures(const ConformanceLimits& limits,
                                                      Length measured,
                                                      const KnownUncertainty& uncertainty,
                                                      double probability);

}  // namespace fitgauge::gauging
