#pragma once

#include "nc/machine/machine.hpp"
#include "nc/run/run_log.hpp"

namespace fitgauge::interpreter {

/// Lines and arcs of the working plane, in mm and degrees; DR+ and positive angles turn
/// counter-clockwise.
struct Vec2 {
  double x = 0;
  double y = 0;

  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(Vec2 a, double factor) { return {a.x * factor, a.y * factor}; }
};

inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::hypot(a.x, a.y); }
inline Vec2 left_of(Vec2 a) { return {-a.y, a.x}; }
Vec2 unit(Vec2 a);
Vec2 polar(double radius, double angle_deg);
Vec2 turned(Vec2 a, double angle_deg);

/// The two axes of the plane across the tool axis: XY for Z, ZX for Y, YZ for X.
struct WorkingPlane {
  std::size_t first = 0;
  std::size_t second = 1;
  machine::Axis normal = machine::Axis::Z;

  static WorkingPlane across(machine::Axis tool_axis) {
    return {(index(tool_axis) + 1) % 3, (index(tool_axis) + 2) % 3, tool_axis};
  }
  bool contains(std::size_t axis) const { return axis == first || axis == second; }
  friend bool operator==(const WorkingPlane&, const WorkingPlane&) = default;
  Vec2 project(const machine::Vec3& point) const { return {point[first], point[second]}; }
  machine::Vec3 with(machine::Vec3 point, Vec2 in_plane) const {
    point[first] = in_plane.x;
    point[second] = in_plane.y;
    return point;
  }
};

/// An arc by its centre and signed sweep, or a line.
struct Curve {
  Vec2 start;
  Vec2 end;
  std::optional<Vec2> centre{};  ///< nothing: a line
  double sweep_deg = 0;

  bool is_arc() const { return centre.has_value(); }
  bool is_left_turn() const { return sweep_deg > 0; }
  /// Unit vectors of travel; nothing for a line without length.
  std::optional<Vec2> start_direction() const { return direction_at(start); }
  std::optional<Vec2> end_direction() const { return direction_at(end); }
  std::optional<Vec2> direction_at(Vec2 point) const;
};

/// The sweep from `start` to `end` around `centre`: 0 < |sweep| <= 360; equal points are a full
/// circle.
double sweep(Vec2 start, Vec2 end, Vec2 centre, bool left_turn);

/// The full turns of a sweep beyond its first: 720 of 730, 0 of 360.
double whole_turns(double sweep_deg);

/// The curve offset to its left; negative: to its right. None if an arc vanishes.
std::optional<Curve> offset_curve(const Curve& curve, double distance);
/// Intersection of the two curves offset to the left, near their common point.
std::optional<Vec2> inner_corner(const Curve& before, const Curve& after, double distance);

/// CR: of radius |r|, at most 180 degrees for r > 0 and more for r < 0. Nothing when the points are
/// further apart than the diameter, or equal.
std::optional<Curve> arc_of_radius(Vec2 start, Vec2 end, double r, bool left_turn);

/// CT: begins at `start` along `direction`. A line if the end is straight ahead.
Curve tangential_arc(Vec2 start, Vec2 direction, Vec2 end);

/// RND: an arc tangential to both curves, none if it does not fit.
std::optional<Curve> rounding(const Curve& before, const Curve& after, double radius);
/// CHF: a line across the corner of two lines that removes `side` from each of them (decision 30);
/// none if it does not fit.
std::optional<Curve> chamfer(const Curve& before, const Curve& after, double side);

/// APPR LCT and, reversed, DEP LCT: a line from `from`, tangential to the circle around `centre`.
/// @returns the tangent point; none if `from` is inside.
std::optional<Vec2> tangent_point(Vec2 from, Vec2 centre, double radius, bool left_turn);

using machine::Axis, machine::AxisWords, machine::CoordinateSystem, machine::Feed, machine::Frames,
    machine::kAllAxes, machine::kAxes, machine::Machine, machine::MachineState, machine::Matrix3,
    machine::Modes, machine::Position, machine::RotaryAxis, machine::Tool, machine::Vec3;

