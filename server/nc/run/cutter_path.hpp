#pragma once

#include <optional>
#include <vector>

#include "nc/run/element.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

/// Leads the centre of the cutter along a contour: on it, or with RL and RR at the tool's radius
/// (R + DR) and an allowance beside it. The path begins and ends square to the first and last point
/// of the contour, goes around outer corners on an arc, and meets inner corners where the two
/// offset curves cross. An element moves when the one after it in the plane is known.
class CutterPath {
 public:
  CutterPath() = default;
  /// @param allowance stays on the contour, in mm beside the tool's radius
  explicit CutterPath(double allowance) : allowance_(allowance) {}

  /// @errors 1003 the tool does not fit into a corner or arc; 1021 RL or RR begins with an arc.
  NcResult<void> add(machine::Machine& machine, const Element& next);
  /// Moves along what was kept, up to the point square to its end.
  NcResult<void> finish(machine::Machine& machine);
  /// The tool stands at the offset start of the contour that the next element begins (APPR).
  void begin(Vec2 centre, int side);
  /// The tool has left the contour (DEP).
  void leave() { *this = {}; }

  bool is_pending() const { return last_.has_value(); }
  int side() const { return side_; }

  /// Moves along an element as it is.
  static NcResult<void> move(machine::Machine& machine, const Element& element);
  static double radius(const machine::Machine& machine);

 private:
  NcResult<void> enter(machine::Machine& machine, const Element& next);
  NcResult<void> join(machine::Machine& machine, const Element& next);
  /// Moves along the kept element, which ends at `end` for the centre of the tool, and along what
  /// stood between it and the next one.
  NcResult<void> move_to(machine::Machine& machine, Vec2 end);

  /// From the contour to the centre of the cutter.
  double reach(const machine::Machine& machine) const { return radius(machine) + allowance_; }

  double allowance_ = 0;
  int side_ = 0;
  std::optional<Element> last_;
  bool is_entry_ = false;       ///< `last_` brings the tool to the contour
  Vec2 at_;                     ///< where the centre of the tool begins `last_`
  std::optional<Vec2> begun_;   ///< there it begins the next element
  std::vector<Element> aside_;  ///< moves outside of the plane, between `last_` and the next one
};

}  // namespace fitgauge::interpreter
