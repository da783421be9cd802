#pragma once

#include "nc/probing/measuring_record.hpp"
#include "nc/probing/touch/fits.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

enum class Side : std::uint8_t { Inside, Outside };

/// Plan for touching a circle in the working plane; angles in degrees from the main axis, lengths
/// in plane coordinates.
struct CirclePlan {
  Side side = Side::Inside;
  Point2 centre;
  double diameter = 0;
  double start_angle = 0;
  double step = 90;
  int points = 4;
  double height = 0;           ///< of the ball centre (Q261)
  double start_distance = 0;   ///< ball centre to nominal contact
  bool via_clearance = false;  ///< Q301
  bool on_arc = true;          ///< Q365; a chord between the points would cut a stud
};

/// The touches in order. A hole too small for the start distance is touched from its centre,
/// without moves between the points.
std::vector<Touch> circle_touches(const CirclePlan& plan);

std::vector<Point2> ball_centres(std::span<const Contact> contacts);
std::vector<Vec3> centres_in_space(std::span<const Contact> contacts);

/// The circle through the ball centres, widened (inside) or narrowed (outside) by the ball's
/// radius: compensating each touch along its probing direction would be wrong for a hole off its
/// nominal centre (decision 20).
/// @errors 1081.
CycleResult<Circle> circle_through(std::span<const Contact> contacts, Side side,
                                   double ball_radius);

/// Returns the form by the points, and the certainty of the circle's diameter.
Form circle_form(std::span<const Point2> points, const Circle& circle, double start_angle);

struct ProbedCircle {
  Circle circle;  ///< of the surface
  Form form;
};

/// Touches the circle of the parameters that 405, 412, 413, 421 and 422 have in common: Q262, Q325,
/// Q247, Q261, Q320, Q260, Q301, Q423, Q365.
/// @errors 1066, 1067 for a step angle of less than 5 degrees; 1081.
CycleResult<ProbedCircle> probe_circle(const CycleContext& context, ProbingMotion& motion,
                                       Side side, Point2 centre);

/// Returns the centres of holes near the given points. It touches each hole four times from there,
/// along the axes of the plane at measuring height (Q261), and moves between holes at the clearance
/// height (Q260).
/// @errors 1014 a hole is wider than DIST reaches, 1081.
CycleResult<std::vector<Point2>> probe_hole_centres(const CycleContext& context,
                                                    ProbingMotion& motion,
                                                    std::span<const Point2> nominal);

/// The circle through three holes around Q273 and Q274, of the parameters Q262, Q291, Q292, Q293,
/// Q261, Q260.
CycleResult<ProbedCircle> probe_bolt_circle(const CycleContext& context, ProbingMotion& motion);

}  // namespace fitgauge::probing
