#include "nc/run/cutter_path.hpp"

#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

/// Moves outside of the plane that wait for the next element of a contour.
constexpr std::size_t kMostAside = 32;

NcError too_large(double radius, Vec2 at, std::string_view where) {
  return nc_error(1003,
                  "a tool of radius {:.4f} mm does not fit into the {} at {:.4f}, "
                  "{:.4f}",
                  radius, where, at.x, at.y);
}

/// Whether the centre of the tool moves forward from `start` to `end` along an offset curve.
bool goes_forward(const Curve& curve, Vec2 start, Vec2 end) {
  if (!curve.is_arc())
    return dot(end - start, unit(curve.end - curve.start)) >= -tolerance::kNanometre;
  if (norm(end - start) < tolerance::kNanometre) return true;
  const double turn = sweep(start, end, *curve.centre, curve.is_left_turn());
  return std::abs(turn) <= std::abs(curve.sweep_deg) + tolerance::kNanometre;
}

void remove_plane_target(Element& element) {
  element.target.values[element.plane.first].reset();
  element.target.values[element.plane.second].reset();
}

constexpr int kLeastHalvings = 2;
constexpr int kMostHalvings = 12;

class VectorPath {
 public:
  VectorPath(const MachineState& state, const Vec3& from, const Vec3& to, RunBudget& budget)
      : state_(state),
        budget_(budget),
        first_(tool_at(from)),
        angle_deg_(machine::degrees(
            std::atan2(norm(cross(first_, tool_at(to))), dot(first_, tool_at(to))))),
        axis_(cross(first_, tool_at(to))) {}

  /// Without a plane: the tool does not turn, or it turns over.
  bool has_plane() const { return norm(axis_) > tolerance::kSameDirection; }

  NcResult<void> split(const VectorStop& begin, const VectorStop& end, int halvings) {
    TRY(budget_.check());
    VectorStop middle{(begin.part + end.part) / 2, (begin.rotary + end.rotary) * 0.5};
    const Vec3 tool = Matrix3::rotation(unit(axis_), angle_deg_ * middle.part) * first_;
    const bool is_near =
        norm(tool_at(middle.rotary) - tool) < machine::radians(tolerance::kToolVectorDeg);
    if (halvings == kMostHalvings || (halvings >= kLeastHalvings && is_near)) {
      stops.push_back(end);
      return {};
    }
    const auto rotary = rotary_along(state_, tool, middle.rotary);
    if (!rotary)
      return nc_error(1013, "PATHCTRL VECTOR: an axis does not reach a direction between the ends");
    middle.rotary = *rotary;
    TRY(split(begin, middle, halvings + 1));
    return split(middle, end, halvings + 1);
  }

  std::vector<VectorStop> stops;

 private:
  /// The direction of the tool on the table.
  Vec3 tool_at(const Vec3& rotary) const {
    return state_.kinematics.tool_on_table(rotary, state_.tool_axis());
  }

  const MachineState& state_;
  RunBudget& budget_;
  const Vec3 first_;
  const double angle_deg_;
  const Vec3 axis_;
};

}  // namespace

NcResult<void> check_scaling(const MachineState& state, const WorkingPlane& plane,
                             std::string_view what) {
  const Vec3 factor = state.frames.scaling().factor;
  if (factor[plane.first] == factor[plane.second]) return {};
  return nc_error(1108, "{} not available in a plane whose axes are scaled differently", what);
}

double CutterPath::radius(const Machine& machine) {
  return radius_in_plane(machine.state(), machine.state().tool_radius());
}

NcResult<void> CutterPath::move(Machine& machine, const Element& element) {
  if (!element.curve.is_arc()) return machine.move({element.target, element.feed, element.system});
  const WorkingPlane& plane = element.plane;
  TRY(check_scaling(machine.state(), plane, "an arc is"));
  Vec3 end = plane.with(machine.position().linear, element.curve.end);
  const auto normal = index(plane.normal);
  if (const auto& height = element.target.values[normal]) end[normal] = *height;
  return machine.move_arc({end, plane.with(end, *element.curve.centre), element.curve.sweep_deg,
                           plane.normal, element.feed});
}

void CutterPath::begin(Vec2 centre, int side) {
  side_ = side;
  begun_ = centre;
}

