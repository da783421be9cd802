#include "nc/probing/kinematics/fit.hpp"

#include "metrology/statistics/summary.hpp"
#include "nc/machine/tolerance.hpp"
#include "nc/probing/kinematics/adjustment.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::AxisMount;
using machine::Kinematics;
using machine::RotaryAxis;
using machine::Vec3;

/// A group of unknowns: the location, the direction or the zero of one axis.
bool is_of(const Unknown& unknown, std::size_t axis, ErrorKind kind) {
  return unknown.axis == axis && unknown.kind == kind;
}

bool is_angle(const Unknown& unknown) { return unknown.kind != ErrorKind::Location; }

/// Drops undetermined unknowns: directions of an axis only together, angles before locations.
/// @return whether something was dropped.
bool drop_unseen(std::vector<Unknown>& unknowns, const std::vector<bool>& seen) {
  std::vector<Unknown> lost;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    if (!seen[j]) lost.push_back(unknowns[j]);
  }
  const bool angles = std::ranges::any_of(lost, is_angle);
  const auto is_lost = [&](const Unknown& unknown) {
    if (is_angle(unknown) != angles) return false;
    return std::ranges::any_of(
        lost, [&](const Unknown& gone) { return is_of(gone, unknown.axis, unknown.kind); });
  };
  return std::erase_if(unknowns, is_lost) > 0;
}

/// Counts the axes that come to rest anew between the groups, which looks like a location error of
/// `axis`. They stand still in the machine if `axis` turns a table, or in the system of `axis` if
/// it turns a tool.
double restless_axes(const Kinematics& model, Axis axis) {
  const auto& axes = model.axes();
  const auto found = std::ranges::find(axes, axis, &RotaryAxis::axis);
  if (found->mount == AxisMount::Head) return static_cast<double>(axes.end() - found - 1);
  const auto heads = std::ranges::count(axes, AxisMount::Head, &RotaryAxis::mount);
  return static_cast<double>(found - axes.begin() + heads);
}

/// The unit of an unknown: mm, or a rotation vector in degrees.
Vec3 step_of(const Unknown& unknown, const Line& line) {
  const Vec3& across = line.across.at(unknown.side);
  const Vec3& along = line.modelled.direction;
  switch (unknown.kind) {
    case ErrorKind::Location: return across;
    case ErrorKind::Direction: return cross(along, across) * machine::degrees(1 / kLever);
    case ErrorKind::Zero: break;
  }
  return along * machine::degrees(1 / kLever);
}

/// A location, a direction or a zero with its uncertainty.
class Estimate {
 public:
  Estimate(const Adjustment& fit, const Line& line, std::size_t axis, ErrorKind kind)
      : scatter_(fit.scatter()) {
    const Eigen::MatrixXd all = fit.covariance();
    std::array<Eigen::Index, 2> rows{};
    std::size_t sides = 0;
    for (std::size_t j = 0; j < fit.unknowns().size(); ++j) {
      const Unknown& unknown = fit.unknowns()[j];
      if (!is_of(unknown, axis, kind)) continue;
      rows.at(sides) = static_cast<Eigen::Index>(j);
      steps_.at(sides++) = step_of(unknown, line);
    }
    is_seen_ = sides > 0;
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(sides); ++i) {
      values_[i] = fit.values()[rows.at(static_cast<std::size_t>(i))];
      for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(sides); ++j) {
        covariance_(i, j) =
            all(rows.at(static_cast<std::size_t>(i)), rows.at(static_cast<std::size_t>(j)));
      }
    }
  }

  bool is_seen() const { return is_seen_; }
  /// Returns the greatest eigenvalue of the covariance, for centres of variance 1.
  double worst() const {
    const auto& c = covariance_;
    return (c(0, 0) + c(1, 1)) / 2 + std::hypot((c(0, 0) - c(1, 1)) / 2, c(0, 1));
  }

  /// @param rests variances of a centre that add up to that of the value.
  FoundError found(double rests, double coverage) const {
    FoundError error;
    error.value = steps_[0] * values_[0] + steps_[1] * values_[1];
    error.size = values_.norm();
    const double along =
        error.size > 0 ? values_.dot(covariance_ * values_) / values_.squaredNorm() : worst();
    error.standard_uncertainty = scatter_ * std::sqrt(along + rests);
    error.is_significant = error.size >= 2 * error.standard_uncertainty ||
                           2 * error.standard_uncertainty < tolerance::kNanometre;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d part(steps_[0][k], steps_[1][k]);
      error.uncertainty[k] = coverage * scatter_ *
                             std::sqrt(part.dot(covariance_ * part) + rests * part.squaredNorm());
    }
    return error;
  }

 private:
  double scatter_;
  bool is_seen_ = false;
  std::array<Vec3, 2> steps_;  ///< size of one mm of each value
  Eigen::Vector2d values_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();
};

