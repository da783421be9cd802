#include "probing/kinematics/fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::Kinematics;
using machine::RotaryAxis;
using machine::Vec3;

/// mm: the lever at which a direction counts as much as a location.
constexpr double kLever = 100;

/// One value that is fitted: a location or a direction of an axis, along one of its two vectors.
struct Unknown {
  std::size_t axis = 0;
  bool is_direction = false;
  std::size_t side = 0;
};

/// A rotary axis as a line through the height of the sphere, and two vectors across it.
struct Line {
  RotaryAxis modelled;
  Vec3 anchor;
  std::array<Vec3, 2> across;
};

/// The point of the sphere (on a table) or of the ball (under a head) that turns around the axis.
Vec3 turning_point(const Vec3& sphere, const RotaryAxis& axis, const MeasuringTool& tool) {
  return axis.mount == machine::AxisMount::Table ? sphere : unit_vector(tool.axis) * -tool.length;
}

Line line_of(const RotaryAxis& axis, const Vec3& sphere, const MeasuringTool& tool) {
  const Vec3& along = axis.direction;
  const Vec3 lever = turning_point(sphere, axis, tool) - axis.centre;
  // The machine's axis that is most across gives the first vector, so that it is named alike.
  std::size_t most = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(along[k]) < std::abs(along[most])) most = k;
  }
  Vec3 beside;
  beside[most] = 1;
  const Vec3 first = unit(beside - along * dot(beside, along));
  return {axis, axis.centre + along * dot(lever, along), {first, cross(along, first)}};
}

Kinematics corrected(const Kinematics& model, const std::vector<Line>& lines,
                     const std::vector<Unknown>& unknowns, const Eigen::VectorXd& values) {
  std::vector<RotaryAxis> axes = model.axes();
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Line& line = lines[k];
    Vec3 moved = line.anchor;
    Vec3 turned = line.modelled.direction;
    bool changes = false;
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      if (unknowns[j].axis != k) continue;
      const Vec3 step = line.across[unknowns[j].side] * values[static_cast<Eigen::Index>(j)];
      if (unknowns[j].is_direction) {
        turned = turned + step * (1 / kLever);
      } else {
        moved = moved + step;
      }
      changes = true;
    }
    if (!changes) continue;
    const auto axis = std::ranges::find(axes, line.modelled.axis, &RotaryAxis::axis);
    const double height = dot(line.modelled.centre - line.anchor, line.modelled.direction);
    axis->direction = unit(turned);
    axis->centre = moved + axis->direction * height;
  }
  return Kinematics(std::move(axes), model.offset());
}

/// The poses' places on the table, each less their mean, one below the other.
Eigen::VectorXd residuals(std::span<const SpherePose> poses, const Kinematics& model,
                          const MeasuringTool& tool) {
  const Spread found = spread(poses, model, tool);
  Eigen::VectorXd stacked(static_cast<Eigen::Index>(3 * poses.size()));
  Eigen::Index row = 0;
  for (const Vec3& error : found.errors) {
    for (std::size_t k = 0; k < 3; ++k) stacked[row++] = error[k];
  }
  return stacked;
}

/// One fit of a set of unknowns: their values and what the positions see of them.
class Adjustment {
 public:
  Adjustment(std::span<const SpherePose> poses, const Kinematics& model, const MeasuringTool& tool,
             const std::vector<Line>& lines, const std::vector<Unknown>& unknowns)
      : poses_(poses), model_(model), tool_(tool), lines_(lines), unknowns_(unknowns) {
    values_.setZero(static_cast<Eigen::Index>(unknowns.size()));
    decompose();
  }

