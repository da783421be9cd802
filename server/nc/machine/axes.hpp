#pragma once

#include "base/allowance.hpp"
#include "nc/machine/axis.hpp"
#include "nc/machine/fault.hpp"

namespace fitgauge::machine {

/// The tool in the spindle, as the control's tables have it.
struct SpindleTool {
  int number = 0;  ///< 0: the spindle is empty
  bool is_probe = false;
  Axis axis = Axis::Z;  ///< it points along
  double length = 0;    ///< in mm, from the spindle nose to the tip
  double radius = 0;    ///< in mm
  double spindle_deg = 0;
  bool turns = false;
};

/// Settings of a move other than its way.
struct Motion {
  Feed feed;
  SpindleTool tool;
  /// A stop of this allowance ends the move. Must outlive the call.
  Allowance& allowance;
  /// Moves back along the last way of the probe, which is free.
  bool is_retract = false;
};

/// Abilities that axes lack; the control does without or refuses.
struct AxesCapabilities {
  bool curves = true;  ///< follows any path; otherwise it gets straight pieces within 0.5 µm
  bool probes = true;
};

/// The narrow interface below the control: linear and rotary axes that follow a path of the spindle
/// nose, in machine coordinates, and a probe input. Frames, tools, tables and cycles belong to the
/// control. A real driver is one such class. Lengths in mm, angles in degrees.
///
/// Each function returns at the end of its motion. After a fault the axes stop where they are, and
/// accept commands again. Not thread-safe; one Machine owns them.
///
/// Faults of every motion: Interrupted if its allowance was spent; and faults that only a machine
/// can report: EmergencyStop, FeedHold (longer than the driver waits), Aborted (by the operator),
/// ConnectionLost.
class Axes {
 public:
  Axes& operator=(Axes&&) = delete;  // neither copied nor moved
  virtual ~Axes() = default;

  virtual AxesCapabilities capabilities() const { return {}; }

  /// Returns the position of the axes.
  virtual Position nose() const = 0;

  /// Moves along the path, which begins at `nose()` and is in the ranges of the axes.
  /// @return the completed part: less than 1 if the probe touched something.
  virtual MachineResult<double> follow(const Path& path, const Motion& motion) = 0;

  /// Moves along the unit vector `direction` until the probe touches, at most `distance` mm.
  /// @return position of the nose at the contact; the axes may stop beyond it.
  /// @faults NoContact (at the end), StylusDeflected (nothing has moved).
  virtual MachineResult<Position> probe(const Vec3& direction, double distance,
                                        const Motion& motion) = 0;

  /// Normal of the surface at the last contact, if the axes know it.
  virtual std::optional<Vec3> contact_normal() const { return std::nullopt; }

  /// As Machine::part_features, of a point in machine coordinates.
  virtual std::vector<PartFeature> part_features(const Vec3&) const { return {}; }

  /// Returns whether a cutter has entered the part in the last motion, in rapid or not turning.
  virtual bool has_entered_part() const { return false; }

  /// Waits without motion.
  virtual MachineResult<void> dwell(double seconds, Allowance& allowance) = 0;

  /// A programmed stop: waits for NC Start.
  virtual void stop(std::string_view reason) = 0;
};

}  // namespace fitgauge::machine
