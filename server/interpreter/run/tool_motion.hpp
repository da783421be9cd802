#pragma once

#include "machine/machine.hpp"
#include "run/nc_error.hpp"
#include "run/plane_geometry.hpp"

namespace fitgauge::interpreter {

class Channel;

/// The moves of a machining cycle: in the working plane, and at heights along the tool axis, in mm
/// of the input system. Each looks at the run's budget first;
/// a move to where the tool stands is none.
class ToolMotion {
 public:
  explicit ToolMotion(Channel& channel);

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
  double tool_radius() const;

 private:
  Channel& channel_;
  const WorkingPlane plane_;
};

}  // namespace fitgauge::interpreter
