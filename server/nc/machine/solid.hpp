#pragma once

#include "base/allowance.hpp"
#include "nc/machine/box_tree.hpp"
#include "nc/machine/machine_setup.hpp"
#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {

/// A signed distance to a boundary and its gradient, a unit vector away from the material: the
/// nearest point of the boundary is `at - distance * gradient`.
struct Field {
  double distance = 0;  ///< in mm, negative inside the material
  Vec3 gradient{0, 0, 1};

  Vec3 foot(const Vec3& at) const { return at - gradient * distance; }
};

/// Material that a feature adds. Immutable: thread-safe.
struct Solid {
  /// The distance is exact outside; inside it is negative and exact wherever the nearest boundary
  /// is a face.
  std::function<Field(const Vec3& at)> field;
  /// Box around the material; infinite if the material is.
  Box box;
  /// Whether `contact` is not exact, so that the path must be traced step by step.
  bool is_traced = false;
  /// As `contact`, of a body that is not convex.
  std::function<std::optional<double>(const BallPath& ball)> own_contact{};

  /// Returns the distance until the ball touches, 0 if it touches at the start. The distance to a
  /// convex body is convex along a line, so Newton's steps never pass the contact: one for a face,
  /// a few for a rounding.
  std::optional<double> contact(const BallPath& ball) const;
};

Solid solid_of(const Block& block);
Solid solid_of(const Boss& boss);
Solid solid_of(const Plane& plane);
Solid solid_of(const Sphere& sphere);
/// The material below a measured surface: the triangles of its points and the walls that fall from
/// their hull. @pre not all points are on one line in X and Y.
Solid solid_of(const Surface& surface);
/// The inside of a closed mesh whose triangles run counter-clockwise seen from outside. @pre the
/// mesh has its body.
Solid solid_of(const Mesh& mesh);

/// The void of a bore: a cone (cylinder without taper) with lobes around a tilted axis, open
/// upwards, closed by a flat bottom. Its fields measure the material around it: positive inside the
/// void. Immutable: thread-safe.
class BoreVoid {
 public:
  explicit BoreVoid(const Bore& bore);

  /// Distance to the wall, exact on both sides.
  Field wall(const Vec3& at) const;
  /// Distance to the bottom plane.
  Field floor(const Vec3& at) const;
  /// A lower bound of the distance to the wall, below it by at most `roughness`.
  double wall_bound(const Vec3& at) const;
  /// The largest error of `wall_bound`, in mm: 0 for a bore without lobes.
  double roughness() const { return 2 * amplitude_; }

  /// Returns how far a ball in the void can move along the unit vector `direction` until it touches
  /// wall or bottom: of a cylinder the solution of a quadratic. 0 if the ball is not in the void
  /// with room around it, or the bore has lobes or taper.
  /// @param with_floor whether there is material below the bottom
  double way_inside(const Vec3& centre, const Vec3& direction, double radius,
                    bool with_floor) const;

  /// Box around the void, extended up and down without end; everything if it is tilted or tapered.
  Box box() const;
  /// The highest z of the bottom.
  double floor_top() const;

 private:
  struct Local;  ///< a point in the coordinates of the bore

  Local local(const Vec3& at) const;
  double nearest_angle(const Local& point) const;

  Vec3 opening_;
  Matrix3 to_local_;
  Matrix3 from_local_;
  double depth_;
  double radius_;
  double amplitude_;  ///< 0 or more; a negative amplitude is a phase
  double lobes_;
  double phase_;   ///< radians
  double slope_;   ///< change of the radius per mm of depth
  double cosine_;  ///< of the cone's half angle
};

/// Step for a ball of `radius` in mm: an edge is rounded with at least this radius, so a dip within
/// one step is shallower than kSamePoint.
inline double least_step(double radius) {
  constexpr double kSmallest = 0.1;
  return std::sqrt(8 * std::max(radius, kSmallest) * tolerance::kSamePoint);
}

/// Returns the first zero of `value` on [0, longest], to a value of kContact.
/// @pre `value` changes no faster than its argument, a distance along a path: then a step of the
/// length of the value never passes a zero. Next to a wall or at a slant such steps become short.
/// They are lengthened to `step_at_least`, so the search may miss a narrower dip below zero.
/// @param allowance ends a search of too many steps, as along a wall. The result is then not
/// valid.
template <class Value>
std::optional<double> first_zero(const Value& value, double longest, double step_at_least,
                                 Allowance& allowance) {
  double low = 0;
  double at_low = value(low);
  if (at_low <= tolerance::kContact) return low;
  bool is_slow = false;
  for (unsigned steps = 1; low < longest; ++steps) {
    constexpr unsigned kBetweenLooks = 16;
    if (steps % kBetweenLooks == 0 && allowance.is_spent()) return std::nullopt;
    const double step = is_slow ? std::max(at_low, step_at_least) : at_low;
    double high = std::min(low + step, longest);
    double at_high = value(high);
    if (at_high > tolerance::kContact) {
      is_slow = at_high > at_low / 2;
      low = high;
      at_low = at_high;
      continue;
    }
    // Regula falsi with halved ends (Illinois): the zero is within one least step.
    constexpr int kSteps = 100;
    for (int round = 0; round < kSteps && at_high < -tolerance::kContact; ++round) {
      const double next = high - at_high * (high - low) / (at_high - at_low);
      const double at_next = value(next);
      if (std::abs(at_next) <= tolerance::kContact) return next;
      if (at_next > 0) {
        low = next;
        at_low = at_next;
        at_high /= 2;
      } else {
        high = next;
        at_high = at_next;
        at_low /= 2;
      }
      if (high - low < tolerance::kRounding) break;
    }
    return high;
  }
  return std::nullopt;
}

}  // namespace fitgauge::machine
