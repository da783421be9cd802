#pragma once

#include "nc/klartext/word_names.hpp"
#include "nc/run/frame_commands.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// The axis words of a transformation with their values, in mm and degrees; other words are
/// ignored. Decision 3 applies: an undefined parameter is an error.
NcResult<AxisCoordinates> read_axis_words(Channel& channel, std::span<const klartext::Word> words);

/// X, Y and Z of a mirror. @errors for other axes.
NcResult<std::array<bool, 3>> mirrored_axes(std::span<const klartext::Word> words);

/// The cycles of CYCL DEF that are written in sub-lines and act when they are read: 7 datum shift,
/// 8 mirror, 9 dwell, 10 rotation, 11 scaling, 12 program call, 13 orientation, 19 working plane,
/// 26 scaling of each axis, 32 tolerance.
/// @param words of all sub-lines.
NcResult<void> execute_transformation(Channel& channel, int cycle,
                                      std::span<const klartext::Word> words);

}  // namespace fitgauge::interpreter