/// Returns the factor of a standard deviation for 95 % on both sides; 0 if the scatter is unknown.
double coverage_of(std::size_t freedom) {
  if (freedom == 0) return 0;
  return static_cast<double>(metrology::t_quantile(0.975L, static_cast<long double>(freedom)));
}

constexpr std::array kKinds{ErrorKind::Zero, ErrorKind::Direction, ErrorKind::Location};

std::vector<AxisErrors> errors_of(const Adjustment& fit, const Kinematics& model,
                                  const std::vector<Line>& lines) {
  std::vector<AxisErrors> all;
  const double coverage = coverage_of(fit.freedom());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Axis axis = lines[k].modelled.axis;
    AxisErrors& errors = all.emplace_back(AxisErrors{.axis = axis});
    for (const ErrorKind kind : kKinds) {
      const Estimate estimate(fit, lines[k], k, kind);
      if (!estimate.is_seen()) continue;
      const bool is_location = kind == ErrorKind::Location;
      if (is_location) errors.valuation = 1 / estimate.worst();
      errors[kind] = estimate.found(is_location ? restless_axes(model, axis) : 0, coverage);
    }
  }
  return all;
}

/// Drops the least significant unknowns, angles first. @return whether something was dropped.
bool drop_insignificant(std::vector<Unknown>& unknowns, const std::vector<AxisErrors>& errors) {
  for (const ErrorKind kind : kKinds) {
    double least = 0;
    std::optional<std::size_t> dropped;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      const auto& found = errors[k][kind];
      if (!found || found->is_significant) continue;
      const double significance = found->size / found->standard_uncertainty;
      if (!dropped || significance < least) dropped = k;
      least = dropped == k ? significance : least;
    }
    if (!dropped) continue;
    std::erase_if(unknowns, [&](const Unknown& u) { return is_of(u, *dropped, kind); });
    return true;
  }
  return false;
}

/// An insignificant unknown may become significant without the others, so the rest is corrected.
void mark_corrected(std::vector<AxisErrors>& errors, const std::vector<Unknown>& unknowns) {
  for (std::size_t k = 0; k < errors.size(); ++k) {
    for (const ErrorKind kind : kKinds) {
      auto& found = errors[k][kind];
      if (!found) continue;
      found->is_significant =
          std::ranges::any_of(unknowns, [&](const Unknown& u) { return is_of(u, k, kind); });
    }
  }
}

/// Returns which of `axes` carries the k-th of them, directly and across it; none if no axis does.
std::optional<std::size_t> carrier_of(const Kinematics& model, std::span<const Axis> axes,
                                      std::size_t k) {
  const auto& chain = model.axes();
  const auto own = std::ranges::find(chain, axes[k], &RotaryAxis::axis);
  if (own == chain.begin() || std::prev(own)->mount != own->mount) return std::nullopt;
  const RotaryAxis& carrier = *std::prev(own);
  const auto found = std::ranges::find(axes, carrier.axis);
  if (found == axes.end() || norm(cross(carrier.direction, own->direction)) < tolerance::kAcross)
    return std::nullopt;
  return static_cast<std::size_t>(found - axes.begin());
}

std::vector<Spread> spreads(std::span<const PoseGroup> groups, const Kinematics& model,
                            const MeasuringTool& tool) {
  std::vector<Spread> all;
  for (const PoseGroup& group : groups) all.push_back(spread(group, model, tool));
  return all;
}

