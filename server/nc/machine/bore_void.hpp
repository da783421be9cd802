#pragma once

#include "nc/machine/machine_setup.hpp"
#include "nc/machine/solid.hpp"

namespace fitgauge::machine {

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

}  // namespace fitgauge::machine
