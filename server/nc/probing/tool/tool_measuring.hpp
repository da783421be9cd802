#pragma once

#include "nc/probing/cycles.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/fits.hpp"

namespace fitgauge::probing {

/// Machine parameters of the tool touch probe, which no program changes.
namespace tt_parameters {
inline constexpr double kSafetyDistance = 5;    ///< safetyDistStylus, mm: before every touch
inline constexpr double kDepth = 5;             ///< offsetToolAxis, mm: tool end below the top
inline constexpr double kLongestProbing = 50;   ///< mm: a tool farther away is not found
inline constexpr double kProbingFeed = 300;     ///< probingFeed, mm/min, with a stopped spindle
inline constexpr double kPeripheralSpeed = 40;  ///< maxPeriphSpeedMeas, m/min
inline constexpr double kMostRpm = 1000;        ///< maxSpeed
inline constexpr double kMeasuringTolerance = 0.01;  ///< measureTolerance1, mm a turn
}  // namespace tt_parameters

/// Q340 and Q199 of the cycles that measure a tool.
inline constexpr CycleParameter kToolMeasurement = parameter::choice(
    340, "Tool measurement: 0 first, 1 check, 2 check and write nothing", 0, 2, 1);
inline constexpr CycleOutput kToolStatus{199, "Tool: 0 within tolerance, 1 worn, 2 broken",
                                         Unit::None};
enum class ToolMode : std::uint8_t { First, Check, CheckOnly };
enum class ToolStatus : std::uint8_t { WithinTolerance, Worn, Broken };

/// A measured column of a tool's row, with the columns that judge it. 0 in the tolerance or the
/// breakage switches that check off; limits are inclusive.
struct Dimension {
  CycleOutput result;
  double& stored;
  double& delta;
  double tolerance;
  double breakage;
};

/// Writes a measured value into the row as Q340 requests, and its deviation into the result.
ToolStatus enter(const CycleContext& context, ToolMode mode, const Dimension& dimension,
                 double measured);
/// Writes Q199 and, unless Q340 forbids it, the row, which a status other than 0 locks.
CycleResult<void> write_measured(const CycleContext& context, ToolMode mode, machine::Tool tool,
                                 ToolStatus status);

/// Whether the spindle turns while the tool is touched.
enum class Spindle : std::uint8_t { Stands, Turns };

/// Moves the tool in the spindle to the tool touch probe and touches it, in machine coordinates of
/// the tool tip. The spindle axis is Z; of a point to be over or beside, X and Y count. Not
/// thread-safe; lives within one execution; after an error the machine stops where it is.
class ToolProbing {
 public:
  /// @param clearance_height Q260, in the input system; raised to stay clear of the contact plate.
  /// @errors 1001 tool axis missing, 1075 the tool is inclined or the coordinates are tilted, 1079
  ///   the tool axis is not Z, 1092 no tool, 1093 a touch probe or a lathe tool is in the spindle.
  static CycleResult<ToolProbing> begin(const CycleContext& context, double clearance_height);
  /// Begins with a lathe tool, and orients the spindle to its ORI.
  /// @errors of begin; 1093 when it is none, 1097 without a cuboid, 1109 when its tip points up.
  static CycleResult<ToolProbing> begin_lathe(const CycleContext& context, double clearance_height);
  /// Begins with the present height of the tip, at any distance from the plate.
  static CycleResult<ToolProbing> begin_here(const CycleContext& context);

  /// Touches the upper side with the tip over a point, and comes back. @return the tip's height.
  /// @errors 1014 nothing within the longest probing.
  CycleResult<double> touch_top(const Vec3& at, Spindle spindle);
  /// Touches a side from outside, coming over the clearance height, the tip at a height below the
  /// top. @param outwards a unit vector from the centre to the side. @return the distance of the
  /// tip from the centre, along it.
  CycleResult<double> touch_side(const Vec3& centre, double tip_height, const Vec3& outwards,
                                 Spindle spindle);
  /// Up to the clearance height.
  CycleResult<void> retract();
  CycleResult<void> move_over(const Vec3& at);

 private:
  ToolProbing(const CycleContext& context, double clearance_height, double start_height)
      : machine_(context.machine),
        clearance_height_(clearance_height),
        start_height_(start_height) {}

  CycleResult<void> move(const machine::AxisWords& target);
  CycleResult<void> move_to_height(double height);
  CycleResult<machine::Vec3> probe(const machine::Vec3& direction, Spindle spindle);

  machine::Machine& machine_;
  double clearance_height_;  ///< of the tip
  double start_height_;      ///< of the tip, before it touches the upper side
};

}  // namespace fitgauge::probing
