#include "nc/probing/kinematics/adjustment.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::probing {
namespace {

using machine::Kinematics;
using machine::RotaryAxis;
using machine::Vec3;

Eigen::Index index_of(std::size_t k) { return static_cast<Eigen::Index>(k); }

}  // namespace

Vec3 turning_point(const Vec3& sphere, const RotaryAxis& axis, const MeasuringTool& tool) {
  return axis.mount == machine::AxisMount::Table ? sphere : unit_vector(tool.axis) * -tool.length;
}

Line line_of(const RotaryAxis& axis, const Vec3& sphere, const MeasuringTool& tool,
             const RotaryAxis* carrier) {
  const Vec3& along = axis.direction;
  const Vec3 lever = turning_point(sphere, axis, tool) - axis.centre;
  // The first vector comes from the machine's axis that is most across, so that its name is stable.
  std::size_t most = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(along[k]) < std::abs(along[most])) most = k;
  }
  Vec3 beside;
  beside[most] = 1;
  if (carrier != nullptr) beside = cross(carrier->direction, along);
  const Vec3 first = unit(beside - along * dot(beside, along));
  return {axis, axis.centre + along * dot(lever, along), {first, cross(along, first)}};
}

Adjustment::Adjustment(const AdjustedPoses& poses, std::vector<Unknown> unknowns)
    : poses_(poses), unknowns_(std::move(unknowns)) {
  values_.setZero(index_of(unknowns_.size()));
  decompose();
}

std::vector<bool> Adjustment::seen() const {
  constexpr double kPart = 1e-6;
  std::vector<bool> seen(unknowns_.size(), true);
  // With fewer residuals than unknowns the last directions have size 0.
  for (Eigen::Index direction = 0; direction < index_of(unknowns_.size()); ++direction) {
    if (direction < directions_.sizes.size() && directions_.sizes[direction] > tolerance::kSeen)
      continue;
    for (std::size_t j = 0; j < unknowns_.size(); ++j) {
      const double part = directions_.columns(index_of(j), direction);
      if (std::abs(part) > kPart) seen[j] = false;
    }
  }
  return seen;
}

void Adjustment::solve() {
  if (unknowns_.empty()) return;
  const bool settled =
      gauss_newton(values_, tolerance::kSamePoint, [this](const Eigen::VectorXd& values) {
        return Linearised{residuals(at(values)), jacobian(values)};
      });
  // No rigid machine can have these poses: no values are better than others.
  if (!settled) values_.setZero();
  decompose();
}

Kinematics Adjustment::at(const Eigen::VectorXd& values) const {
  std::vector<RotaryAxis> axes = poses_.model.axes();
  for (std::size_t k = 0; k < poses_.lines.size(); ++k) {
    const Line& line = poses_.lines[k];
    Vec3 moved = line.anchor;
    Vec3 turned = line.modelled.direction;
    double zero = line.modelled.zero_deg;
    bool changes = false;
    for (std::size_t j = 0; j < unknowns_.size(); ++j) {
      if (unknowns_[j].axis != k) continue;
      const double value = values[index_of(j)];
      const Vec3 step = line.across[unknowns_[j].side] * value;
      switch (unknowns_[j].kind) {
        case ErrorKind::Location: moved = moved + step; break;
        case ErrorKind::Direction: turned = turned + step * (1 / kLever); break;
        case ErrorKind::Zero: zero += machine::degrees(value / kLever); break;
      }
      changes = true;
    }
    if (!changes) continue;
    const auto axis = std::ranges::find(axes, line.modelled.axis, &RotaryAxis::axis);
    const double height = dot(line.modelled.centre - line.anchor, line.modelled.direction);
    axis->zero_deg = zero;
    axis->direction = unit(turned);
    axis->centre = moved + axis->direction * height;
  }
  return Kinematics(std::move(axes), poses_.model.offset());
}

/// The places on the table, each less the mean of its group, one below the other.
Eigen::VectorXd Adjustment::residuals(const Kinematics& model) const {
  std::vector<double> all;
  for (const PoseGroup& group : poses_.groups) {
    for (const Vec3& error : spread(group, model, poses_.tool).errors)
      all.insert(all.end(), {error.x, error.y, error.z});
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), index_of(all.size()));
}

/// The residuals are smooth and nearly linear, so central differences are exact enough: the least
/// residuals define the solution, not the exact matrix.
Eigen::MatrixXd Adjustment::jacobian(const Eigen::VectorXd& values) const {
  constexpr double kStep = 1e-3;
  Eigen::MatrixXd jacobian;
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    Eigen::VectorXd ahead = values;
    Eigen::VectorXd behind = values;
    ahead[j] += kStep;
    behind[j] -= kStep;
    const Eigen::VectorXd column = (residuals(at(ahead)) - residuals(at(behind))) / (2 * kStep);
    if (j == 0) jacobian.resize(column.size(), values.size());
    jacobian.col(j) = column;
  }
  return jacobian;
}

void Adjustment::decompose() {
  if (unknowns_.empty()) return;
  directions_ = singular_values(jacobian(values_));
}

Eigen::MatrixXd Adjustment::covariance() const {
  if (unknowns_.empty()) return {};
  const Eigen::MatrixXd scaled =
      directions_.columns * directions_.sizes.cwiseInverse().asDiagonal();
  return scaled * scaled.transpose();
}

std::size_t Adjustment::freedom() const {
  std::size_t freedom = 0;
  for (const PoseGroup& group : poses_.groups) freedom += 3 * (group.size() - 1);
  return freedom > unknowns_.size() ? freedom - unknowns_.size() : 0;
}

double Adjustment::scatter() const {
  if (freedom() == 0) return 0;
  return residuals(corrected()).norm() / std::sqrt(static_cast<double>(freedom()));
}

}  // namespace fitgauge::probing
