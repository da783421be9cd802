#include "nc/probing/touch/gauss_newton.hpp"

#include <Eigen/QR>

namespace fitgauge::probing {

std::optional<Eigen::VectorXd> least_squares(const Eigen::MatrixXd& columns,
                                             const Eigen::VectorXd& wanted, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(threshold);
  if (qr.rank() < columns.cols()) return std::nullopt;
  return qr.solve(wanted);
}

Eigen::VectorXd least_squares_step(const Linearised& at) {
  return at.jacobian.colPivHouseholderQr().solve(-at.residuals);
}

}  // namespace fitgauge::probing
