#pragma once

#include "base/allowance.hpp"
#include "nc/machine/box_tree.hpp"
#include "nc/machine/machine_setup.hpp"

namespace fitgauge::machine {

/// The part on the table as a signed distance: features joined in order, bores removed from earlier
/// features. Coordinates are fixed to the table. Immutable: thread-safe.
class Workpiece {
 public:
  /// @pre validate() accepts the features.
  explicit Workpiece(const std::vector<Feature>& features);
  Workpiece(Workpiece&&) noexcept;
  Workpiece& operator=(Workpiece&&) noexcept;
  ~Workpiece();

  bool is_empty() const { return parts_.empty(); }

  /// Returns how far a ball of `radius` at `centre` can move in any direction without touching, in
  /// mm: the distance to the material minus the radius. Never more than the true value, and equal
  /// to it near contact; negative if the ball overlaps the material; infinity without material. The
  /// one inexact place is a corner of three faces inside the edge of a bore: there the value is too
  /// small.
  double clearance(const Vec3& centre, double radius) const;

  /// The way along the unit vector `direction`, at most `longest` mm, after which a ball that
  /// starts at `start` touches: to 1e-10 mm at normal incidence. Nothing when it does not touch; 0
  /// when it touches or overlaps at the start. Means nothing once `allowance` is spent.
  std::optional<double> contact(const Vec3& start, const Vec3& direction, double radius,
                                double longest, Allowance& allowance) const;
  std::optional<double> contact(const Vec3& start, const Vec3& direction, double radius,
                                double longest) const {
    Allowance unlimited;
    return contact(start, direction, radius, longest, unlimited);
  }
  /// Returns the unit vector away from the material nearest to `at`, to 1e-6; none on a ridge
  /// between two surfaces.
  std::optional<Vec3> normal(const Vec3& at) const;

 private:
  struct Part;

  void join(const Bore& bore);
  template <class Added>
  void join(const Added& feature);

  std::vector<Part> parts_;
  BoxTree tree_;  ///< of the parts, which are in its order
};

}  // namespace fitgauge::machine
