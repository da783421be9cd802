#pragma once

#include "nc/probing/cycles.hpp"
#include "nc/probing/touch/fits.hpp"

namespace fitgauge::probing {

using machine::Vec3;

/// A point in plane coordinates, by the parameters of these.
inline Vec3 place_of(const Arguments& arguments, int main, int secondary, int probe) {
  return {arguments.number(main), arguments.number(secondary), arguments.number(probe)};
}

/// The main and the secondary axis of the working plane and the probe axis across it. Cycles
/// compute in plane coordinates: x along the main axis, y along the secondary axis, z along the
/// probe axis.
struct WorkingPlane {
  machine::Axis main = machine::Axis::X;
  machine::Axis secondary = machine::Axis::Y;
  machine::Axis probe = machine::Axis::Z;

  /// Tool axis Z: XY, X: YZ, Y: ZX.
  static constexpr WorkingPlane across(machine::Axis tool_axis) {
    const auto next = [](machine::Axis axis) {
      return static_cast<machine::Axis>((index(axis) + 1) % 3);
    };
    return {next(tool_axis), next(next(tool_axis)), tool_axis};
  }

  constexpr machine::Vec3 from_input(const machine::Vec3& p) const {
    return {p[index(main)], p[index(secondary)], p[index(probe)]};
  }
  constexpr machine::Vec3 to_input(const machine::Vec3& p) const {
    machine::Vec3 input;
    input[index(main)] = p.x;
    input[index(secondary)] = p.y;
    input[index(probe)] = p.z;
    return input;
  }
};

/// Path of the probe from one touch to the start of the next.
enum class Transit : std::uint8_t {
  Straight,         ///< at measuring height, over the waypoints
  Arc,              ///< on the pitch circle, at measuring height
  ClearanceHeight,  ///< up to Q260, across, down
};

/// One touch, in plane coordinates of the ball centre.
struct Touch {
  Vec3 start;
  Vec3 direction;  ///< of probing, length 1
  Transit transit = Transit::Straight;
  std::vector<Vec3> waypoints{};  ///< of Transit::Straight, before the start
  Vec3 arc_centre{};              ///< of Transit::Arc
  double arc_sweep = 0;           ///< in degrees, positive counter-clockwise
};

/// The result of a touch, in plane coordinates.
struct Contact {
  Vec3 ball_centre;
  Vec3 surface;  ///< ball centre moved by the effective radius along the probing direction
};

/// The motion of probing cycles: positioning logic, touches with their data of tchprobe.tp (F,
/// FMAX, DIST, SET_UP) or cycle 441, retraction. Coordinates are those of the active input system,
/// in which a mm may be scaled (cycle 11); clearances of the probe table are real millimetres. Not
/// thread-safe; lives within one execution. After an error the machine stops where it is.
class ProbingMotion {
 public:
  /// @errors 1001 tool axis missing, 1092 no tool, 1093 no touch probe in the spindle.
  static CycleResult<ProbingMotion> begin(const CycleContext& context);

  const WorkingPlane& plane() const { return plane_; }
  /// The effective ball radius in the input system.
  double ball_radius() const { return probe_.radius / scale_; }
  std::optional<double> touch_uncertainty_um() const { return probe_.data.uncertainty_um; }
  /// Ball centre to nominal contact before a touch: radius + SET_UP + Q320, if the cycle has it.
  double start_distance() const {
    return (probe_.radius + probe_.data.set_up) / scale_ + context_.number_or(320, 0);
  }

  /// Touches in order, then retracts to the clearance height (of the tip, Q260). The first start is
  /// reached by the positioning logic: a tip below the clearance height goes up first.
  /// Without end, -infinity, the height has no effect. Every touch updates Q115 to Q119.
  /// @errors 1014 no contact within DIST, and the faults of the machine.
  CycleResult<std::vector<Contact>> touch_all(std::span<const Touch> touches,
                                              double clearance_height);

  /// Makes only the first touch: returns to its start and stops there.
  /// @errors those of touch_all.
  CycleResult<Contact> touch(const Touch& touch, double clearance_height);

  /// Moves the tip in the named input axes, all together.
  CycleResult<void> move_tip(const machine::AxisWords& target);
  /// Touches along a direction in plane coordinates, as touch_all does, and comes back.
  CycleResult<Contact> probe(const Vec3& direction);

 private:
  ProbingMotion(const CycleContext& context, const machine::ProbeSystem& probe);

  CycleResult<void> approach(const Touch& touch, double clearance_height);
  CycleResult<void> transit(const Touch& touch, double clearance_height);
  CycleResult<void> via_clearance_height(const Vec3& start, double clearance_height);
  CycleResult<void> arc(const Touch& touch);
  CycleResult<void> move_ball(const Vec3& centre);           ///< all three axes together
  CycleResult<void> move_ball_in_plane(const Vec3& centre);  ///< keeps the height
  CycleResult<void> move_tip_to_height(double height);
  machine::Feed positioning_feed() const;
  Vec3 tip() const;
  Vec3 ball_offset() const;  ///< tip to ball centre

