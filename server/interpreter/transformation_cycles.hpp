#pragma once

#include <span>
#include <vector>

#include "interpreter/nc_error.hpp"
#include "klartext/word.hpp"

namespace fitgauge::interpreter {

class Channel;

/// The cycles of CYCL DEF that are written in sub-lines and act when they are read: 7 datum shift,
/// 8 mirror, 9 dwell, 10 rotation, 11 scaling, 12 program call, 13 orientation, 19 working plane,
/// 26 scaling of each axis, 32 tolerance.
/// @param words of all sub-lines.
NcResult<void> execute_transformation(Channel& channel, int cycle,
                                      std::span<const klartext::Word> words);

}  // namespace fitgauge::interpreter
