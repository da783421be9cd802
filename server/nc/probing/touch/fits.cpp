#include "nc/probing/touch/fits.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

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

/// The search ends at this part of the points' spread; below it a short arc has only noise.
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

Vector3d column_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec3_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Points by rows around their mean, so that they lose no digits.
struct Centred {
  explicit Centred(std::span<const Vec3> points) : rows(static_cast<Index>(points.size()), 3) {
    for (Index row = 0; const Vec3& p : points) rows.row(row++) = column_of(p);
    mean = rows.colwise().mean();
    rows.rowwise() -= mean.transpose();
  }
  Columns3 rows;
  Vector3d mean;
};

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

std::optional<FittedPlane> fit_plane(std::span<const Vec3> points, const Vec3& towards) {
  if (points.size() < 3) return std::nullopt;
  const Centred all(points);
  const Eigen::JacobiSVD<Columns3> svd(all.rows, Eigen::ComputeFullV);
  const Vector3d& spread = svd.singularValues();
  if (!(spread[1] - spread[2] > tolerance::kCollinear * spread[0])) return std::nullopt;
  const Vec3 normal = vec3_of(svd.matrixV().col(2));
  return FittedPlane{vec3_of(all.mean), dot(normal, towards) < 0 ? -normal : normal};
}

std::optional<FittedCylinder> fit_cylinder(std::span<const Vec3> points,
                                           const FittedCylinder& near) {
  using Five = Eigen::Matrix<double, 5, 1>;  // tilt and place of the axis across it, and the radius
  if (points.size() < 5) return std::nullopt;
  const Centred all(points);
  const double size = all.rows.rowwise().norm().maxCoeff();
  const Vector3d axis = column_of(unit(near.direction));
  Eigen::Matrix<double, 3, 2> across;
  across << axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal());
  const auto direction = [&](const Five& at) -> Vector3d { return axis + across * at.head<2>(); };
  const auto linearise = [&](const Five& at) {
    const double length = direction(at).norm();
    const Vector3d along = direction(at) / length;
    Linearised made{Eigen::VectorXd(all.rows.rows()), Eigen::MatrixXd(all.rows.rows(), 5)};
    for (Index k = 0; k < all.rows.rows(); ++k) {
      const Vector3d from_axis = all.rows.row(k).transpose() / size - across * at.segment<2>(2);
      const double height = from_axis.dot(along);
      const Vector3d radial = from_axis - height * along;
      const Eigen::RowVector2d outward = radial.normalized().transpose() * across;
      made.residuals[k] = radial.norm() - at[4];
      made.jacobian.row(k) << -height / length * outward, -outward, -1;
    }
    return made;
  };
  Five cylinder = Five::Zero();
  cylinder.segment<2>(2) = across.transpose() * (column_of(near.point) - all.mean) / size;
  cylinder[4] = near.radius / size;
  if (!gauss_newton(cylinder, kSettled, linearise)) return std::nullopt;
  const Linearised found = linearise(cylinder);
  if (!least_squares(found.jacobian, found.residuals, tolerance::kCollinear)) return std::nullopt;
  const Vector3d along = direction(cylinder).normalized();
  const Vector3d place = size * across * cylinder.segment<2>(2);
  return FittedCylinder{vec3_of(all.mean + place - along * along.dot(place)), vec3_of(along),
                        size * cylinder[4]};
}

}  // namespace fitgauge::probing