  const CycleContext& context_;
  WorkingPlane plane_;
  machine::ProbeSystem probe_;
  double scale_;  ///< machine mm per input mm
};

/// @errors 1008 and 1007: preset and alignment cycles do not work mirrored or scaled.
CycleResult<void> refuse_mirror_and_scaling(const machine::Frames& frames);

/// Sets Q115 to Q119 and notifies the host, after every programmed touch.
void publish_touch(const machine::MachineState& state, CycleHost& host,
                   const machine::ContactPoint& contact);

enum class Side : std::uint8_t { Inside, Outside };
constexpr ValueRole size_role(Side side) {
  return side == Side::Inside ? ValueRole::HoleSize : ValueRole::ShaftSize;
}

/// Plan for touching a circle in the plane and its coordinates; degrees from the main axis.
struct CirclePlan {
  Side side = Side::Inside;
  Vec3 centre;  ///< at the height of the ball centre (Q261)
  double diameter = 0;
  double start_angle = 0;
  double step = 90;
  int points = 4;
  double start_distance = 0;   ///< ball centre to nominal contact
  bool via_clearance = false;  ///< Q301
  bool on_arc = true;          ///< Q365; a chord between the points would cut a stud
};

/// The touches in order. A hole too small for the start distance is touched from its centre,
/// without moves between the points.
std::vector<Touch> circle_touches(const CirclePlan& plan);

std::vector<Vec3> ball_centres(std::span<const Contact> contacts);

/// The circle through the ball centres, widened (inside) or narrowed (outside) by the ball's
/// radius: compensating each touch along its probing direction would be wrong for a hole off its
/// nominal centre (decision 20).
/// @errors 1081.
CycleResult<Circle> circle_through(std::span<const Contact> contacts, Side side,
                                   double ball_radius);

/// Returns the form by the points, and the certainty of the circle's diameter.
Form circle_form(std::span<const Vec3> points, const Circle& circle, double start_angle);

struct ProbedCircle {
  Circle circle;  ///< of the surface
  Form form;
};

/// Touches the circle of the parameters that 405, 412, 413, 421 and 422 have in common: Q262, Q325,
/// Q247, Q261, Q320, Q260, Q301, Q423, Q365.
/// @errors 1066, 1067 for a step angle of less than 5 degrees; 1081.
CycleResult<ProbedCircle> probe_circle(const CycleContext& context, ProbingMotion& motion,
                                       Side side, const Vec3& centre);

/// Returns the centres of holes near the given points, which are at measuring height. It touches
/// each hole four times from there, along the axes of the plane, and moves between holes at the
/// clearance height (Q260).
/// @errors 1014 a hole is wider than DIST reaches, 1081.
CycleResult<std::vector<Vec3>> probe_hole_centres(const CycleContext& context,
                                                  ProbingMotion& motion,
                                                  std::span<const Vec3> nominal);

/// The circle through three holes around Q273 and Q274, by Q262, Q291 to Q293, Q261 and Q260.
CycleResult<ProbedCircle> probe_bolt_circle(const CycleContext& context, ProbingMotion& motion);

struct Rectangle {
  Vec3 centre;
  std::array<double, 2> length{};  ///< along main and secondary axis
};

/// Touches the rectangle of that nominal centre and length (main, secondary axis) by Q261, Q320,
/// Q260 and Q301: along the axes of the plane, twice along each, through its nominal centre;
/// paraxially at measuring height or over the clearance height. A pocket too small for the start
/// distance is touched from its centre.
CycleResult<Rectangle> probe_rectangle(const CycleContext& context, ProbingMotion& motion,
                                       Side side, const Vec3& centre,
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
/// @errors 1081 both points are the same.
CycleResult<ProbedLine> probe_line(const CycleContext& context, ProbingMotion& motion);

struct TouchedCoordinate {
  std::size_t axis = 0;  ///< 0 main, 1 secondary, 2 probe axis (Q272)
  Vec3 nominal;          ///< Q263, Q264, Q261
  Vec3 surface;          ///< in plane coordinates
};

/// One touch along an axis at Q263, Q264, Q261 in the direction Q267, as 419 and 427 make it.
CycleResult<TouchedCoordinate> touch_coordinate(const CycleContext& context, ProbingMotion& motion);

/// One touch at a point against the probe axis, as in 417 and for Q381.
CycleResult<Vec3> touch_down(const CycleContext& context, ProbingMotion& motion,
                             const Vec3& nominal);

struct Corner {
  Vec3 point;      ///< intersection of the two edges
  Vec3 direction;  ///< of the first edge
};

/// The corner of two edges, each touched twice: the first two touches on the edge along the main
/// axis, the others on the edge along the secondary axis. Each edge is one ball radius from the
/// line through its ball centres, so that a turned part is compensated along its normals.
/// @errors 1081 the edges are parallel or their points coincide.
CycleResult<Corner> corner_of(std::span<const Contact> contacts, std::span<const Touch> touches,
                              double ball_radius);

/// Intersection of the lines a1-a2 and b1-b2 seen along z. @errors 1081 they are parallel.
CycleResult<Vec3> intersection(const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2);

}  // namespace fitgauge::probing
