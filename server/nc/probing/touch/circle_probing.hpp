#pragma once

#include "nc/probing/touch/fits.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

enum class Side : std::uint8_t { Inside, Outside };

/// Plan for touching a circle in the plane and its coordinates; degrees from the main axis.
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

/// The circle through three holes around Q273 and Q274, by Q262, Q291 to Q293, Q261 and Q260.
CycleResult<ProbedCircle> probe_bolt_circle(const CycleContext& context, ProbingMotion& motion);

struct Rectangle {
  Point2 centre;
  std::array<double, 2> length{};  ///< along main and secondary axis
};

/// Touches the rectangle of that nominal centre and length (main, secondary axis) by Q261, Q320,
/// Q260 and Q301: along the axes of the plane, twice along each, through its nominal centre;
/// paraxially at measuring height or over the clearance height. A pocket too small for the start
/// distance is touched from its centre.
CycleResult<Rectangle> probe_rectangle(const CycleContext& context, ProbingMotion& motion,
                                       Side side, Point2 centre,
                                       const std::array<double, 2>& length);

/// The two touches along one axis (0 main, 1 secondary) of a slot, pocket, ridge or stud of the
/// nominal width around its centre, first the one at the higher coordinate.
std::array<Touch, 2> width_touches(Side side, const Vec3& centre, std::size_t axis, double width,
                                   double start_distance);

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
