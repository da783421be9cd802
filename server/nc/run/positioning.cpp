#include "nc/klartext/block_reader.hpp"
#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Path;

/// Whether RND or CHF is the next block that is not a comment.
bool corner_follows(const Channel& channel) {
  const auto blocks = channel.program().blocks();
  for (std::size_t i = channel.block + 1; i < blocks.size(); ++i) {
    if (blocks[i].is<klartext::Empty, klartext::Structure>()) continue;
    const auto* motion = blocks[i].as<klartext::Motion>();
    if (motion == nullptr || (blocks[i].skip && channel.options.block_skip)) return false;
    return motion->path == Path::Rnd || motion->path == Path::Chf;
  }
  return false;
}

/// The geometry of one positioning block.
class Positioning {
 public:
  Positioning(Channel& channel, const klartext::Motion& motion, const MotionWords& words)
      : channel_(channel),
        motion_(motion),
        words_(words),
        position_(channel.contour.position(channel.machine())),
        plane_(plane()),
        start_(plane_.project(position_.linear)) {}

  NcResult<void> run() {
    switch (motion_.path) {
      case Path::Cc: return set_pole();
      case Path::Rnd: return contour().set_corner(words_.r.value_or(0), false, words_.feed);
      case Path::Chf: return contour().set_corner(words_.chamfer.value_or(0), true, words_.feed);
      case Path::L:
      case Path::Ln:
        if (words_.has_m(91) || words_.has_m(92)) return line_in(CoordinateSystem::Reference);
        if (words_.has_m(130) && channel_.state().frames.is_tilted())
          return line_in(CoordinateSystem::Workpiece);
        [[fallthrough]];
      case Path::Lp:
      case Path::Paraxial: return line();
      case Path::C:
      case Path::Cp:
      case Path::Cr:
      case Path::Ct:
      case Path::Ctp: return arc();
      case Path::DepLt:
      case Path::DepLn:
      case Path::DepCt:
      case Path::DepLct:
      case Path::DepPlct: return depart();
      default: return approach();
    }
  }

 private:
  Contour& contour() { return channel_.contour; }

  NcResult<Feed> block_feed() {
    if (contour().drawing() != nullptr) return Feed::rapid();
    const auto feed = use_feed(channel_, words_.feed);
    if (feed) contour().last_feed = *feed;
    return feed;
  }

  /// The axes the block names, absolute.
  AxisWords target(const Position& from) const {
    AxisWords target;
    for (const Axis axis : kAllAxes) {
      if (const auto& word = words_.axes[index(axis)]) target[axis] = word->after(from[axis]);
    }
    return target;
  }

  /// Returns the plane of the block: the pole's plane for polar coordinates and arcs around it, the
  /// plane of the two axes of CR or CT, and otherwise the working plane (decision 29).
  WorkingPlane plane() const {
    const auto& pole = channel_.contour.pole;
    if (pole && (is_polar() || motion_.path == Path::C)) return pole->plane;
    const WorkingPlane working = working_plane(channel_.machine());
    if (motion_.path != Path::Cr && motion_.path != Path::Ct) return working;
    const std::size_t tool_axis = index(working.normal);
    const bool first = words_.axes[working.first].has_value();
    const bool second = words_.axes[working.second].has_value();
    if (!words_.axes[tool_axis] || first == second) return working;
    return WorkingPlane::across(static_cast<Axis>(first ? working.second : working.first));
  }

  bool is_polar() const { return klartext::words_of(motion_.path).contains(Letter::Pr); }

