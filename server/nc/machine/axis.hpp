#pragma once

#include "nc/machine/geometry.hpp"

namespace fitgauge::machine {

/// A bore, pocket, slot or boss of the part that a setup describes, in mm.
struct PartFeature {
  bool is_boss = false;
  double diameter = 0;             ///< 0: it is not round
  std::array<double, 2> length{};  ///< in X and Y of one that is not round; 0: open there
};

enum class Axis : std::uint8_t { X, Y, Z, A, B, C };

inline constexpr std::size_t kAxes = 6;
inline constexpr std::array kAllAxes{Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C};

constexpr std::size_t index(Axis axis) { return static_cast<std::size_t>(axis); }
constexpr bool is_rotary(Axis axis) { return index(axis) >= 3; }
/// "X" to "C".
constexpr std::string_view name(Axis axis) {
  return std::string_view("XYZABC").substr(index(axis), 1);
}
/// The unit vector of a linear axis, and for a rotary one the vector it turns around.
constexpr Vec3 unit_vector(Axis axis) {
  Vec3 vector;
  vector[index(axis) % 3] = 1;
  return vector;
}

/// Position of the six axes: X, Y, Z in mm and A, B, C in degrees.
struct Position {
  Vec3 linear;
  Vec3 rotary;

  double operator[](Axis axis) const {
    return is_rotary(axis) ? rotary[index(axis) - 3] : linear[index(axis)];
  }
  double& operator[](Axis axis) {
    return is_rotary(axis) ? rotary[index(axis) - 3] : linear[index(axis)];
  }
  friend bool operator==(const Position&, const Position&) = default;
};

/// Axis values of a positioning block, absolute; axes without a value do not move.
struct AxisWords {
  std::array<std::optional<double>, kAxes> values{};

  static AxisWords linear(const Vec3& p) {
    return {{p.x, p.y, p.z, std::nullopt, std::nullopt, std::nullopt}};
  }
  std::optional<double>& operator[](Axis axis) { return values[index(axis)]; }
  const std::optional<double>& operator[](Axis axis) const { return values[index(axis)]; }
};

/// Which zero and which directions coordinates refer to.
enum class CoordinateSystem : std::uint8_t {
  Input,      ///< the active one, which NC programs and cycles use: all of Frames; the tool tip
  Workpiece,  ///< tool tip, relative to the active preset with only its basic rotation
  Basic,      ///< tool tip, relative to the machine datum with the table at zero; for preset rows
  Machine,    ///< tool tip, as Basic unless a tilt turned the table
  Reference,  ///< the machine datum; the spindle nose: M91, REF, axis limits, FN 18 ID 240
};

/// Speed of a move, in mm/min of the tool tip; in degrees/min if only rotary axes move.
struct Feed {
  bool is_rapid = true;
  double rate = std::numeric_limits<double>::infinity();  ///< of a rapid: at most, if slower

  /// FMAX: the machine's rapid, or `at_most` (FMAX of tchprobe.tp) if that is slower.
  static Feed rapid(double at_most = std::numeric_limits<double>::infinity()) {
    return {true, at_most};
  }
  static Feed at(double mm_min) { return {false, mm_min}; }

  /// The rate on a machine whose rapid is `machine_rapid`.
  double rate_on(double machine_rapid) const {
    return is_rapid && machine_rapid < rate ? machine_rapid : rate;
  }
};

/// Path of the spindle nose during one move, for a parameter from 0 to 1.
struct Path {
  std::function<Position(double part)> nose;
  Position start;
  Position end;
  bool is_straight = true;  ///< the nose runs straight and no rotary axis moves
  double length = 0;        ///< of the tool tip's way, in mm
  double turn = 0;          ///< of the rotary axis that turns most, in degrees
  double nose_speed = 0;    ///< an upper bound of the nose's way per part, in mm
};

/// All axes from `start` to `end` together.
inline Path straight_path(const Position& start, const Position& end) {
  const Vec3 linear = end.linear - start.linear;
  const Vec3 rotary = end.rotary - start.rotary;
  Path path;
  path.nose = [start, linear, rotary](double part) {
    return Position{start.linear + linear * part, start.rotary + rotary * part};
  };
  path.start = start;
  path.end = end;
  path.is_straight = rotary == Vec3{};
  path.length = norm(linear);
  path.turn = std::max({std::abs(rotary.x), std::abs(rotary.y), std::abs(rotary.z)});
  path.nose_speed = path.length;
  return path;
}

}  // namespace fitgauge::machine
