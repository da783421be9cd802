#pragma once

#include "nc/probing/touch/fits.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// A straight edge or face touched twice along one axis, in plane coordinates.
struct ProbedLine {
  Vec3 first;  ///< ball centres: the line through them is parallel to the edge
  Vec3 second;
  std::size_t axis = 0;    ///< the touched axis: 0 main, 1 secondary, 2 probe axis
  std::size_t across = 1;  ///< the axis along which the line runs

  /// Coordinate of each point along the axis it was touched in.
  struct Coordinate {
    double nominal = 0;
    double measured = 0;
  };
  std::array<Coordinate, 2> coordinates{};

  /// Returns the angle of the line to the main axis if the line is in the plane: -90 < angle <= 90
  /// for a line along the main axis and 0 < angle <= 180 for a line across it, so that neither
  /// jumps near its nominal value. For a line touched in the probe axis, returns its slope along
  /// `across`.
  double angle_deg() const;
  Vec3 direction() const { return second - first; }
};

/// Touches the line of the parameters Q263 to Q266, Q272, Q267, Q261, Q320, Q260, Q301.
/// @errors 1042 no direction, 1081 both points are the same.
CycleResult<ProbedLine> probe_line(const CycleContext& context, ProbingMotion& motion);

/// Q267. @errors 1042 it is 0.
CycleResult<int> probing_direction(const Arguments& arguments);

struct TouchedCoordinate {
  std::size_t axis = 0;  ///< 0 main, 1 secondary, 2 probe axis (Q272)
  Vec3 nominal;          ///< Q263, Q264, Q261
  Vec3 surface;          ///< in plane coordinates
};

/// One touch along an axis at Q263, Q264, Q261 in the direction Q267, as 419 and 427 make it.
/// @errors 1042 no direction.
CycleResult<TouchedCoordinate> touch_coordinate(const CycleContext& context, ProbingMotion& motion);

/// One touch at a point against the probe axis, as in 417 and for Q381.
CycleResult<Vec3> touch_down(const CycleContext& context, ProbingMotion& motion,
                             const Vec3& nominal);

struct Corner {
  Point2 point;    ///< intersection of the two edges
  Vec3 direction;  ///< of the first edge
};

/// The corner of two edges, each touched twice: the first two touches on the edge along the main
/// axis, the others on the edge along the secondary axis. Each edge is one ball radius from the
/// line through its ball centres, so that a turned part is compensated along its normals.
/// @errors 1081 the edges are parallel or their points coincide.
CycleResult<Corner> corner_of(std::span<const Contact> contacts, std::span<const Touch> touches,
                              double ball_radius);

/// Intersection of the lines a1-a2 and b1-b2. @errors 1081 they are parallel.
CycleResult<Point2> intersection(Point2 a1, Point2 a2, Point2 b1, Point2 b2);

}  // namespace fitgauge::probing
