#pragma once

#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// Sets Q151 to Q153 and records the diameter against Q262, without limits and verdict.
void publish_circle(const CycleContext& context, Side side, const ProbedCircle& probed);

/// The result of a preset cycle: a point, and its new coordinates in some axes of the plane.
struct DatumPoint {
  Vec3 point{};  ///< in plane coordinates of the input system
  std::array<bool, 3> axes{};
  Vec3 datum{};  ///< the new coordinates of the point, of the named axes
};

/// Checks the target of a datum, in the run and before it, when some values may be unknown.
/// @errors 1078 Q303 = -1 with Q305 not 0: the target is not defined.
CycleResult<void> check_transfer(const Arguments& arguments);

/// Begins every preset cycle, before any motion.
/// @errors those of check_transfer; 1008 and 1007 with mirror and scaling active; those of
///   ProbingMotion::begin.
CycleResult<ProbingMotion> begin_preset(const CycleContext& context);

struct MovedPoint {
  Vec3 nominal;
  Vec3 measured;
};
/// Corrects the active preset and its row: `turned` is the preset with the new basic rotation and
/// offsets; afterwards the measured point has the coordinates of the nominal one.
/// @errors 1085 the row is write-protected.
CycleResult<void> correct_preset(const CycleContext& context, const WorkingPlane& plane,
                                 machine::PresetFrame turned,
                                 const std::optional<MovedPoint>& moved);

namespace parameter {

/// The last parameters of the cycles that also can set the datum in the probe axis.
inline constexpr std::array kProbeAxisDatum =
    list(choice(381, "Touch in the probe axis too: 0 no, 1 yes", 0, 1, 0),
         coordinate(382, "Touch in the probe axis, main axis", 0),
         coordinate(383, "Touch in the probe axis, secondary axis", 0),
         coordinate(384, "Touch in the probe axis, probe axis", 0),
         coordinate(333, "New datum in the probe axis", 0));

/// Target of the datum and new coordinates of the found point, as in 410 to 416 and 418.
inline constexpr std::array kPlaneDatum =
    list(kTableRow, coordinate(331, "New datum in the main axis", 0),
         coordinate(332, "New datum in the secondary axis", 0), kTransfer, kProbeAxisDatum);

}  // namespace parameter

/// Sets the datum of the working plane to Q331, Q332 at a point; see finish_preset.
DatumPoint plane_datum(const Arguments& arguments, const Vec3& point);

/// The end of preset cycles: with Q381 = 1 a touch in the probe axis at Q382, Q383, Q384 for the
/// datum Q333, then the transfer of all by Q303 and Q305.
CycleResult<void> finish_preset(const CycleContext& context, ProbingMotion& motion,
                                const DatumPoint& found,
                                std::optional<double> basic_rotation = std::nullopt);

/// The use of the one point of 417 and 419: Q160, and Q333 as its new coordinate along an axis (0
/// main, 1 secondary, 2 probe axis).
CycleResult<void> set_datum_of_axis(const CycleContext& context, const WorkingPlane& plane,
                                    const Vec3& surface, std::size_t axis);

}  // namespace fitgauge::probing
