#pragma once

#include "nc/probing/cycle_fault.hpp"
#include "nc/probing/cycle_host.hpp"
#include "nc/probing/measuring_record.hpp"
#include "nc/probing/working_plane.hpp"

namespace fitgauge::probing {

/// A point that cycle 444 has touched. Coordinates and components along main, secondary and probe
/// axis, in whole nanometres; along the normal, positive is away from the material.
struct ProbedPoint {
  WorkingPlane plane;
  machine::Vec3 normal;  ///< of the surface, length 1
  double distance = 0;   ///< DIST, mm: the length that the log draws the probing direction with
  std::array<Length, 3> nominal{};
  std::array<Length, 3> measured{};
  Length deviation;                           ///< along the normal
  std::optional<Limits> limits{};             ///< of that deviation
  std::optional<gauging::Verdict> verdict{};  ///< nothing without limits
};

/// Writes a point into TCHPR444.html beside the program: the first point of a run begins the file,
/// each further one joins it. The file is one HTML page that needs no other file and can be read
/// without colours.
/// @errors when the run's output budget is used up.
CycleResult<void> log_probed_point(CycleHost& host, const ProbedPoint& point);

}  // namespace fitgauge::probing
