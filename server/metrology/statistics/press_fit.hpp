#pragma once

#include "base/result.hpp"

namespace fitgauge::metrology {

/// One side of a press fit, elastic. Lengths in mm, stresses in MPa.
struct PressedPart {
  double other_diameter_mm = 0;  ///< of the hub outside, of the shaft inside: 0 when it is solid
  double youngs_modulus_mpa = 210'000;
  double poisson_ratio = 0.3;
  double rz_um = 0;  ///< roughness, which pressing flattens
};

struct PressFit {
  double joint_diameter_mm = 0;
  double length_mm = 0;
  double friction = 0.12;
  PressedPart hub;
  PressedPart shaft;
};

/// What an interference presses.
struct Pressure {
  double effective_um = 0;      ///< interference less what pressing flattens, 0.4 (Rz + Rz)
  double pressure_mpa = 0;      ///< in the joint
  double hub_stress_mpa = 0;    ///< equivalent stress (von Mises) in the bore of the hub
  double shaft_stress_mpa = 0;  ///< the same at the shaft: in its bore when it is hollow
  double axial_force_n = 0;     ///< that slips
  double torque_nm = 0;         ///< that slips
};

/// Lamé's thick cylinders under plane stress (DIN 7190-1:2017 with its 0.4 Rz).
/// @param interference_um of the diameters, 0 or more
/// @errors FieldInvalid where the parts are no cylinders around each other.
Result<Pressure> press(const PressFit& fit, double interference_um);

}  // namespace fitgauge::metrology
