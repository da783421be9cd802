#pragma once

#include "nc/machine/fault.hpp"
#include "nc/machine/machine_state.hpp"

namespace fitgauge::machine {

/// A straight move of all named axes together; axes without a word keep their coordinate in
/// `system`. Rotary words need no linear ones: the linear axes stay, or follow with TCPM.
struct LinearMove {
  AxisWords target;
  Feed feed;
  CoordinateSystem system = CoordinateSystem::Input;
};

/// An arc or helix in the plane across `normal`, in input coordinates. The end is met exactly; the
/// radius and the height change evenly on the way.
struct ArcMove {
  Vec3 end;               ///< in mm
  Vec3 centre;            ///< in mm; its coordinate along `normal` does not matter
  double sweep_deg = 0;   ///< positive counter-clockwise seen from +`normal` (DR+); may exceed 360
  Axis normal = Axis::Z;  ///< X, Y or Z
  Feed feed;
};

/// A probing move from the current position until contact, then back.
struct ProbeMove {
  Vec3 direction;   ///< of the travel; any length but 0
  double distance;  ///< longest travel, in mm of the machine (DIST, ABST); positive
  double feed;      ///< in mm/min (F of tchprobe.tp)
  CoordinateSystem system = CoordinateSystem::Input;  ///< that `direction` is given in
  std::optional<double>
      retract;  ///< after contact, back by that many mm (MB), at most to the start; without: there
  Feed retract_feed;
};

/// Result of a contact. The control computes the points from its scales, the effective length and
/// radius and CAL_OF. They are input coordinates at the moment of contact unless named otherwise.
struct ContactPoint {
  Vec3 tip;            ///< the ball's south pole (a cutter's tip on the tool touch probe)
  Vec3 ball_centre;    ///< circles and spheres are fitted through these
  Vec3 surface;        ///< ball centre moved by the effective radius along the probing direction
  Vec3 tip_machine;    ///< `tip` in Machine coordinates
  Position nose;       ///< Reference: neither length nor radius compensated (Q115 to Q119)
  double seconds = 0;  ///< of the travel to the contact
};

/// TOOL CALL. Without a number only the named values change.
struct ToolCall {
  std::optional<int> number;  ///< 0 empties the spindle
  std::optional<Axis> axis;
  std::optional<double> spindle_rpm;
  double dl = 0;  ///< mm
  double dr = 0;
  double dr2 = 0;
};

/// The narrow interface between NC programs and a machine tool. Lengths in mm, angles in degrees,
/// feeds in mm/min, times in seconds; directions as ISO 841 (the tool moves, +Z away from the
/// workpiece). A command is executed completely or returns the fault; after a fault the machine
/// stops where it is and accepts commands again. Not thread-safe; one run owns a machine.
class Machine {
 public:
  Machine& operator=(Machine&&) = delete;  // neither copied nor moved
  virtual ~Machine() = default;

  /// All that can be read; the reference stays valid and follows every command.
  virtual const MachineState& state() const = 0;

  Position position(CoordinateSystem system = CoordinateSystem::Input) const {
    return state().position(system);
  }

  /// @faults AxisLimit and AxisMissing (nothing has moved), HirthGrid, FeedMissing, ValueInvalid;
  /// Collision (stops at the contact).
  virtual MachineResult<void> move(const LinearMove& move) = 0;

  /// @faults as move.
  virtual MachineResult<void> move_arc(const ArcMove& arc) = 0;

  /// Normal of the surface at the last contact, away from the material, in Machine coordinates;
  /// none if the machine does not know it, like a real one.
  virtual std::optional<Vec3> contact_normal() const { return std::nullopt; }

  /// The bores, pockets and bosses of the part that have a point in input coordinates near their
  /// axis; none if the machine does not know them, like a real one.
  virtual std::vector<PartFeature> part_features(const Vec3&) const { return {}; }

  /// Returns whether a cutter has entered the part in the last motion, which was in rapid; false if
  /// the machine does not know the part.
  virtual bool has_entered_part() const { return false; }

  /// Moves a touch probe towards the workpiece, or another tool towards the tool touch probe TT.
  /// @faults ToolAxisMissing, NoTool, FeedMissing, ValueInvalid (nothing has moved);
  /// StylusDeflected (touches at the start); NoContact (at the end of the travel); AxisLimit (at
  /// the limit, without contact); Collision (on the way back beyond the start).
  virtual MachineResult<ContactPoint> probe(const ProbeMove& move) = 0;

  /// Changes the tool in place: the nose does not move.
  /// @faults ToolUnknown, ToolLocked, ToolAxisMissing (no axis now or before).
  virtual MachineResult<void> call_tool(const ToolCall& call) = 0;

  /// Writes a row of tool.t, tchprobe.tp or preset.pr, new or replaced, or the data of the TT. A
  /// tool or probe in the spindle changes at once (the nose stays), the active preset with the next
  /// activation. @faults PresetLocked, ValueInvalid.
  virtual MachineResult<void> write_tool(const Tool& tool) = 0;
  virtual MachineResult<void> write_probe(const ProbeRow& row) = 0;
  virtual MachineResult<void> write_preset(const Preset& preset) = 0;
  virtual MachineResult<void> write_tool_touch_probe(const ToolTouchProbe& tt) = 0;

  /// Cycle 247: the row becomes active and datum shift, mirror, rotation and scaling are reset.
  /// @faults PresetUnknown.
  virtual MachineResult<void> activate_preset(int number) = 0;

  /// Replaces the chain of frames: datum shift, mirror, rotation, scaling, tilted plane, and what
  /// of the active preset a cycle overrides (its basic rotation). The table's part stays the
  /// machine's.
  /// @faults ValueInvalid (not finite, or a scaling factor of 0).
  virtual MachineResult<void> set_frames(const Frames& frames) = 0;

  /// Spindle, its orientation, coolant, feed, TCPM and operating mode. @faults ValueInvalid,
  ///   OptionMissing (TCPM).
  virtual MachineResult<void> set_modes(const Modes& modes) = 0;

  /// Replaces the control's kinematic model (cycles 450 to 452). @faults AxisMissing, ValueInvalid.
  virtual MachineResult<void> set_kinematics(const Kinematics& kinematics) = 0;

  /// Waits without motion. @faults ValueInvalid (negative).
  virtual MachineResult<void> dwell(double seconds) = 0;

  /// A programmed stop (STOP, M0, M1): the machine waits for NC Start.
  virtual void stop(std::string_view reason) = 0;

  /// Shows a text to the operator.
  virtual void message(std::string_view text) = 0;
};

}  // namespace fitgauge::machine