/// One positioning block as geometry: its curve in a plane and the axes it names, absolute, in mm
/// and degrees.
struct Element {
  WorkingPlane plane;
  Curve curve;
  Vec3 from;  ///< end of the previous block
  AxisWords target;
  Feed feed;
  CoordinateSystem system = CoordinateSystem::Input;
  int side = 0;  ///< of the contour that the tool is on: 1 left (RL), -1 right (RR), 0 on it
  Vec3 shift{};  ///< of the tool from the programmed path (LN with DR), without RL and RR

  bool moves_in_plane() const {
    return curve.is_arc() || norm(curve.end - curve.start) > tolerance::kSamePoint;
  }
};

/// A radius of the tool as the working plane of the input system shows it: scaling (11, 26) does
/// not scale the tool.
inline double radius_in_plane(const MachineState& state, double radius) {
  const WorkingPlane plane = WorkingPlane::across(state.tool_axis());
  return radius / std::abs(state.frames.scaling().factor[plane.first]);
}

/// @errors 1108 in a plane whose axes are scaled differently (26), where arcs are ellipses.
NcResult<void> check_scaling(const MachineState& state, const WorkingPlane& plane,
                             std::string_view what);

/// The position with the axes that words name.
inline Position moved(Position position, const AxisWords& words) {
  for (const Axis axis : kAllAxes) {
    if (const auto& value = words[axis]) position[axis] = *value;
  }
  return position;
}

inline void set_plane_target(Element& element, Vec2 point) {
  element.target.values[element.plane.first] = point.x;
  element.target.values[element.plane.second] = point.y;
}

/// Moves the centre of the cutter along a contour: on it, or with RL and RR offset by the tool's
/// radius (R + DR) and an allowance. The path begins and ends square to the first and last point of
/// the contour, follows an arc around outer corners, and ends at the intersection of the offset
/// curves in inner corners. An element moves when the next one in the plane is known.
class CutterPath {
 public:
  CutterPath() = default;
  /// @param allowance remains on the contour, in mm in addition to the tool's radius
  explicit CutterPath(double allowance) : allowance_(allowance) {}

  /// @errors 1003 the tool does not fit into a corner or arc; 1021 RL or RR begins with an arc.
  NcResult<void> add(Machine& machine, const Element& next);
  /// Moves along postponed elements, up to the point square to their end.
  NcResult<void> finish(Machine& machine);
  /// The tool is at the offset start of the next element's contour (APPR).
  void begin(Vec2 centre, int side);
  /// The tool has left the contour (DEP).
  void leave() { *this = {}; }

  bool is_pending() const { return last_.has_value(); }
  int side() const { return side_; }

  /// Moves along an element without offset.
  static NcResult<void> move(Machine& machine, const Element& element);
  static double radius(const Machine& machine);

 private:
  NcResult<void> enter(Machine& machine, const Element& next);
  NcResult<void> join(Machine& machine, const Element& next);
  /// Moves along the postponed element, which ends at `end` for the centre of the tool, and along
  /// the blocks after it.
  NcResult<void> move_to(Machine& machine, Vec2 end);

  /// Returns the distance from the contour to the centre of the cutter.
  double reach(const Machine& machine) const { return radius(machine) + allowance_; }

  double allowance_ = 0;
  int side_ = 0;
  std::optional<Element> last_;
  bool is_entry_ = false;       ///< `last_` brings the tool to the contour
  Vec2 at_;                     ///< start of the tool's centre for `last_`
  std::optional<Vec2> begun_;   ///< there it begins the next element
  std::vector<Element> aside_;  ///< moves outside of the plane, between `last_` and the next one
};

/// The rotary axes at a part of a block's way, from 0 to 1, in machine coordinates.
struct VectorStop {
  double part;
  Vec3 rotary;
};

/// PATHCTRL VECTOR: the tool, seen from the workpiece, turns evenly in the plane of its first and
/// its last direction. Between two stops the rotary axes move evenly; there it leaves the plane by
/// less than a thousandth of a degree, except next to a position where an axis turns without
/// turning the tool. The last stop is `to`. @errors 1013 an axis does not reach a direction
/// between.
NcResult<std::vector<VectorStop>> vector_stops(const MachineState& state, const Vec3& from,
                                               const Vec3& to, RunBudget& budget);

}  // namespace fitgauge::interpreter
