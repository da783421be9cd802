#pragma once

#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing {

/// A place that a cycle touches around.
struct PlannedPlace {
  Side side = Side::Inside;
  Vec3 centre;                                    ///< in plane coordinates
  double diameter = 0;                            ///< Q262, if the cycle has it
  std::optional<std::array<double, 2>> length{};  ///< of what is not round; 0: not known
  std::string other_side{};                       ///< the remedy if the part has the other side
};

/// Adds to the error of a touch the bore, pocket or boss of the setup at the first place that has
/// another than the cycle expects, and the remedy: the cycle for it, or the diameter that is
/// written.
CycleFault with_part(CycleFault fault, const CycleContext& context, const WorkingPlane& plane,
                     std::span<const PlannedPlace> places);

/// Touches around a place as ProbingMotion::touch_all, with the clearance height Q260. @errors with
/// the part that is there.
CycleResult<std::vector<Contact>> touch_part(const CycleContext& context, ProbingMotion& motion,
                                             std::span<const Touch> touches,
                                             const PlannedPlace& place);

/// The place of a slot or ridge whose width lies along an axis of the plane.
PlannedPlace width_place(Side side, const Vec3& centre, std::size_t axis, double width);

}  // namespace fitgauge::probing
