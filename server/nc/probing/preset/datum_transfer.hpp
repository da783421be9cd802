#pragma once

#include <array>
#include <optional>
#include <span>

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// What a preset cycle has found: a point, and what it shall read in some axes of the plane
/// coordinates.
struct DatumPoint {
  Vec3 point{};  ///< in plane coordinates of the input system
  std::array<bool, 3> axes{};
  Vec3 datum{};  ///< the new coordinates of the point, of the named axes
};

/// What every preset cycle begins with, before any motion.
/// @errors 1078 Q303 = -1 with Q305 not 0: where to write is not defined; 1008 and 1007 with mirror
///   and scaling active; those of ProbingMotion::begin.
CycleResult<ProbingMotion> begin_preset(const CycleContext& context);

/// Writes the datum as Q303 and Q305 say. Q305 = 0: row 0 of the preset table becomes the active
/// preset with the new datum. Otherwise it is only stored: with Q303 = 1 in that row of the preset
/// table (a row that does not exist yet begins as the active one), with Q303 = 0 in that row of the
/// active datum table, relative to the active preset. Axes that are not named keep their value.
/// The zero moves along the axes of a tilted plane, so that the point reads the datum there
/// (decision 25). `turn_deg` is the angle of the part to the main axis: the basic rotation turns by
/// it around the probe axis; a datum table has none, so there the active preset turns at once.
/// @errors 1043 no datum table is active, 1085 the row is write-protected.
CycleResult<void> transfer_datum(const CycleContext& context, const WorkingPlane& plane,
                                 std::span<const DatumPoint> points,
                                 std::optional<double> turn_deg = std::nullopt);

}  // namespace fitgauge::probing
