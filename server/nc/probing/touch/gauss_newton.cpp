#include "nc/probing/touch/gauss_newton.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace fitgauge::probing {

void Linearised::set(Eigen::Index row, double residual, std::initializer_list<double> changes) {
  residuals[row] = residual;
  for (Eigen::Index column = 0; const double change : changes) jacobian(row, column++) = change;
}

std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& columns,
                                             const Eigen::VectorXd& wanted, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(threshold);
  if (qr.rank() < columns.cols()) return std::nullopt;
  return qr.solve(wanted);
}

Directions singular_values(const Eigen::MatrixXd& rows) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

bool gauss_newton(Eigen::VectorXd& values, double settled,
                  const std::function<Linearised(const Eigen::VectorXd&)>& linearise) {
  constexpr int kMostSteps = 50;
  double step = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostSteps && step > settled; ++k) {
    const Linearised at = linearise(values);
    // Any such step if several exist.
    const Eigen::VectorXd change = at.jacobian.colPivHouseholderQr().solve(-at.residuals);
    if (!change.allFinite()) return false;
    values += change;
    step = change.norm();
  }
  return step <= settled;
}

}  // namespace fitgauge::probing
