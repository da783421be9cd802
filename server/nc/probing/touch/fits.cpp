#include "nc/probing/touch/fits.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

#include "nc/machine/tolerance.hpp"
#include "nc/probing/touch/gauss_newton.hpp"

namespace fitgauge::probing {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using machine::Vec3;

/// The search ends at this part of the points' spread; below it a short arc has only noise.
constexpr double kSettled = 1e-10;

VectorXd column(std::initializer_list<double> values) {
  VectorXd made(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), made.data());
  return made;
}

/// Points around their mean and at unit size, so that they lose no digits.
struct Centred {
  explicit Centred(std::span<const Vec3> points) : all(points.begin(), points.end()) {
    for (const Vec3& p : all) mean = mean + p;
    mean = mean * (1.0 / static_cast<double>(all.size()));
    for (Vec3& p : all) size = std::max(size, norm(p = p - mean));
    for (Vec3& p : all) p = p * (size > 0 ? 1 / size : 1);
  }
  Index count() const { return static_cast<Index>(all.size()); }

  std::vector<Vec3> all;
  Vec3 mean;
  double size = 0;
};

/// Centre x, y and radius of the algebraic fit (Kåsa), exact for points on a circle.
/// Nothing when the points lie on a line.
std::optional<VectorXd> algebraic_fit(const Centred& points) {
  Linearised rows(points.count(), 3);
  for (Index k = 0; const Vec3& p : points.all) rows.set(k++, dot(p, p), {p.x, p.y, 1});
  const auto found = least_squares(rows.jacobian, rows.residuals, tolerance::kCollinear);
  if (!found) return std::nullopt;
  const double x = (*found)[0] / 2;
  const double y = (*found)[1] / 2;
  return column({x, y, std::sqrt((*found)[2] + x * x + y * y)});
}

/// The distances from the circle x, y, radius along their normals.
Linearised from_circle(const Centred& points, const VectorXd& circle) {
  Linearised made(points.count(), 3);
  for (Index k = 0; const Vec3& p : points.all) {
    const Vec3 from_centre = p - Vec3{circle[0], circle[1], 0};
    const double distance = norm(from_centre);
    made.set(k++, distance - circle[2], {-from_centre.x / distance, -from_centre.y / distance, -1});
  }
  return made;
}

/// Twice the standard deviation of the radius, for points of standard deviation 1.
double diameter_factor(const Eigen::MatrixXd& jacobian) {
  const auto normal = [&](Index a, Index b) { return jacobian.col(a).dot(jacobian.col(b)); };
  const auto minor = [&](Index a, Index b) {
    return normal(0, a) * normal(1, b) - normal(0, b) * normal(1, a);
  };
  const double determinant =
      normal(2, 0) * minor(1, 2) - normal(2, 1) * minor(0, 2) + normal(2, 2) * minor(0, 1);
  return 2 * std::sqrt(minor(0, 1) / determinant);
}

}  // namespace

CycleResult<Circle> fit_circle(std::span<const Vec3> points) {
  if (points.size() < 3) return nc_error(1081, "a circle needs three points");
  std::vector<Vec3> flat;
  for (const Vec3& p : points) flat.push_back({p.x, p.y, 0});
  const Centred all(flat);
  auto circle = algebraic_fit(all);
  if (!circle) return nc_error(1081, "the touched points lie on a straight line");
  if (!gauss_newton(*circle, kSettled, [&](const VectorXd& at) { return from_circle(all, at); }))
    return nc_error(1081, "no circle passes near the touched points");
  const Linearised found = from_circle(all, *circle);
  return Circle{{(*circle)[0] * all.size + all.mean.x, (*circle)[1] * all.size + all.mean.y},
                (*circle)[2] * all.size,
                found.residuals.cwiseAbs().maxCoeff() * all.size,
                diameter_factor(found.jacobian)};
}

std::optional<FittedSphere> fit_sphere(std::span<const Vec3> points, const FittedSphere& near) {
  const auto from_sphere = [&](const VectorXd& sphere) {
    Linearised made(static_cast<Index>(points.size()), 4);
    for (Index k = 0; const Vec3& p : points) {
      const Vec3 from_centre = p - Vec3{sphere[0], sphere[1], sphere[2]};
      const Vec3 inward = -unit(from_centre);
      made.set(k++, norm(from_centre) - sphere[3], {inward.x, inward.y, inward.z, -1});
    }
    return made;
  };
  VectorXd sphere = column({near.centre.x, near.centre.y, near.centre.z, near.radius});
  if (!gauss_newton(sphere, tolerance::kSamePoint, from_sphere)) return std::nullopt;
  return FittedSphere{{sphere[0], sphere[1], sphere[2]}, sphere[3]};
}

std::optional<FittedPlane> fit_plane(std::span<const Vec3> points, const Vec3& towards) {
  if (points.size() < 3) return std::nullopt;
  const Centred all(points);
  Linearised rows(all.count(), 3);
  for (Index k = 0; const Vec3& p : all.all) rows.set(k++, 0, {p.x, p.y, p.z});
  const auto [sizes, directions] = singular_values(rows.jacobian);
  if (!(sizes[1] - sizes[2] > tolerance::kCollinear * sizes[0])) return std::nullopt;
  const Vec3 normal{directions(0, 2), directions(1, 2), directions(2, 2)};
  return FittedPlane{all.mean, dot(normal, towards) < 0 ? -normal : normal};
}

std::optional<FittedCylinder> fit_cylinder(std::span<const Vec3> points,
                                           const FittedCylinder& near) {
  if (points.size() < 5) return std::nullopt;
  const Centred all(points);
  const Vec3 axis = unit(near.direction);
  const Vec3 across = unit(cross(axis, std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 beside = cross(axis, across);
  // The values: tilt and place of the axis across it, and the radius.
  const auto direction = [&](const VectorXd& at) { return axis + across * at[0] + beside * at[1]; };
  const auto from_cylinder = [&](const VectorXd& at) {
    const double length = norm(direction(at));
    const Vec3 along = direction(at) * (1 / length);
    Linearised made(all.count(), 5);
    for (Index k = 0; const Vec3& p : all.all) {
      const Vec3 from_axis = p - across * at[2] - beside * at[3];
      const double height = dot(from_axis, along);
      const Vec3 radial = from_axis - along * height;
      const double u = dot(unit(radial), across);
      const double v = dot(unit(radial), beside);
      made.set(k++, norm(radial) - at[4], {-height / length * u, -height / length * v, -u, -v, -1});
    }
    return made;
  };
  const Vec3 start = (near.point - all.mean) * (1 / all.size);
  VectorXd cylinder =
      column({0, 0, dot(across, start), dot(beside, start), near.radius / all.size});
  if (!gauss_newton(cylinder, kSettled, from_cylinder)) return std::nullopt;
  const Linearised found = from_cylinder(cylinder);
  if (!least_squares(found.jacobian, found.residuals, tolerance::kCollinear)) return std::nullopt;
  const Vec3 along = unit(direction(cylinder));
  const Vec3 place = (across * cylinder[2] + beside * cylinder[3]) * all.size;
  return FittedCylinder{all.mean + place - along * dot(along, place), along,
                        cylinder[4] * all.size};
}

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
