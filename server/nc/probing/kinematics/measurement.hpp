#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "nc/probing/kinematics/positions.hpp"
#include "nc/probing/kinematics/probing.hpp"

namespace fitgauge::probing {

/// What was measured of one rotary axis.
struct AxisMeasurement {
  AxisPlan plan;
  PoseGroup poses;  ///< the reference at 0 first, then the positions
  AxisErrors errors;
  Spread before;      ///< by the kinematics that were active
  Spread after;       ///< by the corrected kinematics: what the next measurement finds
  double radius = 0;  ///< of the measuring circle, in mm
  double positioning_error_deg = 0;  ///< mean, by the corrected kinematics
  std::optional<double> backlash_deg{};
  std::string_view no_backlash{};  ///< why there is none
};

struct KinematicsMeasurement {
  std::vector<AxisMeasurement> axes;  ///< those measured, in the order A, B, C
  machine::Kinematics corrected;      ///< the active kinematics with what was found
  bool is_corrected = false;          ///< something was found and is corrected
};

/// Measures the planned axes one after the other, the others at their angle of incidence: with
/// backlash (Q432) each position is approached from either side, and the first side counts.
/// Evaluates all axes together (decision 26).
/// @errors those of KinematicsProbing::measure.
CycleResult<KinematicsMeasurement> measure_kinematics(const CycleContext& context,
                                                      KinematicsProbing& probing,
                                                      std::span<const AxisPlan> plans,
                                                      const FitOptions& options);

/// Q141 to Q149, in mm whatever the unit of the program; -1 for axes that were not measured.
void write_kinematics_results(CycleHost& host, const KinematicsMeasurement& measurement,
                              const Vec3& offset);

}  // namespace fitgauge::probing
