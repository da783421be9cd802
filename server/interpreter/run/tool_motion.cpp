#include "run/tool_motion.hpp"

#include <cmath>

#include "machine/tolerance.hpp"
#include "run/channel.hpp"

namespace fitgauge::interpreter {

ToolMotion::ToolMotion(Channel& channel)
    : channel_(channel), plane_(WorkingPlane::across(channel.machine().state().tool_axis())) {}

NcResult<void> ToolMotion::to_height(double height, const machine::Feed& feed) {
  if (auto allowed = channel_.budget.check(); !allowed) return allowed;
  if (std::abs(height - this->height()) < tolerance::kSamePoint) return {};
  machine::AxisWords target;
  target[plane_.normal] = height;
  return checked(channel_.machine().move({target, feed}));
}

NcResult<void> ToolMotion::to_point(Vec2 point, const machine::Feed& feed) {
  if (auto allowed = channel_.budget.check(); !allowed) return allowed;
  if (norm(point - this->point()) < tolerance::kSamePoint) return {};
  machine::AxisWords target;
  target.values[plane_.first] = point.x;
  target.values[plane_.second] = point.y;
  return checked(channel_.machine().move({target, feed}));
}

NcResult<void> ToolMotion::arc(Vec2 centre, Vec2 end, double sweep_deg, double height,
                               const machine::Feed& feed) {
  if (auto allowed = channel_.budget.check(); !allowed) return allowed;
  machine::Vec3 target = plane_.with(channel_.machine().position().linear, end);
  target[machine::index(plane_.normal)] = height;
  return checked(channel_.machine().move_arc(
      {target, plane_.with(target, centre), sweep_deg, plane_.normal, feed}));
}

NcResult<void> ToolMotion::dwell(double seconds) {
  if (auto allowed = channel_.budget.check(); !allowed) return allowed;
  return seconds > 0 ? checked(channel_.machine().dwell(seconds)) : NcResult<void>();
}

Vec2 ToolMotion::point() const { return plane_.project(channel_.machine().position().linear); }

double ToolMotion::height() const {
  return channel_.machine().position().linear[machine::index(plane_.normal)];
}

double ToolMotion::tool_radius() const { return channel_.machine().state().tool_radius(); }

}  // namespace fitgauge::interpreter
