#include "nc/machine/machine.hpp"

namespace fitgauge::machine {

std::string_view name(MoveKind kind) { return word_of(kind, {"rapid", "feed", "probe", "arc"}); }

void Machine::trace(std::function<void(const TracedMove&)> keep, std::size_t longest) {
  keep_ = std::move(keep);
  left_ = longest;
}

MachineResult<void> Machine::move(const LinearMove& move) {
  const auto begun = begin();
  auto done = move_straight(move);
  if (begun) keep(move.feed.is_rapid ? MoveKind::Rapid : MoveKind::Feed, *begun, move.feed);
  return done;
}

MachineResult<void> Machine::move_arc(const ArcMove& arc) {
  const auto begun = begin();
  const auto kept = begun ? std::optional(traced(arc, *begun)) : std::nullopt;
  auto done = move_around(arc);
  if (begun) keep(MoveKind::Arc, *begun, arc.feed, kept);
  return done;
}

MachineResult<ContactPoint> Machine::probe(const ProbeMove& move) {
  const auto begun = begin();
  auto contact = touch(move);
  if (begun) keep_probing(*begun, move, contact);
  return contact;
}

std::optional<Machine::Begun> Machine::begin() const {
  if (!keep_) return std::nullopt;
  return Begun{state_.position(), machine_tip(), state_.elapsed_s};
}

void Machine::add(const TracedMove& move) {
  if (left_ == 0) {
    ++untraced_;
    return;
  }
  --left_;
  keep_(move);
}

void Machine::keep(MoveKind kind, const Begun& begun, const Feed& feed,
                   const std::optional<TracedArc>& arc) {
  const Position end = state_.position();
  const double seconds = state_.elapsed_s - begun.elapsed_s;
  if (seconds == 0 && end == begun.start) return;
  add({.kind = kind,
       .start = begun.start,
       .end = end,
       .feed_mm_min = feed.rate_on(state_.rapid_mm_min),
       .seconds = seconds,
       .machine_start = begun.machine_start,
       .machine_end = machine_tip(),
       .arc = arc});
}

/// An arc in the machine's coordinates, where a mirror turns it the other way round.
TracedArc Machine::traced(const ArcMove& arc, const Begun& begun) const {
  const Frames& frames = state_.frames;
  const std::size_t up = index(arc.normal);
  TracedArc traced{.centre = arc.centre, .sweep_deg = arc.sweep_deg, .axis = arc.normal};
  traced.centre[up] = begun.start.linear[up];
  traced.machine_centre = frames.to_machine(traced.centre);
  const auto direction = [&](Axis axis) {
    return frames.direction_to_machine(unit_vector(axis), CoordinateSystem::Input);
  };
  const auto next = [](Axis axis) { return static_cast<Axis>((index(axis) + 1) % 3); };
  traced.machine_axis = unit(cross(direction(next(arc.normal)), direction(next(next(arc.normal)))));
  return traced;
}

void Machine::keep_probing(const Begun& begun, const ProbeMove& move,
                           const MachineResult<ContactPoint>& result) {
  const Feed feed = Feed::at(move.feed);
  if (!result) {
    keep(MoveKind::Probe, begun, feed);
    return;
  }
  Position touching = begun.start;
  const double travelled = result->seconds * move.feed / 60;
  const Frames& frames = state_.frames;
  const Vec3 along = unit(frames.direction_to_machine(move.direction, move.system));
  touching.linear = frames.from_machine(frames.to_machine(begun.start.linear) + along * travelled);
  const Vec3 machine_touching = begun.machine_start + along * travelled;
  add({.kind = MoveKind::Probe,
       .start = begun.start,
       .end = touching,
       .feed_mm_min = move.feed,
       .seconds = result->seconds,
       .machine_start = begun.machine_start,
       .machine_end = machine_touching,
       .contact = TracedContact{.surface = result->surface,
                                .machine_surface = frames.to_machine(result->surface),
                                .normal = left_ == 0 ? std::nullopt : contact_normal()}});
  keep(move.retract_feed.is_rapid ? MoveKind::Rapid : MoveKind::Feed,
       {touching, machine_touching, begun.elapsed_s + result->seconds}, move.retract_feed);
}

}  // namespace fitgauge::machine
