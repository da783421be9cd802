#pragma once

#include "nc/probing/kinematics/fit.hpp"
#include "nc/probing/touch/gauss_newton.hpp"

namespace fitgauge::probing {

/// mm: the lever at which a direction counts as much as a location.
inline constexpr double kLever = 100;

/// A fitted value in mm: a location or, at kLever, a direction of an axis, along one of its two
/// vectors, or at kLever its zero.
struct Unknown {
  std::size_t axis = 0;
  ErrorKind kind = ErrorKind::Location;
  std::size_t side = 0;
};

/// A rotary axis as a line through the height of the sphere, and two vectors across it.
struct Line {
  machine::RotaryAxis modelled;
  machine::Vec3 anchor;
  std::array<machine::Vec3, 2> across;
};

/// The point of the sphere (on a table) or of the ball (under a head) that turns around the axis.
machine::Vec3 turning_point(const machine::Vec3& sphere, const machine::RotaryAxis& axis,
                            const MeasuringTool& tool);
/// @param carrier the axis that carries it, if its zero is fitted: the first vector across then is
///   the way this axis turns with it
Line line_of(const machine::RotaryAxis& axis, const machine::Vec3& sphere,
             const MeasuringTool& tool, const machine::RotaryAxis* carrier = nullptr);

/// The input of one fit; the parts outlive it.
struct AdjustedPoses {
  std::span<const PoseGroup> groups;
  const machine::Kinematics& model;
  const MeasuringTool& tool;
  const std::vector<Line>& lines;
};

/// One fit of unknowns: their values, and the part that the positions determine. Not thread-safe;
/// lives within one fit.
class Adjustment {
 public:
  Adjustment(const AdjustedPoses& poses, std::vector<Unknown> unknowns);

  /// Returns for each unknown whether the positions determine it.
  std::vector<bool> seen() const;
  /// @pre all unknowns are seen.
  void solve();

  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  const Eigen::VectorXd& values() const { return values_; }
  machine::Kinematics corrected() const { return at(values_); }
  /// Returns the covariance of the unknowns, for centres of variance 1 in each coordinate.
  Eigen::MatrixXd covariance() const;
  /// Returns the number of residuals that are left to judge the scatter by.
  std::size_t freedom() const;
  /// The standard deviation of one coordinate of a centre; 0 without freedom.
  double scatter() const;

 private:
  machine::Kinematics at(const Eigen::VectorXd& values) const;
  Eigen::VectorXd residuals(const machine::Kinematics& model) const;
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& values) const;
  void decompose();

  AdjustedPoses poses_;
  std::vector<Unknown> unknowns_;
  Eigen::VectorXd values_;
  Directions directions_;  ///< of the unknowns, and how strongly the residuals show each
};

}  // namespace fitgauge::probing
