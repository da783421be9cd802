#include "metrology/statistics/press_fit.hpp"

#include <algorithm>
#include <cmath>

namespace fitgauge::metrology {

Result<Pressure> press(const PressFit& fit, double interference_um) {
  const double d = fit.joint_diameter_mm;
  const double outer = fit.hub.other_diameter_mm;
  const double inner = fit.shaft.other_diameter_mm;
  if (!(inner < d && d < outer)) {
    return Error{ErrorCode::FieldInvalid,
                 "the hub must be wider outside than the joint, the shaft's bore narrower"};
  }
  constexpr double kFlattened = 0.4;
  constexpr double kMicrometres = 1000;
  const double hub_ratio = (outer * outer + d * d) / (outer * outer - d * d);
  const double shaft_ratio = (d * d + inner * inner) / (d * d - inner * inner);
  const double compliance = (hub_ratio + fit.hub.poisson_ratio) / fit.hub.youngs_modulus_mpa +
                            (shaft_ratio - fit.shaft.poisson_ratio) / fit.shaft.youngs_modulus_mpa;
  Pressure made;
  made.effective_um =
      std::max(0.0, interference_um - kFlattened * (fit.hub.rz_um + fit.shaft.rz_um));
  const double p = made.effective_um / kMicrometres / (d * compliance);
  made.pressure_mpa = p;
  // In the bore of the hub: hoop p * ratio, radial -p.
  made.hub_stress_mpa = p * std::sqrt(hub_ratio * hub_ratio + hub_ratio + 1);
  // A solid shaft is pressed evenly; in the bore of a hollow one only the hoop stress is left.
  made.shaft_stress_mpa = inner > 0 ? 2 * p * d * d / (d * d - inner * inner) : p;
  made.axial_force_n = fit.friction * p * M_PI * d * fit.length_mm;
  made.torque_nm = made.axial_force_n * d / 2 / kMicrometres;
  return made;
}

}  // namespace fitgauge::metrology
