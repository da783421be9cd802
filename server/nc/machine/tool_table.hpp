#pragma once

#include <map>
#include <string>
#include <string_view>

namespace fitgauge::machine {

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

  bool is_probe() const { return probe != 0; }
  friend bool operator==(const Tool&, const Tool&) = default;
};

/// tool.t. Not thread-safe; a write replaces a whole row.
class ToolTable {
 public:
  const Tool* find(int number) const;
  /// The tool of the lowest number with that name.
  const Tool* find(std::string_view name) const;
  void write(const Tool& tool);
  const std::map<int, Tool>& rows() const { return rows_; }

 private:
  std::map<int, Tool> rows_;
};

}  // namespace fitgauge::machine
