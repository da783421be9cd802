#pragma once

#include "nc/machine/frames.hpp"

namespace fitgauge::machine {

enum class ContactPlate : std::uint8_t { Disc, Cube };

/// The tool touch probe TT as the control knows it: cycles 480 and 484 calibrate it.
struct ToolTouchProbe {
  Vec3 centre{300, 0, 50};  ///< of the upper side of its contact plate, machine coordinates, in mm
  double radius = 20;       ///< of the disc, or half the edge of the cube, in mm
  ContactPlate shape = ContactPlate::Disc;  ///< the edges of a cube are along X and Y

  friend bool operator==(const ToolTouchProbe&, const ToolTouchProbe&) = default;
};

/// Columns of toolturn.trn. Lengths run from the spindle nose to the theoretical tip, where the
/// tangents of the cutting edge meet, in mm: ZL along the tool, XL along X with the spindle at ORI.
struct LatheTool {
  double zl = 0;        ///< ZL
  double xl = 0;        ///< XL
  double dzl = 0;       ///< DZL
  double dxl = 0;       ///< DXL
  double rs = 0;        ///< RS: radius of the cutting edge
  int orientation = 1;  ///< TO
  double ori = 0;       ///< ORI: angle of the spindle, in degrees

  /// The way of the tip from the centre of RS, in RS, along X and along Z: -1, 0 or +1. TO runs
  /// around the edge: 1 is X- Z-, 2 X-, 3 X- Z+, 4 Z+, 5 X+ Z+, 6 X+, 7 X+ Z-, 8 Z-; 9 is the
  /// centre.
  int tip_x() const;
  int tip_z() const;
  /// How far the edge reaches below the tip, and beyond it in the direction -1 or +1 of X, in mm.
  double below_tip() const { return (1 + tip_z()) * rs; }
  double beyond_tip(int direction) const { return (direction - tip_x()) * rs; }

  friend bool operator==(const LatheTool&, const LatheTool&) = default;
};

/// A row of tool.t; lengths in mm. 0 in LTOL, RTOL, LBREAK and RBREAK switches that check off.
struct Tool {
  int number = 0;    ///< T
  std::string name;  ///< NAME, compared without regard to case
  double l = 0;      ///< L: from the spindle nose to the tip; of a probe to the ball's south pole
  double r = 0;      ///< R; of a probe the effective ball radius
  double r2 = 0;     ///< R2
  double dl = 0;     ///< DL
  double dr = 0;     ///< DR
  double dr2 = 0;    ///< DR2
  bool locked = false;        ///< TL = L
  int replacement = 0;        ///< RT, 0 is none
  double time1 = 0;           ///< TIME1, in minutes
  double time2 = 0;           ///< TIME2, in minutes
  double current_time = 0;    ///< CUR_TIME, in minutes
  double cutting_length = 0;  ///< LCUTS
  double plunge_angle = 0;    ///< ANGLE, in degrees
  int teeth = 0;              ///< CUT
  double l_tolerance = 0;     ///< LTOL
  double r_tolerance = 0;     ///< RTOL
  double r2_tolerance = 0;    ///< R2TOL
  bool clockwise = true;      ///< DIRECT: - is M3
  double r_offset = 0;        ///< R-OFFS
  double l_offset = 0;        ///< L-OFFS
  double l_breakage = 0;      ///< LBREAK
  double r_breakage = 0;      ///< RBREAK
  double max_rpm = 0;         ///< NMAX, 0 is no limit
  double point_angle = 0;     ///< T-ANGLE, in degrees
  double pitch = 0;           ///< PITCH
  int type = 0;               ///< TYP: number of the tool type as FN 18 ID 50 NR 36 gives it
  int probe = 0;              ///< TP_NO: row of tchprobe.tp; 0 is no touch probe

  /// Of a lathe tool, in place of L, R, DL and DR.
  std::optional<LatheTool> lathe{};

