#pragma once

#include "nc/probing/parameters.hpp"
#include "nc/probing/preset/datum_transfer.hpp"
#include "nc/probing/touch/circle_fit.hpp"

namespace fitgauge::probing {

namespace parameter {

/// The last parameters of the cycles that also can set the datum in the probe axis.
inline constexpr std::array kProbeAxisDatum{
    choice(381, "Touch in the probe axis too: 0 no, 1 yes", 0, 1, 0),
    coordinate(382, "Touch in the probe axis: main axis", 0),
    coordinate(383, "Touch in the probe axis: secondary axis", 0),
    coordinate(384, "Touch in the probe axis: probe axis", 0),
    coordinate(333, "New datum in the probe axis", 0)};

/// Where the datum goes and what the found point shall read, as in 410 to 416 and 418.
inline constexpr std::array kPlaneDatum =
    join(std::array{kTableRow, coordinate(331, "New datum in the main axis", 0),
                    coordinate(332, "New datum in the secondary axis", 0), kTransfer},
         kProbeAxisDatum);

}  // namespace parameter

/// Sets the datum of the working plane to Q331, Q332 at a point; see finish_preset.
DatumPoint plane_datum(const Arguments& arguments, Point2 point);

/// What preset cycles end with: with Q381 = 1 a touch in the probe axis at Q382, Q383, Q384 for the
/// datum Q333, then the transfer of all by Q303 and Q305.
CycleResult<void> finish_preset(const CycleContext& context, ProbingMotion& motion,
                                const DatumPoint& found,
                                std::optional<double> basic_rotation = std::nullopt);

/// What 417 and 419 do with their one point: Q160, and Q333 as its new coordinate along an axis (0
/// main, 1 secondary, 2 probe axis).
CycleResult<void> set_datum_of_axis(const CycleContext& context, const WorkingPlane& plane,
                                    const Vec3& surface, std::size_t axis);

}  // namespace fitgauge::probing
