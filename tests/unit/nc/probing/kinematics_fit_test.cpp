#include "nc/probing/kinematics/fit.hpp"

#include <doctest/doctest.h>

#include "kinds.hpp"
#include "nc/machine/random.hpp"
#include "support/deep.hpp"

/// Random machines of nine kinds, whose spheres are touched by geometry that is written down here
/// once more. One fit of all axes finds every error; the old order of axes does not.
namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::AxisMount;
using machine::Kinematics;
using machine::RotaryAxis;
using machine::Vec3;

const MeasuringTool kProbe{Axis::Z, 118};

/// Rodrigues' formula.
Vec3 turned(const Vec3& v, const Vec3& k, double degrees) {
  const double t = degrees * std::acos(-1.0) / 180;
  return v * std::cos(t) + cross(k, v) * std::sin(t) + k * (dot(k, v) * (1 - std::cos(t)));
}

using Rests = std::array<Vec3, 3>;

/// A machine as its axes really are, bed to workpiece, then column to tool.
struct RealMachine {
  std::vector<RotaryAxis> axes;
  Vec3 zero_deg;  ///< by how much each is turned where it shows 0

  /// What X, Y, Z show with the ball in the sphere. @param rests of A, B, C: where they came to
  /// rest.
  Vec3 nose(Vec3 sphere, const Vec3& rotary, const Rests& rests = {}) const {
    Vec3 ball{0, 0, -kProbe.length};
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
      const std::size_t letter = index(axis->axis) - 3;
      const bool table = axis->mount == AxisMount::Table;
      Vec3& point = table ? sphere : ball;
      const double shown = rotary[letter] + zero_deg[letter];
      const double angle = table ? -shown : shown;
      point = turned(point - axis->centre, axis->direction, angle) + axis->centre + rests[letter];
    }
    return sphere - ball;
  }
};

