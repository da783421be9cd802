#pragma once

#include "nc/machine/axis.hpp"
#include "nc/machine/frames.hpp"
#include "nc/machine/kinematics.hpp"
#include "nc/machine/tables.hpp"

namespace fitgauge::machine {

enum class SpindleState : std::int8_t {
  Undefined = -1,        ///< never switched
  Clockwise = 0,         ///< M3
  CounterClockwise = 1,  ///< M4
  StoppedAfterM3 = 2,    ///< M5
  StoppedAfterM4 = 3,    ///< M5
};

/// Modes that M functions and FUNCTION blocks switch.
struct Modes {
  SpindleState spindle = SpindleState::Undefined;
  double spindle_rpm = 0;
  bool turns() const {
    return spindle_rpm > 0 &&
           (spindle == SpindleState::Clockwise || spindle == SpindleState::CounterClockwise);
  }
  double spindle_deg = 0;  ///< angle of the oriented spindle, counter-clockwise seen from above
  bool coolant = false;    ///< M8
  double feed_mm_min = 0;  ///< the modal feed F, 0 when none is programmed
  bool tcpm = false;       ///< M128, FUNCTION TCPM: the tip follows the workpiece
  bool feed_at_circumference = false;  ///< M116: feeds of rotary axes in mm/min; FN 18 reads it
  bool kinematics_in_display = false;  ///< M144; FN 18 reads it

  friend bool operator==(const Modes&, const Modes&) = default;
};

/// The tool in the spindle; number 0 is an empty spindle.
struct ActiveTool {
  int number = 0;
  std::optional<Axis> axis;  ///< set by the first TOOL CALL
  double dl = 0;             ///< DL, DR, DR2 of the TOOL CALL block, in mm
  double dr = 0;
  double dr2 = 0;

  friend bool operator==(const ActiveTool&, const ActiveTool&) = default;
};

struct AxisRange {
  double min = -std::numeric_limits<double>::infinity();  ///< mm or degrees
  double max = std::numeric_limits<double>::infinity();
  double hirth_grid_deg = 0;  ///< of a rotary axis that stops on teeth only; 0 is none

  friend bool operator==(const AxisRange&, const AxisRange&) = default;
};

/// The machine builder's parameters of cycles 451 to 453.
struct KinematicsOptions {
  bool tcpm = true;  ///< M128 and FUNCTION TCPM are available
  /// mStrobeRotAxPos: A, B, C are positioned by an M function.
  std::array<bool, 3> strobed{};
  /// maxModification: a larger correction waits for NC Start; mm.
  std::optional<double> max_modification;
  double max_ball_deviation = 0.1;   ///< maxDevCalBall: of the sphere's radius, mm
  bool notes_insignificant = false;  ///< corrects also below twice the uncertainty, with a note

  friend bool operator==(const KinematicsOptions&, const KinematicsOptions&) = default;
};

/// All readable data of a machine. Positions, lengths and radii are those of the control's tables,
/// not of the simulated reality.
///
/// The position is always the tool **tip**: of a probe the south pole of its ball, so the ball
/// centre is one effective radius from the tip towards the spindle. A tool call does not move the
/// spindle nose; the tip moves by the difference of the lengths.
class MachineState {
 public:
  Frames frames;
  Kinematics kinematics;  ///< the control's model, which cycle 451 corrects
  ToolTable tools;
  ProbeTable probes;
  ToolTouchProbe tt;
  PresetTable presets;
  KinematicsOptions kinematics_options;
  std::array<std::optional<AxisRange>, kAxes> ranges;  ///< an axis without one does not exist
  int active_preset = 0;
  ActiveTool tool;
  Modes modes;
  Position nose;  ///< of the spindle nose, machine datum: the display of the axes
  double rapid_mm_min = 15000;
  double elapsed_s = 0;  ///< machining time since the run began

  /// The axis of the tool, Z while no TOOL CALL has defined one.
  Axis tool_axis() const { return tool.axis.value_or(Axis::Z); }
  /// The row of the tool in the spindle, or null.
  const Tool* active_tool() const { return tools.find(tool.number); }
  /// The row of the preset table; a new one begins as the active preset.
  Preset preset_row(int number) const {
    const Preset* row = presets.find(number);
    return row != nullptr ? *row
                          : Preset{.number = number, .comment = {}, .frame = frames.preset()};
  }
  /// L + DL (ZL + DZL of a lathe tool) + DL of the call, in mm; 0 with an empty spindle: Q114.
  double tool_length() const;
  /// R + DR + DR of the call, in mm: Q108.
  double tool_radius() const;
  /// The probe in the spindle, or nothing when the tool is not one.
  std::optional<ProbeSystem> probe_system() const;

  /// Unit vector from the tip to the spindle nose.
  Vec3 tool_direction(CoordinateSystem system = CoordinateSystem::Input) const;

  /// Position of the tool tip (of the nose in Reference).
  Position position(CoordinateSystem system = CoordinateSystem::Input) const;
  /// The centre of the probe's ball on the spindle axis, so without CAL_OF1 and CAL_OF2 (a
  /// ContactPoint has them); with another tool the point one radius above the tip.
  Vec3 ball_centre(CoordinateSystem system = CoordinateSystem::Input) const;
};

}  // namespace fitgauge::machine
