#pragma once

#include <array>

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// A straight edge or face touched twice along one axis, in plane coordinates.
struct ProbedLine {
  Vec3 first;  ///< ball centres: the line through them is parallel to the edge
  Vec3 second;
  std::size_t axis = 0;    ///< 0 main, 1 secondary, 2 probe axis: the one touched along
  std::size_t across = 1;  ///< the axis along which the line runs

  /// Of each point along the axis it was touched in.
  struct Coordinate {
    double nominal = 0;
    double measured = 0;
  };
  std::array<Coordinate, 2> coordinates{};

  /// The angle of the line: to the main axis when it lies in the plane, in -90 < angle <= 90 for
  /// one along the main axis and in 0 < angle <= 180 for one across it, so that neither jumps near
  /// its nominal value; touched in the probe axis, its slope along `across`.
  double angle_deg() const;
  Vec3 direction() const { return second - first; }
};

/// Touches the line of the parameters Q263 to Q266, Q272, Q267, Q261, Q320, Q260, Q301.
/// @errors 1042 no direction, 1081 both points are the same.
CycleResult<ProbedLine> probe_line(const CycleContext& context, ProbingMotion& motion);

}  // namespace fitgauge::probing