std::uint64_t fit_seeds() { return static_cast<std::uint64_t>(rounds(27, 1'000)); }

/// What is planted beside errors of location.
struct Planted {
  bool tilts = false;
  bool zeros = false;
};

/// A machine, what the control takes it for, and how it is measured.
class FitCase {
 public:
  FitCase(std::uint64_t seed, Planted planted) : random_(seed) {
    const auto& kinds = kinds_of_machines();
    for (const auto& [axis, mount] : kinds[seed % kinds.size()]) {
      const std::size_t letter = index(axis) - 3;
      RotaryAxis drawn{.axis = axis, .mount = mount, .centre = within(20), .direction = {}};
      drawn.direction[letter] = 1;
      modelled_.push_back(drawn);
      RotaryAxis real = drawn;
      real.centre = real.centre + within(0.3);
      if (planted.tilts) real.direction = unit(real.direction + within(0.004));
      real_.axes.push_back(real);
      // Away from 0, where the ball would lie on an axis of a fork.
      incidence_[letter] = (random_.normal() < 0 ? -1 : 1) * (25 + 8 * std::abs(within(3).x));
    }
    sphere_ = Vec3{60, 25, 40} + within(30);
    if (planted.zeros) real_.zero_deg = within(0.1);
  }

  Vec3 within(double limit) {
    const auto number = [&] { return limit * std::remainder(random_.normal() * 7, 2.0); };
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }

  Kinematics model() const { return Kinematics(modelled_); }
  std::vector<Axis> axes() const {
    std::vector<Axis> all;
    for (const RotaryAxis& axis : modelled_) all.push_back(axis.axis);
    std::ranges::sort(all);
    return all;
  }
  const RealMachine& real() const { return real_; }
  const Vec3& sphere() const { return sphere_; }

  SpherePose touched(const Vec3& rotary, const Rests& rests = {}) const {
    return {rotary, real_.nose(sphere_, rotary, rests)};
  }

  /// @param scatter of where each axis comes to rest when it turns, in mm.
  std::vector<PoseGroup> measured(double scatter = 0) {
    std::vector<PoseGroup> groups;
    for (const Axis axis : axes()) {
      PoseGroup& group = groups.emplace_back();
      const std::size_t letter = index(axis) - 3;
      Rests rests;
      for (Vec3& rest : rests) rest = scattered(scatter);
      for (const double position : {0.0, -75.0, -40.0, 35.0, 70.0, 95.0}) {
        Vec3 rotary = incidence_;
        rotary[letter] = position;
        rests[letter] = scattered(scatter);
        group.push_back(touched(rotary, rests));
      }
    }
    return groups;
  }

  /// How far the places of the sphere at ten unmeasured poses lie apart by that model.
  double seen_elsewhere(const Kinematics& model) {
    PoseGroup elsewhere;
    for (int k = 0; k < 10; ++k) {
      Vec3 rotary;
      for (const Axis axis : axes()) rotary[index(axis) - 3] = within(110).x;
      elsewhere.push_back(touched(rotary));
    }
    return spread(elsewhere, model, kProbe).deviation;
  }

  /// Along the line of the real axis, how far the modelled one is away beside the sphere or ball.
  Vec3 location_error(Axis axis) const {
    const auto is = [axis](const RotaryAxis& known) { return known.axis == axis; };
    const RotaryAxis& drawn = *std::ranges::find_if(modelled_, is);
    const RotaryAxis& real = *std::ranges::find_if(real_.axes, is);
    const Vec3 away = real.centre - drawn.centre;
    return away - drawn.direction * dot(away, drawn.direction);
  }

 private:
  Vec3 scattered(double scatter) {
    const double x = scatter * random_.normal();
    const double y = scatter * random_.normal();
    return {x, y, scatter * random_.normal()};
  }

  machine::Random random_;
  std::vector<RotaryAxis> modelled_;
  RealMachine real_;
  Vec3 incidence_;
  Vec3 sphere_;
};

/// What 451 did before: one axis after the other, tables, then heads from the column on.
Kinematics one_after_the_other(const std::vector<PoseGroup>& groups, const std::vector<Axis>& axes,
                               Kinematics model) {
  const std::vector<RotaryAxis> order = model.axes();
  for (const RotaryAxis& known : order) {
    const auto at = static_cast<std::size_t>(std::ranges::find(axes, known.axis) - axes.begin());
    model = fit_kinematics(std::span(&groups[at], 1), model, kProbe, std::array{known.axis},
                           {.directions = false})
                .corrected;
  }
  return model;
}

}  // namespace

TEST_CASE("locations of any machine are found at once, at poses that nobody measured too") {
  int wrong_by_old_order = 0;
  for (std::uint64_t seed = 1; seed <= fit_seeds(); ++seed) {
    CAPTURE(seed);
    FitCase c(seed, {});
    const auto groups = c.measured();
    const auto axes = c.axes();
    const KinematicsFit fit =
        fit_kinematics(groups, c.model(), kProbe, axes, {.directions = false});
    CHECK(c.seen_elsewhere(c.model()) > 1e-2);
    CHECK(c.seen_elsewhere(fit.corrected) < 1e-6);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      REQUIRE(fit.errors[k].location().has_value());
      CHECK(norm(fit.errors[k].location()->value - c.location_error(axes[k])) < 1e-6);
      CHECK(fit.after[k].deviation < 1e-7);
    }
    const Kinematics old = one_after_the_other(groups, axes, c.model());
    if (c.seen_elsewhere(old) > 1e-3) ++wrong_by_old_order;
  }
  CHECK(wrong_by_old_order > static_cast<int>(fit_seeds()) / 4);
}

TEST_CASE("directions are found with the locations") {
  for (std::uint64_t seed = 1; seed <= fit_seeds(); ++seed) {
    CAPTURE(seed);
    FitCase c(seed, {.tilts = true});
    const auto groups = c.measured();
    const KinematicsFit fit = fit_kinematics(groups, c.model(), kProbe, c.axes(), {});
    CHECK(c.seen_elsewhere(fit.corrected) < 1e-6);
    // Without them the dispersion that is left is known, and the next check finds just that.
    const KinematicsFit located =
        fit_kinematics(groups, c.model(), kProbe, c.axes(), {.directions = false});
    const KinematicsFit next =
        fit_kinematics(c.measured(), located.corrected, kProbe, c.axes(), {});
    for (std::size_t k = 0; k < groups.size(); ++k) {
      CHECK(std::abs(next.before[k].deviation - located.after[k].deviation) < 1e-9);
    }
  }
}

TEST_CASE("zeros of axes that carry others are found with the rest") {
  int found = 0;
  int wrong_by_locations = 0;
  for (std::uint64_t seed = 1; seed <= fit_seeds(); ++seed) {
    CAPTURE(seed);
    FitCase c(seed, {.tilts = true, .zeros = true});
    const auto groups = c.measured();
    const auto fitted = [&](FitCase& of, const FitOptions& options) {
      return fit_kinematics(of.measured(), of.model(), kProbe, of.axes(), options);
    };
    const KinematicsFit fit = fitted(c, {.zeros = true});
    CHECK(c.seen_elsewhere(fit.corrected) < 1e-6);
    // What it promises is what the next check finds.
    const KinematicsFit next = fit_kinematics(groups, fit.corrected, kProbe, c.axes(), {});
    for (std::size_t k = 0; k < groups.size(); ++k) {
      CHECK(std::abs(next.before[k].deviation - fit.after[k].deviation) < 1e-9);
    }
    wrong_by_locations += c.seen_elsewhere(fitted(c, {.directions = false}).corrected) > 1e-3;
    // Where no axis is tilted itself, the tilt it seems to have is its carrier's zero.
    FitCase straight(seed, {.zeros = true});
    for (const AxisErrors& errors : fitted(straight, {.zeros = true}).errors) {
      if (!errors[ErrorKind::Zero]) continue;
      ++found;
      Vec3 planted;
      const std::size_t letter = index(errors.axis) - 3;
      planted[letter] = straight.real().zero_deg[letter];
      CHECK(norm(errors[ErrorKind::Zero]->value - planted) < 1e-6);
    }
  }
  CHECK(wrong_by_locations > static_cast<int>(fit_seeds()) * 9 / 10);
  CHECK(found > static_cast<int>(fit_seeds()) / 2);
}

TEST_CASE("with a scatter of 1 um the claimed uncertainty covers 95 %") {
  int claims = 0;
  int covered = 0;
  int half_covered = 0;
  for (std::uint64_t seed = 1; seed <= 2 * fit_seeds(); ++seed) {
    FitCase c(seed, {});
    const auto axes = c.axes();
    const KinematicsFit fit =
        fit_kinematics(c.measured(0.001), c.model(), kProbe, axes, {.directions = false});
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const FoundError& found = *fit.errors[k].location();
      const Vec3 planted = c.location_error(axes[k]);
      if (norm(planted) > 0.02) CHECK(found.is_significant);
      const Vec3 off = found.value - planted;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis == index(axes[k]) - 3) continue;  // along the axis
        ++claims;
        covered += std::abs(off[axis]) <= found.uncertainty[axis];
        half_covered += std::abs(off[axis]) <= found.uncertainty[axis] / 2;
      }
    }
  }
  // Three standard deviations of a binomial count.
  const double part = static_cast<double>(covered) / claims;
  CAPTURE(part);
  CHECK(part > 0.95 - 3 * std::sqrt(0.95 * 0.05 / claims));
  CHECK(part < 0.99);
  CHECK(half_covered < 0.8 * claims);
}

TEST_CASE("an error below twice its uncertainty is left as it is") {
  FitCase c(1, {});
  const auto groups = c.measured(0.05);
  const auto axes = c.axes();
  const Kinematics right = Kinematics(c.real().axes);
  const KinematicsFit fit = fit_kinematics(groups, right, kProbe, axes, {.only_significant = true});
  CHECK_FALSE(fit.is_corrected);
  CHECK(fit.corrected == right);
  const KinematicsFit all = fit_kinematics(groups, right, kProbe, axes, {});
  CHECK(all.is_corrected);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    CHECK(fit.errors[k].location()->size == all.errors[k].location()->size);
    CHECK(fit.errors[k].location()->size < 2 * fit.errors[k].location()->standard_uncertainty);
  }
}

}  // namespace fitgauge::probing