  bool is_probe() const { return probe != 0; }
  friend bool operator==(const Tool&, const Tool&) = default;
};

/// A column of tool.t with a number.
struct ToolColumn {
  int nr;  ///< of FN 17 and FN 18 ID50; 0: they do not have the column
  std::string_view name;
  double Tool::*number;  ///< null: `whole`
  bool is_length = false;
  int Tool::*whole = nullptr;
  int most = 0;  ///< of `whole`
};

/// Lengths first, whole numbers last.
std::span<const ToolColumn> tool_columns();
/// Null if no column has that NR.
const ToolColumn* tool_column(std::int64_t nr);

/// A table of the control by the numbers of its rows. Not thread-safe; a write replaces a whole
/// row.
template <class Row>
class NumberedTable {
 public:
  const Row* find(int number) const {
    const auto row = rows_.find(number);
    return row == rows_.end() ? nullptr : &row->second;
  }
  void write(const Row& row) { rows_.insert_or_assign(row.number, row); }
  const std::map<int, Row>& rows() const { return rows_; }

 private:
  std::map<int, Row> rows_;
};

/// tool.t.
class ToolTable : public NumberedTable<Tool> {
 public:
  using NumberedTable::find;
  /// The tool of the lowest number with that name.
  const Tool* find(std::string_view name) const;
};

/// The last row that preset.pr can have.
inline constexpr int kLastPreset = 9999;

/// A row of preset.pr.
struct Preset {
  int number = 0;       ///< NO; row 0 is the preset set by hand or by a cycle with Q305 = 0
  std::string comment;  ///< DOC
  PresetFrame frame;
  bool locked = false;  ///< LOCKED: write-protected

  friend bool operator==(const Preset&, const Preset&) = default;
};

/// preset.pr. Row 0 always exists.
class PresetTable : public NumberedTable<Preset> {
 public:
  PresetTable() { write(Preset{}); }
};

enum class PrePositioning : std::uint8_t { ProbeRapid, MachineRapid };
enum class CollisionReaction : std::uint8_t { NcStop, EmergencyStop };

/// A row of tchprobe.tp.
struct ProbeRow {
  int number = 1;        ///< NO
  std::string type;      ///< TYPE, such as TS460
  double cal_of1 = 0;    ///< CAL_OF1: ball centre minus spindle centre, main axis, in mm
  double cal_of2 = 0;    ///< CAL_OF2: misalignment in the secondary axis
  double cal_ang = 0;    ///< CAL_ANG: spindle angle of CAL_OF1 and CAL_OF2, in degrees
  double feed = 500;     ///< F: probing feed, in mm/min
  double rapid = 3000;   ///< FMAX: rapid for pre-positioning, in mm/min
  double distance = 20;  ///< DIST: longest probing travel, in mm
  double set_up = 2;     ///< SET_UP: clearance that Q320 adds to, in mm
  PrePositioning prepositioning = PrePositioning::ProbeRapid;  ///< F_PREPOS
  bool track = false;                                          ///< TRACK
  CollisionReaction reaction = CollisionReaction::NcStop;      ///< REACTION
  std::optional<double> uncertainty_um{};  ///< standard uncertainty of a touch; not in the table

  friend bool operator==(const ProbeRow&, const ProbeRow&) = default;
};

/// tchprobe.tp.
using ProbeTable = NumberedTable<ProbeRow>;

/// An offset along the main and the secondary axis, turned with the spindle, as a vector in machine
/// coordinates.
Vec3 turned_offset(const std::array<double, 2>& offset, Axis tool_axis, double spindle_deg);

/// The touch probe in the spindle as the control knows it, from both tables.
struct ProbeSystem {
  ProbeRow data;
  double length = 0;  ///< effective, spindle nose to the ball's south pole, in mm (L + DL)
  double radius = 0;  ///< effective ball radius, in mm (R + DR): FN 18 ID 350 NR 11

  /// CAL_OF1 and CAL_OF2 as a vector from the spindle axis to the ball centre, machine coordinates,
  /// with the spindle at an angle: main and secondary axis are X Y, Y Z or Z X for the tool axis Z,
  /// X or Y.
  Vec3 centre_offset(Axis tool_axis, double spindle_deg) const;
};

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
