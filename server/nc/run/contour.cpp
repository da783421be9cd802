#include "nc/run/contour.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Path;

void set_sweep(Curve& curve) {
  if (!curve.is_arc()) return;
  curve.sweep_deg = sweep(curve.start, curve.end, *curve.centre, curve.is_left_turn());
}

Element along(const Curve& curve, const Element& before, const Feed& feed) {
  Element element{before.plane, curve, before.from, {}, feed, before.system, before.side};
  set_plane_target(element, curve.end);
  return element;
}

/// The end of a block's linear axes.
Vec3 end_of(const Element& element) { return moved({element.from, {}}, element.target).linear; }

/// A line seen in the plane of the arc it meets in a corner.
void turn_into_plane(Element& line, const WorkingPlane& plane) {
  if (line.curve.is_arc() || line.plane == plane) return;
  line.plane = plane;
  line.curve = {plane.project(line.from), plane.project(end_of(line))};
}

/// The direction of travel at the end of an element, if it moves.
std::optional<Vec3> end_direction(const Element& element) {
  if (element.curve.is_arc()) return element.plane.with({}, *element.curve.end_direction());
  const Vec3 travel = end_of(element) - element.from;
  if (!element.moves_in_plane() && norm(travel) < tolerance::kSamePoint) return std::nullopt;
  return travel;
}

NcError no_approach() {
  return nc_error(1024, "an SL cycle approaches its contour itself: remove APPR and DEP");
}

}  // namespace

WorkingPlane working_plane(const Machine& machine) {
  return WorkingPlane::across(machine.state().tool_axis());
}

void Contour::compensate(klartext::RadiusCompensation compensation) {
  if (compensation == klartext::RadiusCompensation::Unchanged) return;
  // Of R0, RL, RR, R+ and R-.
  constexpr int kSides[] = {0, 1, -1, 0, 0};
  constexpr int kLengthenings[] = {0, 0, 0, 1, -1};
  const std::size_t i = static_cast<std::size_t>(compensation) - 1;
  side_ = kSides[i];
  lengthening_ = kLengthenings[i];
}

Position Contour::position(const Machine& machine) const {
  Position position = drawing_ ? drawing_->position() : machine.position();
  if (beside_ && (cutter_.is_pending() || position == beside_->tool))
    position = beside_->programmed;
  const Element* last = approach_ ? &approach_->to_start : kept_ ? &*kept_ : nullptr;
  return last != nullptr ? moved(position, last->target) : position;
}

NcResult<void> Contour::move(Machine& machine, const Element& element) {
  auto done = CutterPath::move(machine, element);
  has_entered_part = has_entered_part || machine.has_entered_part();
  return done;
}

/// Passes an element to the cutter and stores the new end of the programmed path.
NcResult<void> Contour::cut(Machine& machine, const Element& element) {
  if (drawing_) return drawing_->add(element);
  const bool is_beside = element.side != 0 || cutter_.side() != 0;
  if (!is_beside && (is_shifted_ || element.shift != Vec3{})) return move_shifted(machine, element);
  if (!is_beside) return move(machine, element);
  Position programmed = moved(position(machine), element.target);
  programmed.linear = element.plane.with(programmed.linear, element.curve.end);
  TRY(cutter_.add(machine, element));
  has_entered_part = has_entered_part || machine.has_entered_part();
  beside_ = Beside{programmed, machine.position()};
  return {};
}

/// LN with DR: the tool is offset from the programmed path until a block without a normal.
NcResult<void> Contour::move_shifted(Machine& machine, Element element) {
  const Position programmed = moved(position(machine), element.target);
  for (std::size_t axis = 0; axis < 3; ++axis)
    element.target.values[axis] = programmed.linear[axis] + element.shift[axis];
  TRY(move(machine, element));
  beside_ = Beside{programmed, machine.position()};
  is_shifted_ = element.shift != Vec3{};
  return {};
}

NcResult<void> Contour::add(Machine& machine, Element element, bool corner_follows) {
  if (element.system != CoordinateSystem::Input) {
    if (drawing_) return nc_error("M91 and M92 are not allowed in the contour of an SL cycle");
    TRY(finish(machine));
    return move(machine, element);
  }
  if (element.side != 0 && !(element.plane == working_plane(machine))) {
    return nc_error(
        "RL and RR work only in the working plane: write R0 for a circle in another plane");
  }
  if (approach_) {
    TRY(approach(machine, element));
  } else if (kept_) {
    TRY(turn_corner(machine, element));
  }
  if (const auto end = end_direction(element)) direction = end;
  if (corner_follows) {
    set_plane_target(element, element.curve.end);
    kept_ = element;
    return {};
  }
  return cut(machine, element);
}