  /// End of the block in the working plane. @errors no pole.
  NcResult<Vec2> end_point() {
    if (!is_polar()) {
      const auto words = target(position_);
      return Vec2{words.values[plane_.first].value_or(start_.x),
                  words.values[plane_.second].value_or(start_.y)};
    }
    if (!contour().pole) return nc_error("polar coordinates need a pole: write CC before them");
    if (motion_.path != Path::Cp && !words_.pr && !words_.pa) return start_;
    auto& last = contour().last_polar;
    const Vec2 pole = contour().pole->point;
    const Vec2 from_pole = start_ - pole;
    // Increments count from the position. Where it is the last polar one, its angle is known
    // better.
    Vec2 here{norm(from_pole), machine::degrees(std::atan2(from_pole.y, from_pole.x))};
    const bool is_there = last && norm(polar(last->x, last->y) - from_pole) < tolerance::kSamePoint;
    if (is_there && motion_.path != Path::Cp) here = *last;
    if (motion_.path != Path::Cp && !last && !(words_.pr && words_.pa)) {
      return nc_error(1017, words_.pr ? "the polar angle PA is missing: no block since CC has it"
                                      : "the polar radius PR is missing: no block since CC has it");
    }
    Vec2 end = motion_.path == Path::Cp || !last ? here : *last;
    if (words_.pr) end.x = words_.pr->after(here.x);
    if (words_.pa) end.y = words_.pa->after(here.y);
    last = end;
    return pole + polar(end.x, end.y);
  }

  NcResult<Element> element(const Curve& curve) {
    const auto feed = TRY(block_feed());
    Element element{plane_, curve, position_.linear, target(position_), feed};
    element.side = contour().side();
    if (is_polar()) set_plane_target(element, curve.end);
    return element;
  }

  NcResult<void> move_along(Element element) {
    return contour().add(channel_.machine(), std::move(element), corner_follows(channel_));
  }

  NcResult<void> add(const Curve& curve) {
    auto made = TRY(element(curve));
    return move_along(made);
  }

