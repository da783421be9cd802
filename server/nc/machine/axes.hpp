#pragma once

#include <optional>
#include <string_view>

#include "base/allowance.hpp"
#include "nc/machine/fault.hpp"
#include "nc/machine/path.hpp"

namespace fitgauge::machine {

/// The tool in the spindle, as the control's tables have it.
struct SpindleTool {
  int number = 0;  ///< 0: the spindle is empty
  bool is_probe = false;
  Axis axis = Axis::Z;  ///< it points along
  double length = 0;    ///< in mm, from the spindle nose to the tip
  double radius = 0;    ///< in mm
  double spindle_deg = 0;
};

/// Settings of a move other than its way.
struct Motion {
  Feed feed;
  SpindleTool tool;
  /// Looked at while the move lasts: its stop ends the move. Outlives the call.
  Allowance& allowance;
  /// Back along the way that the probe has just come: nothing stands there.
  bool is_retract = false;
};

/// Abilities that axes lack; the control does without or refuses.
struct AxesCapabilities {
  bool curves = true;  ///< follows any path; else it is given straight pieces within 0.5 µm
  bool probes = true;
};

/// The narrow waist below the control: linear and rotary axes that follow a path of the spindle
/// nose, in machine coordinates, and a probe input. Frames, tools, tables and cycles are the
/// control's. A real driver is one such class. Lengths in mm, angles in degrees.
///
/// Each function returns when its motion is over. After a fault the axes stand still, wherever that
/// is, and may be commanded again. Not thread-safe; one Control owns them.
///
/// Faults of every motion: Interrupted when its allowance was spent; and of what a machine alone
/// can say: EmergencyStop, FeedHold (it was held for longer than the driver waits), Aborted (by the
/// operator), ConnectionLost.
class Axes {
 public:
  Axes& operator=(Axes&&) = delete;  // neither copied nor moved
  virtual ~Axes() = default;

  virtual AxesCapabilities capabilities() const { return {}; }

  /// Where the axes stand now.
  virtual Position nose() const = 0;

  /// Goes along the path, which begins at `nose()` and lies in the ranges of the axes.
  /// @return the part of it that was gone: less than 1 when the probe touched something.
  virtual MachineResult<double> follow(const Path& path, const Motion& motion) = 0;

  /// Goes along the unit vector `direction` until the probe touches, at most `distance` mm.
  /// @return where the nose was at the contact; the axes may have come to rest beyond it.
  /// @faults NoContact (stands at the end), StylusDeflected (nothing has moved).
  virtual MachineResult<Position> probe(const Vec3& direction, double distance,
                                        const Motion& motion) = 0;

  /// The normal of what the last contact touched, where the axes can know it.
  virtual std::optional<Vec3> contact_normal() const { return std::nullopt; }

  /// Stands still.
  virtual MachineResult<void> dwell(double seconds, Allowance& allowance) = 0;

  /// A programmed stop: waits for NC Start.
  virtual void stop(std::string_view reason) = 0;

  /// Shows a text to the operator.
  virtual void message(std::string_view text) = 0;
};

}  // namespace fitgauge::machine
