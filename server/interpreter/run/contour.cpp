#include "run/contour.hpp"

#include <utility>

#include "run/channel.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Path;

/// Whether RND or CHF is the next block that is not a comment.
bool corner_follows(const Channel& channel) {
  const auto blocks = channel.program().blocks();
  for (std::size_t i = channel.block + 1; i < blocks.size(); ++i) {
    const auto& statement = blocks[i].statement;
    if (std::holds_alternative<klartext::Empty>(statement) ||
        std::holds_alternative<klartext::Structure>(statement)) {
      continue;
    }
    const auto* motion = std::get_if<klartext::Motion>(&statement);
    if (motion == nullptr || (blocks[i].skip && channel.options.block_skip)) return false;
    return motion->path == Path::Rnd || motion->path == Path::Chf;
  }
  return false;
}

void set_plane_target(Element& element, const WorkingPlane& plane, Vec2 point) {
  element.target.values[plane.first] = point.x;
  element.target.values[plane.second] = point.y;
}

void set_sweep(Curve& curve) {
  if (!curve.is_arc()) return;
  curve.sweep_deg = sweep(curve.start, curve.end, *curve.centre, curve.is_left_turn());
}

Element along(const Curve& curve, const WorkingPlane& plane, const machine::Feed& feed) {
  Element element{curve, {}, feed};
  set_plane_target(element, plane, curve.end);
  return element;
}

}  // namespace

WorkingPlane working_plane(const Channel& channel) {
  return WorkingPlane::across(channel.machine().state().tool_axis());
}

machine::Position Contour::position(const Channel& channel) const {
  machine::Position position = channel.machine().position();
  const Element* last = approach_ ? &approach_->to_start : kept_ ? &*kept_ : nullptr;
  if (last != nullptr) {
    for (const machine::Axis axis : machine::kAllAxes) {
      if (const auto& value = last->target[axis]) position[axis] = *value;
    }
  }
  return position;
}

NcResult<void> Contour::move(Channel& channel, const Element& element) {
  machine::Machine& machine = channel.machine();
  if (!element.curve.is_arc()) {
    return checked(machine.move({element.target, element.feed, element.system}));
  }
  const WorkingPlane plane = working_plane(channel);
  machine::Vec3 end = plane.with(machine.position().linear, element.curve.end);
  const auto normal = machine::index(plane.normal);
  if (const auto& height = element.target.values[normal]) end[normal] = *height;
  return checked(machine.move_arc({end, plane.with(end, *element.curve.centre),
                                   element.curve.sweep_deg, plane.normal, element.feed}));
}

NcResult<void> Contour::add(Channel& channel, Element element) {
  if (element.system != machine::CoordinateSystem::Input) {
    if (auto done = finish(channel); !done) return done;
    return move(channel, element);
  }
  if (approach_) {
    const auto start = element.curve.start_direction();
    if (!start) return nc_error(1024, "the contour after APPR does not begin in the working plane");
    if (auto done = approach(channel, *start); !done) return done;
  } else if (kept_) {
    if (auto done = turn_corner(channel, element); !done) return done;
  }
  if (const auto end = element.curve.end_direction()) direction = end;
  if (corner_follows(channel)) {
    set_plane_target(element, working_plane(channel), element.curve.end);
    kept_ = element;
    return {};
  }
  return move(channel, element);
}

NcResult<void> Contour::set_corner(double size, bool is_chamfer,
                                   std::optional<machine::Feed> feed) {
  if (!kept_) return nc_error(1022, "RND and CHF stand between two positioning blocks");
  if (size <= 0) return nc_error(1022, "the radius or length must be greater than 0");
  corner_ = Corner{size, is_chamfer, feed};
  return {};
}

/// Moves along the kept element up to the corner and around it; `next` begins behind it.
NcResult<void> Contour::turn_corner(Channel& channel, Element& next) {
  Element before = *std::exchange(kept_, std::nullopt);
  const auto corner = std::exchange(corner_, std::nullopt);
  if (!corner) return move(channel, before);
  const auto arriving = before.curve.end_direction();
  const auto leaving = next.curve.start_direction();
  if (arriving && leaving && std::abs(cross(*arriving, *leaving)) < 1e-12 &&
      dot(*arriving, *leaving) > 0) {
    return move(channel, before);  // no corner
  }
  const auto between = corner->is_chamfer ? chamfer(before.curve, next.curve, corner->size)
                                          : rounding(before.curve, next.curve, corner->size);
  if (!between) {
    return nc_error(corner->is_chamfer ? 1022 : 1023, "it does not fit between the two blocks");
  }
  const WorkingPlane plane = working_plane(channel);
  before.curve.end = between->start;
  set_sweep(before.curve);
  set_plane_target(before, plane, between->start);
  next.curve.start = between->end;
  set_sweep(next.curve);
  const machine::Feed feed = corner->feed.value_or(before.feed);
  if (auto done = move(channel, before); !done) return done;
  return move(channel, along(*between, plane, feed));
}

NcResult<void> Contour::add(Channel& channel, Approach approach) {
  if (auto done = finish(channel); !done) return done;
  approach_ = approach;
  return {};
}

/// Moves to the first point of the contour, which goes on along `contour_direction`.
NcResult<void> Contour::approach(Channel& channel, Vec2 contour_direction) {
  const Approach approach = *std::exchange(approach_, std::nullopt);
  const WorkingPlane plane = working_plane(channel);
  const Vec2 first = approach.to_start.curve.end;
  const Vec2 centre = first + left_of(contour_direction) * (approach.side * approach.radius);
  const bool left_turn = approach.side > 0;
  Vec2 auxiliary = first;
  bool is_arc = false;
  switch (approach.path) {
    case Path::ApprLt: auxiliary = first - contour_direction * approach.length; break;
    case Path::ApprLn:
      auxiliary = first + left_of(contour_direction) * (approach.side * approach.length);
      break;
    case Path::ApprCt:
      auxiliary = centre + turned(first - centre, -approach.side * approach.angle);
      is_arc = true;
      break;
    default: {  // APPR LCT
      const auto met =
          tangent_point(approach.to_start.curve.start, centre, approach.radius, left_turn);
      if (!met) return nc_error(1023, "the approach begins inside the circle of APPR LCT");
      auxiliary = *met;
      is_arc = true;
    }
  }
  Element to_auxiliary = approach.to_start;
  set_plane_target(to_auxiliary, plane, auxiliary);
  if (auto done = move(channel, to_auxiliary); !done) return done;
  Curve to_first{auxiliary, first, std::nullopt, 0};
  if (is_arc) {
    to_first.centre = centre;
    to_first.sweep_deg = sweep(auxiliary, first, centre, left_turn);
  }
  return move(channel, along(to_first, plane, approach.to_start.feed));
}

NcResult<void> Contour::finish(Channel& channel) {
  if (approach_) {
    approach_.reset();
    return nc_error(1024, "APPR must be followed by the first contour element");
  }
  if (!kept_) return {};
  const Element last = *std::exchange(kept_, std::nullopt);
  if (std::exchange(corner_, std::nullopt)) {
    return nc_error(1022, "RND or CHF must be followed by a contour element");
  }
  return move(channel, last);
}

}  // namespace fitgauge::interpreter
