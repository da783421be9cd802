#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/machine/machine.hpp"
#include "nc/run/motion_words.hpp"
#include "nc/run/nc_error.hpp"

/// Coordinate transformations, as cycles (7, 8, 10, 11, 26), TRANS and PLANE command them.
namespace fitgauge::interpreter {

class Channel;

using AxisCoordinates = std::array<std::optional<Coordinate>, machine::kAxes>;

/// Axes that are not named keep their shift.
NcResult<void> shift_datum(Channel& channel, const AxisCoordinates& axes);
/// A row of the datum table; blank cells keep their axis.
NcResult<void> shift_datum_to_row(Channel& channel, std::int64_t row);
NcResult<void> reset_datum_shift(Channel& channel);
/// Exactly the named axes are mirrored.
NcResult<void> mirror(Channel& channel, const std::array<bool, 3>& axes);
NcResult<void> rotate(Channel& channel, const Coordinate& angle);
/// @errors 1011 a factor that is not positive.
NcResult<void> scale(Channel& channel, const machine::Scaling& scaling);

/// Moves of PLANE that bring the rotary axes to a tilted plane.
struct PlaneMoves {
  klartext::PlanePositioning positioning = klartext::PlanePositioning::Stay;
  machine::Feed feed;
  bool turns_table = false;  ///< TABLE ROT: a free rotary axis turns; otherwise the coordinates
  std::optional<MCall> retraction{};  ///< MB: before the axes turn
  double distance = 0;  ///< DIST: from the tip along the tool to the point that keeps its place
  bool is_symmetric = false;  ///< SYM: the sign counts from the middle of the axis' range
  int sequence = 0;           ///< SEQ+ 1, SEQ- -1: the sign of the master axis; 0: the shortest way
};

/// Tilts the working plane by a rotation relative to the workpiece system and puts the rotary
/// positions that go with it into Q120 to Q122. The datum shift before it becomes the plane's
/// origin. @errors 1013 no rotary axes reach it.
NcResult<void> tilt(Channel& channel, const machine::Matrix3& rotation, const PlaneMoves& moves);
/// Moves all rotary axes to the position 0, by the word of PLANE.
NcResult<void> reset_tilt(Channel& channel, const PlaneMoves& moves);

// transformation_cycles.cpp
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
