#include "nc/run/tool_motion.hpp"

#include <cmath>

#include "nc/machine/tolerance.hpp"

namespace fitgauge::interpreter {

ToolMotion::ToolMotion(machine::Machine& machine, RunBudget& budget)
    : machine_(machine),
      budget_(budget),
      plane_(WorkingPlane::across(machine.state().tool_axis())) {}

NcResult<void> ToolMotion::to_height(double height, const machine::Feed& feed) {
  if (auto allowed = budget_.check(); !allowed) return allowed;
  if (std::abs(height - this->height()) < tolerance::kSamePoint) return {};
  machine::AxisWords target;
  target[plane_.normal] = height;
  return checked(machine_.move({target, feed}));
}

NcResult<void> ToolMotion::to_point(Vec2 point, const machine::Feed& feed) {
  if (auto allowed = budget_.check(); !allowed) return allowed;
  if (norm(point - this->point()) < tolerance::kSamePoint) return {};
  machine::AxisWords target;
  target.values[plane_.first] = point.x;
  target.values[plane_.second] = point.y;
  return checked(machine_.move({target, feed}));
}

NcResult<void> ToolMotion::arc(Vec2 centre, Vec2 end, double sweep_deg, double height,
                               const machine::Feed& feed) {
  if (auto allowed = budget_.check(); !allowed) return allowed;
  machine::Vec3 target = plane_.with(machine_.position().linear, end);
  target[machine::index(plane_.normal)] = height;
  return checked(
      machine_.move_arc({target, plane_.with(target, centre), sweep_deg, plane_.normal, feed}));
}

NcResult<void> ToolMotion::dwell(double seconds) {
  if (auto allowed = budget_.check(); !allowed) return allowed;
  return seconds > 0 ? checked(machine_.dwell(seconds)) : NcResult<void>();
}

Vec2 ToolMotion::point() const { return plane_.project(machine_.position().linear); }

double ToolMotion::height() const {
  return machine_.position().linear[machine::index(plane_.normal)];
}

}  // namespace fitgauge::interpreter