/// Returns the movement of the place on the table with the angle of the axis, in mm per degree.
Vec3 way_per_degree(const SpherePose& pose, const Kinematics& model, const MeasuringTool& tool,
                    Axis axis) {
  constexpr double kStepDeg = 1e-3;
  SpherePose ahead = pose;
  SpherePose behind = pose;
  ahead.rotary[index(axis) - 3] += kStepDeg;
  behind.rotary[index(axis) - 3] -= kStepDeg;
  return (on_table(behind, model, tool) - on_table(ahead, model, tool)) * (1 / (2 * kStepDeg));
}

}  // namespace

Vec3 on_table(const SpherePose& pose, const Kinematics& model, const MeasuringTool& tool) {
  const Vec3 in_machine = pose.nose + model.tool_vector(pose.rotary, tool.axis, tool.length);
  return model.table(pose.rotary).inverse().point(in_machine);
}

Spread spread(const PoseGroup& poses, const Kinematics& model, const MeasuringTool& tool) {
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
  const bool has_dispersion = poses.size() > 2;
  found.deviation = has_dispersion ? std::sqrt(squares / count) : 2 * norm(found.errors.front());
  return found;
}

KinematicsFit fit_kinematics(std::span<const PoseGroup> groups, const Kinematics& model,
                             const MeasuringTool& tool, std::span<const Axis> axes,
                             const FitOptions& options) {
  KinematicsFit found{
      .corrected = model, .errors = {}, .before = spreads(groups, model, tool), .after = {}};
  if (groups.empty()) return found;
  std::vector<Line> lines;
  std::vector<Unknown> unknowns;
  const bool own_groups = groups.size() == axes.size();
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const Vec3& sphere = found.before[own_groups ? k : 0].centre;
    const auto carrier = options.zeros ? carrier_of(model, axes, k) : std::nullopt;
    lines.push_back(line_of(*model.find(axes[k]), sphere, tool,
                            carrier ? model.find(axes[*carrier]) : nullptr));
    for (std::size_t side = 0; side < 2; ++side) {
      unknowns.push_back({k, ErrorKind::Location, side});
      if (!options.directions) continue;
      const bool is_zero = carrier && side == 0;
      unknowns.push_back(is_zero ? Unknown{*carrier, ErrorKind::Zero}
                                 : Unknown{k, ErrorKind::Direction, side});
    }
  }
  const AdjustedPoses poses{groups, model, tool, lines};
  while (!unknowns.empty() && drop_unseen(unknowns, Adjustment(poses, unknowns).seen())) {
  }
  std::optional<Adjustment> fit(std::in_place, poses, unknowns);
  fit->solve();
  found.errors = errors_of(*fit, model, lines);
  if (options.only_significant) {
    std::vector<AxisErrors> errors = found.errors;
    while (drop_insignificant(unknowns, errors)) {
      fit.emplace(poses, unknowns);
      fit->solve();
      errors = errors_of(*fit, model, lines);
    }
    mark_corrected(found.errors, unknowns);
  }
  found.is_corrected = !unknowns.empty();
  found.corrected = fit->corrected();
  found.after = spreads(groups, found.corrected, tool);
  return found;
}

double fit_backlash(const PoseGroup& from_below, const PoseGroup& from_above,
                    const Kinematics& model, const MeasuringTool& tool, Axis axis) {
  double products = 0;
  double squares = 0;
  for (std::size_t k = 0; k < from_below.size(); ++k) {
    // Movement of the place if the axis is not where it reports to be.
    const Vec3 per_degree = way_per_degree(from_below[k], model, tool, axis);
    const Vec3 way = on_table(from_above[k], model, tool) - on_table(from_below[k], model, tool);
    products += dot(per_degree, way);
    squares += dot(per_degree, per_degree);
  }
  return products / squares;
}

double mean_positioning_error(const PoseGroup& poses, const Kinematics& model,
                              const MeasuringTool& tool, Axis axis) {
  const Spread found = spread(poses, model, tool);
  double sum = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vec3 per_degree = way_per_degree(poses[k], model, tool, axis);
    const double squared = dot(per_degree, per_degree);
    if (squared > 0) sum += std::abs(dot(found.errors[k], per_degree)) / squared;
  }
  return sum / static_cast<double>(poses.size());
}

double measuring_radius(const Vec3& sphere, const RotaryAxis& axis, const MeasuringTool& tool) {
  const Line line = line_of(axis, sphere, tool);
  return norm(turning_point(sphere, axis, tool) - line.anchor);
}

}  // namespace fitgauge::probing
