#include "nc/probing/touch/fits.hpp"

#include <Eigen/LU>

#include <cmath>
#include <optional>

#include "nc/machine/tolerance.hpp"
#include "nc/probing/touch/gauss_newton.hpp"

namespace fitgauge::probing {
namespace {

using Eigen::Index;
using Eigen::Matrix;
using Eigen::Vector2d;
using Eigen::Vector3d;
using machine::Vec3;
using Points = Matrix<double, Eigen::Dynamic, 2>;
using Columns3 = Matrix<double, Eigen::Dynamic, 3>;

/// Where the search ends, of the points' spread; a short arc has noise above less.
constexpr double kSettled = 1e-10;

/// Centre x, y and radius of the algebraic fit (Kåsa), exact for points on a circle.
/// Nothing when the points lie on a line.
std::optional<Vector3d> algebraic_fit(const Points& points) {
  Columns3 columns(points.rows(), 3);
  columns << points, Eigen::VectorXd::Ones(points.rows());
  const auto found = least_squares(columns, points.rowwise().squaredNorm(), tolerance::kCollinear);
  if (!found) return std::nullopt;
  const Vector3d s = *found;
  const Vector2d centre = s.head<2>() / 2;
  return Vector3d(centre.x(), centre.y(), std::sqrt(s.z() + centre.squaredNorm()));
}

Eigen::VectorXd distances(const Points& points, const Vector3d& circle) {
  return (points.rowwise() - circle.head<2>().transpose()).rowwise().norm();
}

/// The distances from the circle x, y, radius along their normals.
Linearised linearise(const Points& points, const Vector3d& circle) {
  const Eigen::VectorXd distance = distances(points, circle);
  Columns3 jacobian(points.rows(), 3);
  jacobian << -((points.rowwise() - circle.head<2>().transpose()).array().colwise() /
                distance.array())
                   .matrix(),
      -Eigen::VectorXd::Ones(points.rows());
  return {distance.array() - circle.z(), jacobian};
}

double diameter_factor(const Eigen::MatrixXd& jacobian) {
  const Eigen::Matrix3d normal = jacobian.transpose() * jacobian;
  return 2 * std::sqrt(normal.inverse()(2, 2));
}

}  // namespace

CycleResult<Circle> fit_circle(std::span<const Point2> points) {
  if (points.size() < 3) return nc_error(1081, "a circle needs three points");
  Points all(static_cast<Index>(points.size()), 2);
  for (Index row = 0; const Point2& p : points) all.row(row++) << p.x, p.y;

  // Around their mean and at unit size the points lose no digits.
  const Eigen::RowVector2d mean = all.colwise().mean();
  all.rowwise() -= mean;
  const double spread = all.rowwise().norm().maxCoeff();
  if (spread > 0) all /= spread;
  auto circle = algebraic_fit(all);
  if (!circle) return nc_error(1081, "the touched points lie on a straight line");
  if (!gauss_newton(*circle, kSettled, [&](const Vector3d& at) { return linearise(all, at); })) {
    return nc_error(1081, "no circle passes near the touched points");
  }

  const double residual = (distances(all, *circle).array() - circle->z()).abs().maxCoeff();
  return Circle{{circle->x() * spread + mean.x(), circle->y() * spread + mean.y()},
                circle->z() * spread,
                residual * spread,
                diameter_factor(linearise(all, *circle).jacobian)};
}

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