NcResult<void> CutterPath::add(Machine& machine, const Element& next) {
  if (next.side == 0 && side_ == 0) return move(machine, next);
  if (next.side != 0) TRY(check_scaling(machine.state(), next.plane, "RL and RR are"));
  if (!next.moves_in_plane() && next.side == side_) {
    Element beside = next;
    remove_plane_target(beside);
    if (!last_) return move(machine, beside);
    if (aside_.size() < kMostAside) {
      aside_.push_back(beside);
      return {};
    }
    TRY(finish(machine));
    return move(machine, beside);
  }
  if (next.side != side_) {
    if (next.side != 0 && side_ != 0)
      return nc_error(1021, "a block between RL and RR moves in the plane with R0: write RL or RR");
    TRY(finish(machine));
    side_ = next.side;
    if (side_ != 0) return enter(machine, next);
    Element leaving = next;
    if (next.moves_in_plane()) set_plane_target(leaving, next.curve.end);
    return move(machine, leaving);
  }
  return join(machine, next);
}

NcResult<void> CutterPath::enter(Machine& machine, const Element& next) {
  if (next.curve.is_arc()) return nc_error(1021, "RL and RR must begin with a straight block");
  if (!next.moves_in_plane()) return move(machine, next);
  last_ = next;
  is_entry_ = true;
  return {};
}

NcResult<void> CutterPath::join(Machine& machine, const Element& next) {
  const double distance = side_ * reach(machine);
  const auto leaving = next.curve.start_direction();  // the element moves in the plane
  if (const auto offset = offset_curve(next.curve, distance); !offset)
    return too_large(reach(machine), next.curve.end, "arc");
  const Vec2 corner = next.curve.start;
  Vec2 begin = corner + left_of(*leaving) * distance;
  if (begun_) {
    begin = *std::exchange(begun_, std::nullopt);
  } else if (!last_) {
    // After a block of another kind the tool is square to the previous element.
    Element across{next.plane, {corner, begin}, next.from, {}, next.feed};
    set_plane_target(across, begin);
    TRY(move(machine, across));
  } else if (is_entry_) {
    TRY(move_to(machine, begin));
  } else {
    const Vec2 arriving = *last_->curve.end_direction();
    const double turn = cross(arriving, *leaving);
    const bool is_straight =
        std::abs(turn) < tolerance::kSameDirection && dot(arriving, *leaving) > 0;
    if (!is_straight && turn * distance > 0) {
      const auto met = inner_corner(last_->curve, next.curve, distance);
      if (!met || !goes_forward(last_->curve, at_, *met))
        return too_large(reach(machine), corner, "corner");
      begin = *met;
      TRY(move_to(machine, begin));
    } else {
      const Vec2 end = corner + left_of(arriving) * distance;
      TRY(move_to(machine, end));
      if (!is_straight && norm(begin - end) > tolerance::kSamePoint) {
        Element around{next.plane,
                       {end, begin, corner, sweep(end, begin, corner, distance < 0)},
                       next.from,
                       {},
                       next.feed};
        TRY(move(machine, around));
      }
    }
  }
  last_ = next;
  is_entry_ = false;
  at_ = begin;
  return {};
}

NcResult<void> CutterPath::move_to(Machine& machine, Vec2 end) {
  Element element = *std::exchange(last_, std::nullopt);
  if (!is_entry_) {
    if (!goes_forward(element.curve, at_, end))
      return too_large(reach(machine), element.curve.end, "corner");
    element.curve.start = at_;
    element.curve.end = end;
    if (element.curve.is_arc()) {
      // Equal ends are a full circle only if the contour itself is one.
      element.curve.sweep_deg =
          norm(end - at_) < tolerance::kSamePoint && std::abs(element.curve.sweep_deg) < 360
              ? 0
              : whole_turns(element.curve.sweep_deg) +
                    sweep(at_, end, *element.curve.centre, element.curve.is_left_turn());
    }
  }
  set_plane_target(element, end);
  if (element.curve.is_arc() && element.curve.sweep_deg == 0) element.curve.centre.reset();
  TRY(move(machine, element));
  for (const Element& beside : std::exchange(aside_, {})) TRY(move(machine, beside));
  return {};
}

NcResult<void> CutterPath::finish(Machine& machine) {
  if (!last_) return {};
  const auto direction = last_->curve.end_direction();
  const Vec2 end = last_->curve.end + left_of(*direction) * (side_ * reach(machine));
  return move_to(machine, end);
}

NcResult<std::vector<VectorStop>> vector_stops(const MachineState& state, const Vec3& from,
                                               const Vec3& to, RunBudget& budget) {
  VectorPath path(state, from, to, budget);
  if (!path.has_plane()) return std::vector<VectorStop>{{1, to}};
  TRY(path.split({0, from}, {1, to}, 0));
  return std::move(path.stops);
}

}  // namespace fitgauge::interpreter
