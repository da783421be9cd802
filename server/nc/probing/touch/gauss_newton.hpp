#pragma once

#include <Eigen/Core>

namespace fitgauge::probing {

/// The residuals at some values, and how they change with each of them.
struct Linearised {
  Linearised(Eigen::Index rows, Eigen::Index columns) : residuals(rows), jacobian(rows, columns) {}
  Linearised(Eigen::VectorXd left, Eigen::MatrixXd changes)
      : residuals(std::move(left)), jacobian(std::move(changes)) {}

  /// Sets a row: its residual, and how it changes with each value.
  void set(Eigen::Index row, double residual, std::initializer_list<double> changes);

  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

/// Returns the values with which the columns are nearest to `wanted`.
/// @param threshold of the largest pivot, below which a column depends on the others
/// @return none if the columns do not determine the values.
std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& columns,
                                             const Eigen::VectorXd& wanted, double threshold);

/// Directions in the space of the values as columns, and their singular values in descending order.
struct Directions {
  Eigen::VectorXd sizes;
  Eigen::MatrixXd columns;
};
Directions singular_values(const Eigen::MatrixXd& rows);

/// Searches the least squares of residuals from the start `values` (Gauss-Newton).
/// `linearise(values)` gives the Linearised problem there. A search has settled if its step is
/// shorter than `settled`, in the unit of the values.
/// @return whether it has settled; otherwise `values` are unusable.
bool gauss_newton(Eigen::VectorXd& values, double settled,
                  const std::function<Linearised(const Eigen::VectorXd&)>& linearise);

}  // namespace fitgauge::probing
