#pragma once

#include "nc/machine/machine.hpp"
#include "nc/run/element.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/plane_geometry.hpp"
#include "nc/run/run_budget.hpp"

namespace fitgauge::interpreter {

/// The moves of a machining cycle: in the working plane, and at heights along the tool axis, in mm
/// of the input system. Each looks at the run's budget first;
/// a move to where the tool stands is none.
class ToolMotion {
 public:
  /// Both must outlive this object. The plane is that of the tool in the spindle now.
  ToolMotion(machine::Machine& machine, RunBudget& budget);

  NcResult<void> to_height(double height, const machine::Feed& feed);
  NcResult<void> to_point(Vec2 point, const machine::Feed& feed);
  /// Around `centre` to `end` and to `height`; a sweep beyond 360 degrees is a helix.
  NcResult<void> arc(Vec2 centre, Vec2 end, double sweep_deg, double height,
                     const machine::Feed& feed);
  /// Nothing for 0.
  NcResult<void> dwell(double seconds);

  Vec2 point() const;
  double height() const;
  const WorkingPlane& plane() const { return plane_; }
  const machine::MachineState& state() const { return machine_.state(); }
  /// In the plane: scaling does not scale the tool.
  double tool_radius() const { return radius_in_plane(state(), state().tool_radius()); }

 private:
  machine::Machine& machine_;
  RunBudget& budget_;
  const WorkingPlane plane_;
};

}  // namespace fitgauge::interpreter