  /// Which unknowns lie in no direction that the positions leave undefined.
  std::vector<bool> seen() const {
    constexpr double kUndefined = 1e-3;  ///< mm of the centres for 1 mm of the unknowns
    constexpr double kPart = 1e-6;
    const auto& sizes = decomposition_.singularValues();
    std::vector<bool> seen(unknowns_.size(), true);
    for (Eigen::Index direction = 0; direction < sizes.size(); ++direction) {
      if (sizes[direction] > kUndefined) continue;
      for (std::size_t j = 0; j < unknowns_.size(); ++j) {
        const double part = decomposition_.matrixV()(static_cast<Eigen::Index>(j), direction);
        if (std::abs(part) > kPart) seen[j] = false;
      }
    }
    return seen;
  }

  /// Gauss-Newton. @pre all unknowns are seen.
  void solve() {
    constexpr int kSteps = 20;
    constexpr double kSettled = 1e-12;
    for (int step = 0; step < kSteps; ++step) {
      const Eigen::VectorXd change = decomposition_.solve(-residuals(poses_, at(values_), tool_));
      values_ += change;
      if (change.norm() < kSettled) break;
      decompose();
    }
  }

  Kinematics at(const Eigen::VectorXd& values) const {
    return corrected(model_, lines_, unknowns_, values);
  }
  const Eigen::VectorXd& values() const { return values_; }

  /// Of the unknowns, for centres of variance 1.
  Eigen::MatrixXd covariance() const {
    const Eigen::MatrixXd scaled =
        decomposition_.matrixV() * decomposition_.singularValues().cwiseInverse().asDiagonal();
    return scaled * scaled.transpose();
  }

 private:
  /// The change of the residuals with each unknown. They are smooth and nearly linear, so central
  /// differences are exact enough: the solution is where the residuals are least, not where the
  /// matrix is exact.
  void decompose() {
    if (unknowns_.empty()) return;
    constexpr double kStep = 1e-3;
    Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(3 * poses_.size()), values_.size());
    for (Eigen::Index j = 0; j < values_.size(); ++j) {
      Eigen::VectorXd ahead = values_;
      Eigen::VectorXd behind = values_;
      ahead[j] += kStep;
      behind[j] -= kStep;
      jacobian.col(j) =
          (residuals(poses_, at(ahead), tool_) - residuals(poses_, at(behind), tool_)) /
          (2 * kStep);
    }
    decomposition_.compute(jacobian, Eigen::ComputeFullU | Eigen::ComputeFullV);
  }

  std::span<const SpherePose> poses_;
  const Kinematics& model_;
  const MeasuringTool& tool_;
  const std::vector<Line>& lines_;
  const std::vector<Unknown>& unknowns_;
  Eigen::VectorXd values_;
  Eigen::JacobiSVD<Eigen::MatrixXd> decomposition_;
};

/// Gives up what is not seen: the direction of an axis goes as a whole, and before any location.
/// Whether something was given up.
bool drop_unseen(std::vector<Unknown>& unknowns, const std::vector<bool>& seen) {
  std::vector<Unknown> lost;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    if (!seen[j]) lost.push_back(unknowns[j]);
  }
  const bool directions =
      std::any_of(lost.begin(), lost.end(), [](const Unknown& u) { return u.is_direction; });
  const auto is_lost = [&](const Unknown& unknown) {
    if (unknown.is_direction != directions) return false;
    return std::any_of(lost.begin(), lost.end(), [&](const Unknown& gone) {
      return gone.is_direction == directions && gone.axis == unknown.axis;
    });
  };
  return std::erase_if(unknowns, is_lost) > 0;
}

/// What the fit says about one line.
AxisErrors errors_of(std::size_t k, const Line& line, const std::vector<Unknown>& unknowns,
                     const Adjustment& fit) {
  AxisErrors found{.axis = line.modelled.axis, .location = {}, .tilt_deg = {}};
  std::vector<Eigen::Index> places;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    if (unknowns[j].axis != k) continue;
    const auto row = static_cast<Eigen::Index>(j);
    const Vec3 step = line.across[unknowns[j].side] * fit.values()[row];
    if (unknowns[j].is_direction) {
      const Vec3 tilt = cross(line.modelled.direction, step) * machine::degrees(1 / kLever);
      found.tilt_deg = found.tilt_deg.value_or(Vec3{}) + tilt;
    } else {
      found.location = found.location.value_or(Vec3{}) + step;
      places.push_back(row);
    }
  }
  if (places.size() == 2) {
    const Eigen::MatrixXd all = fit.covariance();
    Eigen::Matrix2d block;
    for (Eigen::Index i = 0; i < 2; ++i) {
      for (Eigen::Index j = 0; j < 2; ++j) {
        block(i, j) = all(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(j)]);
      }
    }
    found.valuation = 1 / Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(block).eigenvalues()[1];
  }
  return found;
}

}  // namespace