NcResult<void> Contour::set_corner(double size, bool is_chamfer, std::optional<Feed> feed) {
  if (!kept_) return nc_error(1022, "RND and CHF must be between two positioning blocks");
  if (size <= 0) return nc_error(1022, "the radius or length must be greater than 0");
  corner_ = Corner{size, is_chamfer, feed};
  return {};
}

/// Moves along the postponed element up to the corner and around it; `next` begins after it.
NcResult<void> Contour::turn_corner(Machine& machine, Element& next) {
  Element before = *std::exchange(kept_, std::nullopt);
  const auto corner = std::exchange(corner_, std::nullopt);
  if (!corner) return cut(machine, before);
  turn_into_plane(before, next.plane);
  turn_into_plane(next, before.plane);
  const auto arriving = before.curve.end_direction();
  const auto leaving = next.curve.start_direction();
  if (arriving && leaving && std::abs(cross(*arriving, *leaving)) < tolerance::kParallel &&
      dot(*arriving, *leaving) > 0) {
    return cut(machine, before);  // no corner
  }
  const auto between = !(before.plane == next.plane) ? std::nullopt
                       : corner->is_chamfer ? chamfer(before.curve, next.curve, corner->size)
                                            : rounding(before.curve, next.curve, corner->size);
  if (!between)
    return nc_error(corner->is_chamfer ? 1022 : 1023, "it does not fit between the two blocks");
  before.curve.end = between->start;
  set_sweep(before.curve);
  set_plane_target(before, between->start);
  next.curve.start = between->end;
  set_sweep(next.curve);
  next.from = next.plane.with(next.from, between->end);
  const Feed feed = corner->feed.value_or(before.feed);
  TRY(cut(machine, before));
  return cut(machine, along(*between, before, feed));
}

NcResult<void> Contour::add(Machine& machine, Approach approach) {
  if (drawing_) return no_approach();
  TRY(finish(machine));
  cutter_.leave();
  approach_ = approach;
  return {};
}

/// Moves the centre of the tool to the begin of the contour, which `next` continues.
NcResult<void> Contour::approach(Machine& machine, const Element& next) {
  const auto contour_direction = next.curve.start_direction();
  if (!contour_direction)
    return nc_error(1024, "the contour after APPR does not begin in the working plane");
  const Approach approach = *std::exchange(approach_, std::nullopt);
  const int side = approach.to_start.side;
  const double left = side < 0 ? -1 : 1;
  const double distance = side * CutterPath::radius(machine);
  const Vec2 first = approach.to_start.curve.end + left_of(*contour_direction) * distance;
  const double turn = left * approach.radius;
  const Vec2 centre = first + left_of(*contour_direction) * turn;
  Vec2 auxiliary = first;
  bool is_arc = false;
  switch (approach.path) {
    case Path::ApprLt: auxiliary = first - *contour_direction * approach.length; break;
    case Path::ApprLn:
      auxiliary = first + left_of(*contour_direction) * (left * approach.length);
      break;
    case Path::ApprCt:
      auxiliary = centre + turned(first - centre, turn > 0 ? -approach.angle : approach.angle);
      is_arc = true;
      break;
    default: {  // APPR LCT
      const Vec2 start = approach.to_start.curve.start;
      const auto met = tangent_point(start, centre, std::abs(turn), turn > 0);
      if (!met) return nc_error(1023, "the approach begins inside the circle of APPR LCT");
      auxiliary = *met;
      is_arc = true;
    }
  }
  Element to_auxiliary = approach.to_start;
  to_auxiliary.feed = approach.before;
  set_plane_target(to_auxiliary, auxiliary);
  TRY(move(machine, to_auxiliary));
  Curve to_first{auxiliary, first};
  if (is_arc) {
    to_first.centre = centre;
    to_first.sweep_deg = sweep(auxiliary, first, centre, turn > 0);
  }
  TRY(move(machine, along(to_first, approach.to_start, approach.to_start.feed)));
  if (side != 0) cutter_.begin(first, side);
  return {};
}

NcResult<Vec2> Contour::depart(Machine& machine, const WorkingPlane& plane) {
  if (drawing_) return no_approach();
  TRY(finish(machine));
  cutter_.leave();
  beside_.reset();
  return plane.project(machine.position().linear);
}

NcResult<void> Contour::finish(Machine& machine) {
  if (approach_) {
    approach_.reset();
    return nc_error(1024, "APPR must be followed by the first contour element");
  }
  if (kept_) {
    const Element last = *std::exchange(kept_, std::nullopt);
    if (std::exchange(corner_, std::nullopt))
      return nc_error(1022, "RND or CHF must be followed by a contour element");
    TRY(cut(machine, last));
  }
  if (!cutter_.is_pending()) return {};
  TRY(cutter_.finish(machine));
  if (beside_) beside_->tool = machine.position();
  return {};
}

}  // namespace fitgauge::interpreter
