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

}  // namespace fitgauge::machine
