#include "probing/touch/sphere_fit.hpp"

#include <Eigen/Dense>

namespace fitgauge::probing {

using machine::Vec3;

FittedSphere fit_sphere(std::span<const Vec3> points, const FittedSphere& near) {
  constexpr int kSteps = 50;
  constexpr double kSettled = 1e-12;
  FittedSphere sphere = near;
  const auto count = static_cast<Eigen::Index>(points.size());
  for (int step = 0; step < kSteps; ++step) {
    Eigen::MatrixX4d jacobian(count, 4);
    Eigen::VectorXd residuals(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vec3 from_centre = points[static_cast<std::size_t>(k)] - sphere.centre;
      const Vec3 outward = unit(from_centre);
      jacobian.row(k) << outward.x, outward.y, outward.z, 1;
      residuals[k] = norm(from_centre) - sphere.radius;
    }
    const Eigen::Vector4d change = jacobian.colPivHouseholderQr().solve(residuals);
    sphere.centre = sphere.centre + Vec3{change[0], change[1], change[2]};
    sphere.radius += change[3];
    if (change.norm() < kSettled) break;
  }
  return sphere;
}

}  // namespace fitgauge::probing
