#pragma once

#include <Eigen/Dense>
#include <limits>

namespace fitgauge::probing {

/// The residuals at some values, and how they change with each of them.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

/// Searches the least squares of residuals from where `values` stand (Gauss-Newton).
/// `linearise(values)` gives the Linearised problem there. A search has settled when its step is
/// shorter than `settled`, in the unit of the values.
/// @return whether it has; when not, `values` are of no use.
template <class Values, class Linearise>
bool gauss_newton(Values& values, double settled, const Linearise& linearise) {
  constexpr int kMostSteps = 50;
  double step = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostSteps && step > settled; ++k) {
    const Linearised at = linearise(values);
    const Values change = at.jacobian.colPivHouseholderQr().solve(-at.residuals);
    if (!change.allFinite()) return false;
    values += change;
    step = change.norm();
  }
  return step <= settled;
}

}  // namespace fitgauge::probing
