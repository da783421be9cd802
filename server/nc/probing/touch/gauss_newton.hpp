#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

namespace fitgauge::probing {

/// The residuals at some values, and how they change with each of them.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

/// Returns the values with which the columns are nearest to `wanted`.
/// @param threshold of the largest pivot, below which a column depends on the others
/// @return none if the columns do not determine the values.
std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& columns,
                                             const Eigen::VectorXd& wanted, double threshold);

/// Returns the step to the least squares of a linear problem; any such step if several exist.
Eigen::VectorXd least_squares_step(const Linearised& at);

/// Searches the least squares of residuals from the start `values` (Gauss-Newton).
/// `linearise(values)` gives the Linearised problem there. A search has settled if its step is
/// shorter than `settled`, in the unit of the values.
/// @return whether it has settled; otherwise `values` are unusable.
template <class Values, class Linearise>
bool gauss_newton(Values& values, double settled, const Linearise& linearise) {
  constexpr int kMostSteps = 50;
  double step = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostSteps && step > settled; ++k) {
    const Values change = least_squares_step(linearise(values));
    if (!change.allFinite()) return false;
    values += change;
    step = change.norm();
  }
  return step <= settled;
}

}  // namespace fitgauge::probing
