#include "nc/machine/control.hpp"

namespace fitgauge::machine {

MachineResult<ContactPoint> Control::probe(const ProbeMove& move) {
  if (!state_.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  if (state_.active_tool() == nullptr) return make_fault(FaultKind::NoTool);
  TRY(check_feed(Feed::at(move.feed)));
  TRY(check_feed(move.retract_feed));
  const Vec3 along = state_.frames.direction_to_machine(move.direction, move.system);
  const double retract = move.retract.value_or(0);
  TRY(require(is_finite(along) && norm(along) != 0 && std::isfinite(move.distance) &&
                  move.distance > 0 && std::isfinite(retract) && retract >= 0,
              "a probing move needs a direction and a distance"));
  if (!axes_->capabilities().probes) {
    return make_fault(FaultKind::OptionMissing, "the machine has no probe input");
  }
  const Vec3 direction = unit(along);
  const double reachable = reach(direction, move.distance);
  const Position start = state_.nose;
  const auto contact = axes_->probe(direction, reachable, motion(Feed::at(move.feed)));
  const bool is_missed = !contact && contact.error().kind == FaultKind::NoContact;
  stand_at(contact ? *contact : axes_->nose());
  if (!contact && !is_missed) return contact.error();

  const double way = is_missed ? reachable : dot(contact->linear - start.linear, direction);
  const double seconds = seconds_of(way, Feed::at(move.feed));
  spend(seconds);
  if (is_missed && reachable < move.distance) {
    return check_range(
               {state_.nose.linear + direction * (move.distance - reachable), state_.nose.rotary})
        .error();
  }
  if (is_missed) return contact.error();

  ContactPoint point = contact_point(direction);
  point.seconds = seconds;
  TRY(go_back(start, direction, move));
  return point;
}

/// The way back, at most to the start, is free, since the ball came along it.
MachineResult<void> Control::go_back(const Position& start, const Vec3& direction,
                                     const ProbeMove& move) {
  const Position contact = state_.nose;
  const double way = dot(contact.linear - start.linear, direction);
  const double back = move.retract.value_or(way);
  const Position free =
      back < way ? Position{contact.linear - direction * back, contact.rotary} : start;
  // The axes may have stopped beyond the contact.
  return travel(straight_path(axes_->nose(), free), move.retract_feed, true);
}

/// Returns the distance that the nose can move along `direction` inside its ranges, at most
/// `distance`.
double Control::reach(const Vec3& direction, double distance) const {
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const auto& range = state_.ranges[index(axis)];
    const double part = direction[index(axis)];
    if (!range || part == 0) continue;
    const double end = part > 0 ? range->max : range->min;
    distance = std::min(distance, std::max((end - state_.nose[axis]) / part, 0.0));
  }
  return distance;
}

ContactPoint Control::contact_point(const Vec3& direction) const {
  const Frames& frames = state_.frames;
  Vec3 centre = state_.ball_centre(CoordinateSystem::Machine);
  if (const auto probe = state_.probe_system()) {
    centre = centre + probe->centre_offset(state_.tool_axis(), state_.modes.spindle_deg);
  }
  ContactPoint point;
  point.tip_machine =
      centre - state_.tool_direction(CoordinateSystem::Machine) * state_.tool_radius();
  point.tip = frames.from_machine(point.tip_machine);
  point.ball_centre = frames.from_machine(centre);
  point.surface = frames.from_machine(centre + direction * state_.tool_radius());
  point.nose = state_.nose;
  return point;
}

}  // namespace fitgauge::machine
