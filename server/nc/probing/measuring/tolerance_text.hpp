#pragma once

#include <optional>
#include <string_view>

#include "nc/probing/cycle_fault.hpp"
#include "nc/probing/measuring_record.hpp"

namespace fitgauge::probing {

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
