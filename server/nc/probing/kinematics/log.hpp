#pragma once

#include "nc/probing/kinematics/measurement.hpp"

namespace fitgauge::probing {

/// The content of a log of kinematics.
struct KinematicsReport {
  std::string_view mode;  ///< in words
  const KinematicsMeasurement& measurement;
  bool directions = false;      ///< were asked for
  std::optional<Vec3> shift{};  ///< of the preset, in mm, that was compensated
};

/// Adds a measurement to TCHPR451.html (with the cycle's number) in the program's folder: for each
/// axis its positions with errors before and after, standard deviations, results and undetermined
/// values. Lengths in mm, also in an INCH program.
/// @errors if the run's output budget is used up.
CycleResult<void> log_kinematics(const CycleContext& context, const KinematicsReport& report);

/// Writes the log of axes that were measured together.
CycleResult<void> log_grid(const CycleContext& context, std::string_view mode,
                           std::span<const SpherePose> poses, const KinematicsFit& fit);

}  // namespace fitgauge::probing
