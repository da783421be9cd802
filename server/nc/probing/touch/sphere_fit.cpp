#include "nc/probing/touch/sphere_fit.hpp"

#include "nc/machine/tolerance.hpp"
#include "nc/probing/touch/gauss_newton.hpp"

namespace fitgauge::probing {

using machine::Vec3;

std::optional<FittedSphere> fit_sphere(std::span<const Vec3> points, const FittedSphere& near) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const auto linearise = [&](const Eigen::Vector4d& sphere) {
    Linearised at{Eigen::VectorXd(count), Eigen::MatrixXd(count, 4)};
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vec3 from_centre =
          points[static_cast<std::size_t>(k)] - Vec3{sphere[0], sphere[1], sphere[2]};
      const Vec3 outward = unit(from_centre);
      at.jacobian.row(k) << -outward.x, -outward.y, -outward.z, -1;
      at.residuals[k] = norm(from_centre) - sphere[3];
    }
    return at;
  };
  Eigen::Vector4d sphere(near.centre.x, near.centre.y, near.centre.z, near.radius);
  if (!gauss_newton(sphere, tolerance::kSamePoint, linearise)) return std::nullopt;
  return FittedSphere{{sphere[0], sphere[1], sphere[2]}, sphere[3]};
}

}  // namespace fitgauge::probing
