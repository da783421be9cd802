#pragma once

#include "nc/machine/axis.hpp"

namespace fitgauge::machine {

/// The part of a preset row that moves coordinates.
struct PresetFrame {
  Vec3 origin;              ///< Basic coordinates of the workpiece zero, in mm
  Vec3 basic_rotation_deg;  ///< SPA, SPB, SPC: spatial angles; SPC is the plain basic rotation
  Vec3 rotary_offsets_deg;  ///< A_OFFS, B_OFFS, C_OFFS: machine position that reads 0

  friend bool operator==(const PresetFrame&, const PresetFrame&) = default;
};

/// A tilted working plane (PLANE, cycle 19).
struct TiltedPlane {
  Vec3 spatial_deg;  ///< spatial angles A, B, C relative to the workpiece system
  Vec3 origin;       ///< its zero in the workpiece system, in mm: the datum shift before tilting

  friend bool operator==(const TiltedPlane&, const TiltedPlane&) = default;
};

/// Cycle 10: turns the working plane around the tool axis.
struct PlaneRotation {
  double angle_deg = 0;  ///< counter-clockwise seen against the tool axis
  Axis tool_axis = Axis::Z;

  friend bool operator==(const PlaneRotation&, const PlaneRotation&) = default;
};

/// Cycles 11 (all factors equal, centre 0) and 26.
struct Scaling {
  Vec3 factor{1, 1, 1};
  Vec3 centre;  ///< does not move; in input coordinates

  friend bool operator==(const Scaling&, const Scaling&) = default;
};

/// The chain of coordinate systems, from the machine inwards: table, preset (with basic rotation),
/// tilted plane, datum shift, mirror, rotation, scaling. Every setter recomposes the chain.
///
/// `table` carries the coordinates of a turned rotary table; the machine keeps it at the position
/// of its axes while a plane is tilted or TCPM is on, and at the identity otherwise, as the control
/// does. A value type; const functions may be called from several threads.
class Frames {
 public:
  Frames();

  void set_table(const Transform& table) { set(table_, table); }
  void set_preset(const PresetFrame& preset) { set(preset_, preset); }
  void set_plane(const std::optional<TiltedPlane>& plane) { set(plane_, plane); }
  /// Cycle 7, TRANS DATUM: mm and degrees.
  void set_datum_shift(const Position& shift) { set(shift_, shift); }
  /// Cycle 8: X, Y, Z change their sign.
  void set_mirror(const std::array<bool, 3>& mirrored) { set(mirror_, mirrored); }
  void set_rotation(const PlaneRotation& rotation) { set(rotation_, rotation); }
  /// @pre no factor is 0.
  void set_scaling(const Scaling& scaling) { set(scaling_, scaling); }
  /// Resets the frames of cycle 247: datum shift (also the shift before tilting), mirror, rotation,
  /// scaling.
  void reset_transformations();

  const PresetFrame& preset() const { return preset_; }
  const std::optional<TiltedPlane>& plane() const { return plane_; }
  const Position& datum_shift() const { return shift_; }
  const std::array<bool, 3>& mirror() const { return mirror_; }
  const PlaneRotation& rotation() const { return rotation_; }
  const Scaling& scaling() const { return scaling_; }

  /// All values are finite and no scaling factor is 0.
  bool is_valid() const;
  bool is_mirrored() const { return mirror_[0] || mirror_[1] || mirror_[2]; }
  bool is_scaled() const { return scaling_.factor != Vec3{1, 1, 1}; }
  bool is_rotated() const { return rotation_.angle_deg != 0; }
  bool is_tilted() const { return plane_.has_value(); }

  /// Converts points in mm. Machine and Reference have the same axes and zero, so both leave a
  /// point unchanged: MachineState decides which point of the tool is meant.
  Vec3 to_machine(const Vec3& point, CoordinateSystem system = CoordinateSystem::Input) const {
    return transform(system).point(point);
  }
  Vec3 from_machine(const Vec3& point, CoordinateSystem system = CoordinateSystem::Input) const {
    return transform(system).point_before(point);
  }

  /// Directions; active scaling changes their length.
  Vec3 direction_to_machine(const Vec3& direction,
                            CoordinateSystem system = CoordinateSystem::Input) const {
    return transform(system).direction(direction);
  }
  Vec3 direction_from_machine(const Vec3& direction,
                              CoordinateSystem system = CoordinateSystem::Input) const {
    return transform(system).direction_before(direction);
  }

  /// Converts input coordinates to Machine coordinates.
  const Transform& input() const { return input_; }

  /// Rotary positions A, B, C in degrees: offsets of the preset and the datum shift.
  Vec3 rotary_to_machine(const Vec3& rotary, CoordinateSystem system) const {
    return rotary + rotary_zero(system);
  }
  Vec3 rotary_from_machine(const Vec3& rotary, CoordinateSystem system) const {
    return rotary - rotary_zero(system);
  }

 private:
  template <class Part>
  void set(Part& part, const Part& value) {
    part = value;
    compose();
  }
  void compose();
  const Transform& transform(CoordinateSystem system) const;
  Vec3 rotary_zero(CoordinateSystem system) const;

  Transform table_;
  PresetFrame preset_;
  std::optional<TiltedPlane> plane_;
  Position shift_;
  std::array<bool, 3> mirror_{};
  PlaneRotation rotation_;
  Scaling scaling_;

  Transform machine_;    ///< the identity
  Transform workpiece_;  ///< workpiece system to machine
  Transform input_;      ///< input system to machine
};

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

  /// The unit vector from the tool tip to the spindle nose, in machine coordinates or on the table.
  Vec3 tool_direction(const Vec3& rotary, Axis tool_axis) const;
  Vec3 tool_on_table(const Vec3& rotary, Axis tool_axis) const {
    return table(rotary).inverse().direction(tool_direction(rotary, tool_axis));
  }

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
