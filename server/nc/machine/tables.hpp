#pragma once

#include "nc/machine/axis.hpp"
#include "nc/machine/frames.hpp"
#include "nc/machine/geometry.hpp"

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

}  // namespace fitgauge::machine
