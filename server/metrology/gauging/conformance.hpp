#pragma once

#include <cstdint>
#include <optional>

#include "base/length.hpp"

namespace fitgauge::gauging {

/// The limits of size a true value conforms to.
struct ConformanceLimits {
  Length upper;
  Length lower;
};

/// The probability that the true value lies within the limits: normal about the measured one, with
/// nothing known of it before (JCGM 106:2012, clause 7). @pre standard_uncertainty > 0
double conformance_probability(const ConformanceLimits& limits, Length measured,
                               Length standard_uncertainty);
/// The probability that it lies outside: 1 - the above, without losing its digits.
double nonconformance_probability(const ConformanceLimits& limits, Length measured,
                                  Length standard_uncertainty);

/// How far inside both limits a value lies that conforms with just this probability, in standard
/// uncertainties: the coverage factor of a guard band that decides the same; none where not even
/// the middle of the limits conforms. @pre standard_uncertainty > 0, 0.5 <= probability < 1
std::optional<double> guard_band_factor(Length tolerance, Length standard_uncertainty,
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
                                                      Length measured, Length standard_uncertainty,
                                                      double probability);

}  // namespace fitgauge::gauging
