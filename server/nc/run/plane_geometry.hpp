#pragma once

#include "nc/machine/axis.hpp"

/// Lines and arcs of the working plane, in mm and degrees; DR+ and positive angles turn
/// counter-clockwise.
namespace fitgauge::interpreter {

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

  static WorkingPlane across(machine::Axis tool_axis);
  /// The plane of two linear axes, in either order.
  static WorkingPlane spanned_by(std::size_t a, std::size_t b) {
    return across(static_cast<machine::Axis>(3 - a - b));
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
  std::optional<Vec2> start_direction() const;
  std::optional<Vec2> end_direction() const;
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

}  // namespace fitgauge::interpreter