  /// A pole is no motion, so decision 3 applies to its coordinates.
  NcResult<void> set_pole() {
    for (const Word& word : channel_.program().view(motion_.words)) {
      if (!is_axis(word.letter) || is_absent(word.value)) continue;
      TRY(number(channel_, word.value));
    }
    std::array<bool, 3> named{};
    for (std::size_t axis = 0; axis < 3; ++axis) named[axis] = words_.axes[axis].has_value();
    const auto count = std::count(named.begin(), named.end(), true);
    if (count == 3) return nc_error("CC must have the two axes of a plane");
    const WorkingPlane working = working_plane(channel_.machine());
    const auto& before = contour().pole;
    Pole pole{working, {}};
    if (count == 2) {
      const std::size_t left_out = !named[0] ? 0 : !named[1] ? 1 : 2;
      pole.plane = WorkingPlane::across(static_cast<Axis>(left_out));
    } else if (count == 1 && before) {
      pole.plane = before->plane;
    }
    Vec3 point = position_.linear;
    if (count == 1 && before) point = pole.plane.with(point, before->point);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!named[axis]) continue;
      if (!pole.plane.contains(axis)) {
        return nc_error(
            1019,
            "the {} axis is not in the plane of the circle: write both axes of the plane in CC",
            "XYZ"[axis]);
      }
      point[axis] = words_.axes[axis]->after(position_.linear[axis]);
    }
    pole.point = pole.plane.project(point);
    contour().pole = pole;
    contour().last_polar = {};
    return {};
  }

  /// M91, M92: coordinates of the spindle nose from the machine datum.
  NcResult<void> line_in(CoordinateSystem system) {
    TRY(contour().finish(channel_.machine()));
    const auto feed = TRY(block_feed());
    const auto from = channel_.machine().position(system);
    return move_along({plane_, {}, from.linear, target(from), feed, system});
  }

  NcResult<void> line() {
    if (!words_.names_axes()) {
      // `L FMAX M99`, or every coordinate undefined: the feed may change, nothing moves.
      TRY(block_feed());
      return {};
    }
    const auto end = TRY(end_point());
    if (contour().lengthening() != 0 && motion_.path != Path::Ln) return lengthened_line(end);
    auto made = TRY(element({start_, end}));
    made.shift = TRY(shift_of_surface());
    const bool is_pieced = channel_.turns_along_vector && channel_.state().modes.tcpm;
    return is_pieced ? add_along_vector(made) : move_along(made);
  }

  /// PATHCTRL VECTOR: adds the line in pieces, if it turns the tool.
  NcResult<void> add_along_vector(const Element& line) {
    const MachineState& state = channel_.state();
    const Position end = moved(position_, line.target);
    const auto to_machine = [&](const Vec3& rotary) {
      return state.frames.rotary_to_machine(rotary, CoordinateSystem::Input);
    };
    const auto stops = TRY(
        vector_stops(state, to_machine(position_.rotary), to_machine(end.rotary), channel_.budget));
    if (stops.size() == 1) return move_along(line);
    const Vec3 shifted =
        contour().side() == 0 ? channel_.machine().position().linear - position_.linear : Vec3{};
    Element piece = line;
    for (const VectorStop& stop : stops) {
      const bool is_last = stop.part == 1;
      const Vec3 point =
          is_last ? end.linear : position_.linear + (end.linear - position_.linear) * stop.part;
      const Vec3 rotary = state.frames.rotary_from_machine(stop.rotary, CoordinateSystem::Input);
      for (std::size_t axis = 0; axis < 3; ++axis) piece.target.values[axis] = point[axis];
      for (const RotaryAxis& axis : state.kinematics.axes())
        piece.target[axis.axis] = rotary[index(axis.axis) - 3];
      piece.curve.end = plane_.project(point);
      piece.shift = shifted + (line.shift - shifted) * stop.part;
      if (is_last) break;
      TRY(contour().add(channel_.machine(), piece, false));
      piece.curve.start = piece.curve.end;
      piece.from = point;
    }
    return move_along(std::move(piece));
  }

  /// LN: from the programmed path, the tool's DR along the surface's normal.
  NcResult<Vec3> shift_of_surface() {
    const auto normal = TRY(vector_of(channel_, motion_, Letter::Nx));
    if (!normal || contour().side() != 0) return Vec3{};
    const MachineState& state = channel_.state();
    const Tool* tool = state.active_tool();
    const double oversize = state.tool.dr + (tool == nullptr ? 0 : tool->dr);
    return unit(*normal) * radius_in_plane(state, oversize);
  }

  /// R+ and R-: lengthens or shortens the move of each named axis of the plane by the tool radius.
  NcResult<void> lengthened_line(Vec2 end) {
    auto made = TRY(element({start_, end}));
    const double by = contour().lengthening() * CutterPath::radius(channel_.machine());
    for (const std::size_t axis : {plane_.first, plane_.second}) {
      auto& value = made.target.values[axis];
      const double travel = value ? *value - position_.linear[axis] : 0;
      if (travel != 0) *value += std::copysign(by, by * travel);
    }
    made.curve.end = plane_.project(plane_.with(position_.linear, end));
    return move_along(made);
  }

  NcResult<void> arc() {
    for (std::size_t axis = 3; axis < kAxes; ++axis) {
      if (words_.axes[axis]) return nc_error(1019, "a rotary axis cannot follow an arc");
    }
    const auto end = TRY(end_point());
    const auto curve =
        TRY(motion_.path == Path::Cr                                ? radius_arc(end)
            : motion_.path == Path::Ct || motion_.path == Path::Ctp ? tangential(end)
                                                                    : centre_arc(end));
    return add(curve);
  }

  bool left_turn() const { return motion_.rotation != klartext::Rotation::Negative; }

  NcResult<Curve> radius_arc(Vec2 end) const {
    if (!words_.r) return nc_error("CR needs a radius R");
    const auto arc = arc_of_radius(start_, end, *words_.r, left_turn());
    if (!arc) {
      return nc_error("CR: no arc of radius {} mm joins two points {:.4f} mm apart", *words_.r,
                      norm(end - start_));
    }
    return *arc;
  }

  NcResult<Curve> tangential(Vec2 end) {
    const auto direction = arriving();
    if (!direction) return nc_error("CT needs a contour element before it that it continues");
    return tangential_arc(start_, *direction, end);
  }

  /// The direction of travel at the end of the block before, in the plane of this one.
  std::optional<Vec2> arriving() {
    if (!contour().direction) return std::nullopt;
    const Vec2 in_plane = plane_.project(*contour().direction);
    if (norm(in_plane) < tolerance::kSamePoint) return std::nullopt;
    return unit(in_plane);
  }

  NcResult<Curve> centre_arc(Vec2 end) {
    if (!contour().pole) return nc_error("an arc needs a centre: write CC before it");
    const Vec2 centre = contour().pole->point;
    const double radius = norm(start_ - centre);
    if (radius < tolerance::kSamePoint) return nc_error("the arc must not begin in its centre");
    const double error = norm(end - centre) - radius;
    if (std::abs(error) > tolerance::kBesideCircle) {
      return nc_error(
          "the end of the arc is {:.4f} mm {} its circle in the plane {}{}: CC gives the "
          "centre, and its two axes give the plane",
          std::abs(error), error > 0 ? "outside" : "inside", "XYZ"[plane_.first],
          "XYZ"[plane_.second]);
    }
    if (motion_.path != Path::Cp || !words_.pa || !words_.pa->incremental)
      return Curve{start_, end, centre, sweep(start_, end, centre, left_turn())};
    // A sweep of 0 turns neither way.
    const double turn = words_.pa->value;
    if (turn != 0 && (turn > 0) != left_turn()) {
      return nc_error(1012, "IPA = {} turns {}: DR must have the same sign", turn,
                      turn > 0 ? "counter-clockwise" : "clockwise");
    }
    return Curve{start_, end, centre, turn};
  }

  NcResult<void> approach() {
    const auto end = TRY(end_point());
    const auto before = contour().last_feed;
    auto to_start = TRY(element({start_, end}));
    set_plane_target(to_start, end);
    // F of APPR LCT applies to its whole way, of the others to the second part.
    const bool is_whole = !before || cartesian() == Path::ApprLct;
    const Feed first_part = is_whole ? to_start.feed : *before;
    return contour().add(
        channel_.machine(),
        Contour::Approach{cartesian(), to_start, words_.len.value_or(0), words_.cca.value_or(0),
                          words_.r.value_or(0), first_part});
  }

  klartext::Path cartesian() const {
    static_assert(Path{static_cast<int>(Path::ApprLt) + 4} == Path::ApprPlt);
    const int behind = is_polar() ? 4 : 0;
    return static_cast<Path>(static_cast<int>(motion_.path) - behind);
  }

  NcResult<void> depart() {
    const auto travel = arriving();
    if (!travel) return nc_error("DEP needs a contour element before it");
    const double left_side = contour().side() < 0 ? -1 : 1;  // left without compensation
    const Vec2 from = TRY(contour().depart(channel_.machine(), plane_));
    contour().compensate(klartext::RadiusCompensation::R0);
    const Vec2 direction = *travel;
    const double length = words_.len.value_or(0);
    const double radius = words_.r.value_or(0);
    const Vec2 centre = from + left_of(direction) * (left_side * radius);
    const bool left = left_side > 0;
    switch (motion_.path) {
      case Path::DepLt: return leave({from, from + direction * length});
      case Path::DepLn: return leave({from, from + left_of(direction) * (left_side * length)});
      case Path::DepCt: {
        const double angle = std::copysign(words_.cca.value_or(0), left_side * radius);
        return leave({from, centre + turned(from - centre, angle), centre, angle});
      }
      default: break;
    }
    const auto end = TRY(end_point());
    // DEP LCT is APPR LCT run backwards: the circle turns the other way seen from the end.
    const auto met = tangent_point(end, centre, radius, !left);
    if (!met) return nc_error(1023, "DEP LCT ends inside its circle");
    TRY(leave({from, *met, centre, sweep(from, *met, centre, left)}));
    return add({*met, end});
  }

  /// A move only in the working plane.
  NcResult<void> leave(const Curve& curve) {
    const auto feed = TRY(block_feed());
    Element element{plane_, curve, channel_.machine().position().linear, {}, feed};
    set_plane_target(element, curve.end);
    return move_along(element);
  }

  Channel& channel_;
  const klartext::Motion& motion_;
  const MotionWords& words_;
  const Position position_;
  const WorkingPlane plane_;
  const Vec2 start_;
};

}  // namespace

NcResult<void> position(Channel& channel, const klartext::Motion& motion,
                        const MotionWords& words) {
  return Positioning(channel, motion, words).run();
}

}  // namespace fitgauge::interpreter
