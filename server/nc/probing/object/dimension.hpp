#pragma once

#include "nc/probing/cycle_fault.hpp"
#include "nc/probing/measuring_record.hpp"

namespace fitgauge::probing {

/// A nominal dimension of cycles 1400 to 1434.
struct Nominal {
  Length target;  ///< the middle of the tolerance: target of probing and comparison
  std::optional<Limits> limits{};  ///< nothing without a tolerance
};

/// Reads QS1100 to QS1117: a dimension, in the unit of the program, with its tolerance.
///
///     50            none
///     50+0.2-0.1    deviations; `50+0.2` and `50-0.1` have 0 as the other one; `50+-0.1`
///     10H7, 10m     a class of ISO 286; f, m, c or v of ISO 2768-1
///
/// @errors 1011 what cannot be read, or a class that the size does not have; 1097 `?` and `@`: the
///   operator gives the position.
CycleResult<Nominal> parse_nominal(std::string_view parameter, std::string_view text, bool inch);

/// Reads QS400, the tolerance of cycle 444: the permitted deviations along the surface normal.
///
///     0.4-0.1   upper limit +0.4, lower limit -0.1
///     0.4       upper limit +0.4, lower limit 0
///     -0.1      upper limit 0, lower limit -0.1
///     0.1+0.1   no tolerance, as an empty text, blanks alone and 0
///
/// Numbers are of the unit of the program, with decimal point or comma, without blanks; finer
/// digits are rounded to the nearest nanometre.
/// @errors 1011 naming the position, from 1, of the character that has no place there; also more
///   than 255 characters. 1004 a number beyond 99999.9999.
CycleResult<std::optional<Limits>> parse_tolerance(std::string_view text, bool inch);

}  // namespace fitgauge::probing