Vec3 on_table(const SpherePose& pose, const Kinematics& model, const MeasuringTool& tool) {
  const Vec3 in_machine = pose.nose + model.tool_vector(pose.rotary, tool.axis, tool.length);
  return model.table(pose.rotary).inverse().point(in_machine);
}

Spread spread(std::span<const SpherePose> poses, const Kinematics& model, const MeasuringTool& tool,
              std::size_t parameters) {
  Spread found;
  for (const SpherePose& pose : poses) {
    found.errors.push_back(on_table(pose, model, tool));
    found.centre = found.centre + found.errors.back();
  }
  const auto count = static_cast<double>(poses.size());
  found.centre = found.centre * (1 / count);
  double squares = 0;
  for (Vec3& error : found.errors) {
    error = error - found.centre;
    squares += dot(error, error);
  }
  if (poses.size() == 2) {
    found.deviation = 2 * norm(found.errors.front());
  } else if (poses.size() > 2) {
    found.deviation = std::sqrt(squares / (3 * count - 3 - static_cast<double>(parameters)));
  }
  return found;
}

KinematicsFit fit_kinematics(std::span<const SpherePose> poses, const Kinematics& model,
                             const MeasuringTool& tool, std::span<const Axis> axes,
                             bool directions) {
  KinematicsFit found;
  found.before = spread(poses, model, tool);
  std::vector<Line> lines;
  std::vector<Unknown> unknowns;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    lines.push_back(line_of(*model.find(axes[k]), found.before.centre, tool));
    for (std::size_t side = 0; side < 2; ++side) {
      unknowns.push_back({k, false, side});
      if (directions) unknowns.push_back({k, true, side});
    }
  }
  while (!unknowns.empty() &&
         drop_unseen(unknowns, Adjustment(poses, model, tool, lines, unknowns).seen())) {
  }
  Adjustment fit(poses, model, tool, lines, unknowns);
  if (!unknowns.empty()) fit.solve();
  found.corrected = fit.at(fit.values());
  found.after = spread(poses, found.corrected, tool, unknowns.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    found.errors.push_back(errors_of(k, lines[k], unknowns, fit));
  }
  return found;
}

double fit_backlash(std::span<const SpherePose> from_below, std::span<const SpherePose> from_above,
                    const Kinematics& model, const MeasuringTool& tool, Axis axis) {
  constexpr double kStepDeg = 1e-3;
  double products = 0;
  double squares = 0;
  for (std::size_t k = 0; k < from_below.size(); ++k) {
    // How the place moves when the axis stands elsewhere than it says.
    SpherePose ahead = from_below[k];
    SpherePose behind = ahead;
    ahead.rotary[index(axis) - 3] += kStepDeg;
    behind.rotary[index(axis) - 3] -= kStepDeg;
    const Vec3 per_degree =
        (on_table(behind, model, tool) - on_table(ahead, model, tool)) * (1 / (2 * kStepDeg));
    const Vec3 way = on_table(from_above[k], model, tool) - on_table(from_below[k], model, tool);
    products += dot(per_degree, way);
    squares += dot(per_degree, per_degree);
  }
  return products / squares;
}

double measuring_radius(const Vec3& sphere, const RotaryAxis& axis, const MeasuringTool& tool) {
  const Line line = line_of(axis, sphere, tool);
  return norm(turning_point(sphere, axis, tool) - line.anchor);
}

}  // namespace fitgauge::probing
