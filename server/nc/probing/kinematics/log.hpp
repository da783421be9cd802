#pragma once

#include <optional>
#include <string_view>

#include "nc/probing/kinematics/measurement.hpp"

namespace fitgauge::probing {

/// The content of a log of kinematics.
struct KinematicsReport {
  std::string_view mode;  ///< in words
  const KinematicsMeasurement& measurement;
  bool directions = false;      ///< were asked for
  std::optional<Vec3> shift{};  ///< of the preset, in mm, that was compensated
};

/// Adds a measurement to TCHPR451.html (that of the cycle's number) beside the program: per axis
/// its positions with their errors before and after, standard deviations, what was found and what
/// the positions cannot see. Lengths in mm, in an INCH program too.
/// @errors when the run's output budget is used up.
CycleResult<void> log_kinematics(const CycleContext& context, const KinematicsReport& report);

/// The same of axes that were measured together.
CycleResult<void> log_grid(const CycleContext& context, std::string_view mode,
                           std::span<const SpherePose> poses, const KinematicsFit& fit);

}  // namespace fitgauge::probing
