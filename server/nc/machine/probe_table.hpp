#pragma once

#include <array>
#include <map>
#include <string>

#include "nc/machine/axis.hpp"

namespace fitgauge::machine {

enum class PrePositioning : std::uint8_t { ProbeRapid, MachineRapid };
enum class CollisionReaction : std::uint8_t { NcStop, EmergencyStop };

/// A row of tchprobe.tp.
struct ProbeRow {
  int number = 1;        ///< NO
  std::string type;      ///< TYPE, such as TS460
  double cal_of1 = 0;    ///< CAL_OF1: ball centre minus spindle centre, main axis, in mm
  double cal_of2 = 0;    ///< CAL_OF2: the same in the secondary axis
  double cal_ang = 0;    ///< CAL_ANG: spindle angle that CAL_OF1 and CAL_OF2 hold at, in degrees
  double feed = 500;     ///< F: probing feed, in mm/min
  double rapid = 3000;   ///< FMAX: rapid for pre-positioning, in mm/min
  double distance = 20;  ///< DIST: longest probing travel, in mm
  double set_up = 2;     ///< SET_UP: clearance that Q320 adds to, in mm
  PrePositioning prepositioning = PrePositioning::ProbeRapid;  ///< F_PREPOS
  bool track = false;                                          ///< TRACK
  CollisionReaction reaction = CollisionReaction::NcStop;      ///< REACTION

  friend bool operator==(const ProbeRow&, const ProbeRow&) = default;
};

/// tchprobe.tp. Not thread-safe; a write replaces a whole row.
class ProbeTable {
 public:
  const ProbeRow* find(int number) const;
  void write(const ProbeRow& row);
  const std::map<int, ProbeRow>& rows() const { return rows_; }

 private:
  std::map<int, ProbeRow> rows_;
};

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
