#pragma once

#include "nc/machine/machine_state.hpp"

namespace fitgauge::machine {

/// The setup of a simulated run: machine, workpiece, seed. Plain values with the defaults of the
/// HTTP contract; `validate` checks them together.

/// An axis, and of a rotary one its kinematics as drawn and as really built.
struct AxisSetup {
  double min = -500;                   ///< min_mm, min_deg
  double max = 500;                    ///< max_mm, max_deg
  double hirth_grid_deg = 0;           ///< 0: any angle
  AxisMount mount = AxisMount::Table;  ///< on
  Vec3 centre{0, 0, -100};             ///< center_mm, of a table; a head turns about the nose
  Vec3 direction{0, 0, 1};    ///< any length; the tool turns around it relative to the workpiece
  Vec3 centre_error;          ///< center_error_mm: real centre minus modelled centre
  Vec3 tilt_error_deg;        ///< spatial angles by which the real direction differs
  double zero_error_deg = 0;  ///< its real angle at the indicated angle 0
  double backlash_deg = 0;    ///< lost motion when the direction of turning changes
  double scatter_um = 0;      ///< standard deviation of the position after a rotation, each way

  /// X, Y, Z: -500 to 500 mm. A, B: -120 to 120 degrees, C: -360 to 360, each around its machine
  /// axis.
  static AxisSetup of(Axis axis);

  /// Returns the rotary axis of the control's kinematic model; built() returns the real one.
  RotaryAxis modelled(Axis axis) const;
  RotaryAxis built(Axis axis) const;
};

/// A row of tool.t with the real tool, if it differs from the table.
struct ToolSetup {
  Tool row;
  std::optional<double> actual_length;  ///< actual_length_mm: nose to tip; default L + DL
  std::optional<double> actual_radius;  ///< actual_radius_mm: default R + DR
  std::optional<double> actual_xl{};    ///< actual_xl_mm, of a lathe tool: default XL + DXL
};

/// A row of tchprobe.tp together with the real probe.
struct ProbeSetup {
  ProbeRow row;
  double repeatability_um = 0;  ///< standard deviation of a contact along the probing direction
  double pretravel_um = 0;      ///< travel from touching to the trigger
  /// center_offset_mm: spindle axis to the real ball centre, main and secondary axis, with the
  /// spindle at 0 degrees.
  std::array<double, 2> centre_offset{};
};

/// The tool touch probe as the control's parameters have it, together with the real one.
struct ToolTouchProbeSetup {
  ToolTouchProbe known;                 ///< center_mm, radius_mm, shape
  std::optional<Vec3> actual_centre;    ///< actual_center_mm; default: as known
  std::optional<double> actual_radius;  ///< actual_radius_mm; default: as known
  double repeatability_um = 0;  ///< standard deviation of a contact along the probing direction
};

/// Material: an upright cylinder down from `top`.
struct Boss {
  std::array<double, 2> centre{};
  double top = 0;
  double height = 0;
  double diameter = 0;
};

/// A ring gauge: a cylinder with a hole through it.
struct CalibrationRing {
  std::array<double, 2> centre{};
  double top = 0;
  double height = 20;
  double diameter = 50;                  ///< of the hole
  std::optional<double> outer_diameter;  ///< default: 40 mm more

  double outside() const { return outer_diameter.value_or(diameter + 40); }
};

/// The calibration sphere on the table for cycles 451 to 453 and 460: the touch probe touches it
/// like the workpiece.
struct CalibrationSphere {
  Vec3 centre;           ///< center_mm, fixed to the table as a workpiece is
  double radius = 12.5;  ///< radius_mm
};

struct MachineSetup {
  /// X, Y and Z exist always, A, B and C when the setup names them.
  std::array<std::optional<AxisSetup>, kAxes> axes{AxisSetup::of(Axis::X), AxisSetup::of(Axis::Y),
                                                   AxisSetup::of(Axis::Z)};
  /// start_mm of the spindle nose: without a value 0, in Z (the tool axis) the upper end of the
  /// range.
  AxisWords start;
  double rapid_mm_min = 15000;
  std::vector<ToolSetup> tools{
      {{.number = 30, .name = "PROBE", .l = 120, .r = 2, .probe = 1}, {}, {}}};
  std::vector<ProbeSetup> probes{ProbeSetup{}};
  ToolTouchProbeSetup tt;
  KinematicsOptions kinematics_options;
  /// Calibration standards of the touch probe; fixed to the table.
  std::optional<CalibrationRing> calibration_ring;
  std::optional<Boss> calibration_stud;
  std::optional<CalibrationSphere> calibration_sphere;
  std::vector<Preset> presets{default_preset()};
  int active_preset = 1;

  /// Start position of the axes: Z at the top of its range, the others at 0.
  Position start_position() const;
  static Preset default_preset() { return {.number = 1, .comment = {}, .frame = {}}; }  ///< zero
};

/// Material from `min` to `max`.
struct Block {
  Vec3 min;
  Vec3 max;
};

/// Removes material: a hole of flat bottom that is open upwards.
/// At the angle t and the depth h its radius is diameter/2 + h taper/2 + a cos(n (t - phase)).
struct Bore {
  std::array<double, 2> centre{};  ///< of the opening
  double top = 0;
  double depth = 0;
  double diameter = 0;
  int lobes = 0;                 ///< n; 0 or amplitude 0 is a circle
  double lobe_amplitude_um = 0;  ///< a
  double lobe_phase_deg = 0;
  double taper_um_per_mm = 0;        ///< change of the diameter per mm of depth (ISO 3040)
  std::array<double, 2> tilt_deg{};  ///< around X, then around Y, at the centre of the opening
};

/// Material on one side of the plane.
struct Plane {
  Vec3 point;
  Vec3 normal{0, 0, 1};  ///< away from the material, any length
};

struct Sphere {
  Vec3 centre;
  double diameter = 0;
};

/// Material below measured points: linear between them (Delaunay triangles in X and Y), nothing
/// outside their hull.
struct Surface {
  std::vector<Vec3> points;
};

class TriangleTree;

/// Material inside a closed mesh of the control's disk.
struct Mesh {
  std::string file;         ///< TNC:\parts\flange.stl
  double unit = 1;          ///< of the file's figures, in mm
  Vec3 origin;              ///< origin_mm: position of the file's zero
  Vec3 spatial_angles_deg;  ///< how the file's axes are turned
  /// The body in mm, from the file's zero. Null until the file is read, before any machine.
  std::shared_ptr<const TriangleTree> body = nullptr;
};

using Feature = std::variant<Block, Bore, Boss, Plane, Sphere, Surface, Mesh>;

struct Setup {
  MachineSetup machine;
  std::vector<Feature> features;  ///< joined in order; coordinates fixed to the table
  std::uint64_t seed = 1;
  std::vector<Feature> fixtures{};  ///< clamps and vices: not gauged, but they collide
};

/// Calls `use(pointer, feature)` for every feature and fixture: "/workpiece/features/3".
void each_feature(auto& setup, const auto& use) {
  const auto each = [&use](std::string at, auto& features) {
    for (std::size_t k = 0; k < features.size(); ++k) use(at + std::to_string(k), features[k]);
  };
  each("/workpiece/features/", setup.features);
  each("/workpiece/fixtures/", setup.fixtures);
}

/// Everything that is wrong with a setup, as details with JSON pointers
/// (`/machine/axes/A/min_deg`, `/workpiece/features/3/diameter_mm`).
/// @errors SetupInvalid with one detail (FieldInvalid, FieldConflict) for each bad field.
Result<void> validate(const Setup& setup);

}  // namespace fitgauge::machine
