#pragma once

#include "nc/machine/axis.hpp"

namespace fitgauge::machine {

enum class AxisMount : std::uint8_t { Table, Head };

/// A rotary axis as the control's kinematic model knows it.
/// A positive angle turns the tool right-handed around `direction` relative to the workpiece
/// (ISO 841): a head turns that way, a table the other way.
struct RotaryAxis {
  Axis axis = Axis::C;
  AxisMount mount = AxisMount::Table;
  Vec3 centre;  ///< a point of the axis in mm: of a table in machine coordinates, of a head from
                ///< the spindle nose
  Vec3 direction{0, 0, 1};  ///< unit vector
  double zero_deg = 0;      ///< its real angle at the indicated angle 0

  friend bool operator==(const RotaryAxis&, const RotaryAxis&) = default;
};

/// Position errors after the rotation of A, B and C, in mm.
using Displacements = std::array<Vec3, 3>;

/// The rotary axes and their order: a table is stacked A, B, C from the bed to the workpiece, a
/// head C, B, A from the column to the tool. A value type without interior state.
class Kinematics {
 public:
  Kinematics() = default;
  /// At most one axis of each letter; directions are normalised. @pre no direction is zero.
  explicit Kinematics(std::vector<RotaryAxis> axes, const Vec3& offset = {});

  const std::vector<RotaryAxis>& axes() const { return axes_; }
  /// Distance of the spindle nose from its indicated position, in mm: preset compensation (cycle
  /// 452) corrects it after a head was exchanged or the machine has drifted.
  const Vec3& offset() const { return offset_; }
  const RotaryAxis* find(Axis axis) const;

  /// Transforms table-fixed to machine coordinates, with the axes at `rotary` (degrees). The load
  /// of an axis is displaced along the directions of the axes that carry it.
  Transform table(const Vec3& rotary, const Displacements& rest = {}) const;

  /// Vector from the indicated position of the spindle nose to the point of the tool at `length`
  /// mm, in machine coordinates.
  Vec3 tool_vector(const Vec3& rotary, Axis tool_axis, double length,
                   const Displacements& rest = {}) const;

  /// The unit vector from the tool tip to the spindle nose, in machine coordinates.
  Vec3 tool_direction(const Vec3& rotary, Axis tool_axis) const;

  /// Returns rotary positions at which the tool is along `normal`, a unit vector fixed to the
  /// table: `current` if it is already, else by one axis, else by two; other axes keep their
  /// position. Turned angles are in -180 < angle <= 180; ranges are not checked. The nearest to
  /// `current` is first; none if the machine cannot reach it.
  std::vector<Vec3> orientations(const Vec3& normal, const Vec3& current, Axis tool_axis) const;

  friend bool operator==(const Kinematics&, const Kinematics&) = default;

 private:
  std::vector<RotaryAxis> axes_;  ///< table axes first, each group in its order
  Vec3 offset_;
};

}  // namespace fitgauge::machine
