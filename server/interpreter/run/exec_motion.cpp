#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "machine/tolerance.hpp"
#include "run/channel.hpp"
#include "run/m_functions.hpp"
#include "run/motion_words.hpp"
#include "run/statements.hpp"
#include "run/tool_orientation.hpp"
#include "run/values.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Motion;
using klartext::Path;
using klartext::RadiusCompensation;
using machine::CoordinateSystem;

/// Whether RND or CHF is the next block that is not a comment.
bool corner_follows(const Channel& channel) {
  const auto blocks = channel.program().blocks();
  for (std::size_t i = channel.block + 1; i < blocks.size(); ++i) {
    const auto& statement = blocks[i].statement;
    if (std::holds_alternative<klartext::Empty>(statement) ||
        std::holds_alternative<klartext::Structure>(statement)) {
      continue;
    }
    const auto* motion = std::get_if<Motion>(&statement);
    if (motion == nullptr || (blocks[i].skip && channel.options.block_skip)) return false;
    return motion->path == Path::Rnd || motion->path == Path::Chf;
  }
  return false;
}

/// The geometry of one positioning block.
class Positioning {
 public:
  Positioning(Channel& channel, const Motion& motion, const MotionWords& words)
      : channel_(channel),
        motion_(motion),
        words_(words),
        position_(channel.contour.position(channel.machine())),
        plane_(plane()),
        start_(plane_.project(position_.linear)) {}

  NcResult<void> run() {
    switch (motion_.path) {
      case Path::Cc: return set_pole();
      case Path::Rnd: return corner(words_.r, false);
      case Path::Chf: return corner(words_.chamfer, true);
      case Path::L:
      case Path::Ln:
        if (words_.has_m(91) || words_.has_m(92)) return machine_line();
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

  NcResult<machine::Feed> block_feed() {
    if (contour().drawing() != nullptr) return machine::Feed::rapid();
    const auto feed = use_feed(channel_, words_.feed);
    if (feed) contour().last_feed = *feed;
    return feed;
  }

  static double resolved(const Coordinate& word, double last) {
    return word.incremental ? last + word.value : word.value;
  }

  /// The axes the block names, absolute.
  machine::AxisWords target(const machine::Position& from) const {
    machine::AxisWords target;
    for (const machine::Axis axis : machine::kAllAxes) {
      if (const auto& word = words_.axes[machine::index(axis)]) {
        target[axis] = resolved(*word, from[axis]);
      }
    }
    return target;
  }

  /// The plane of the block: that of the pole for polar coordinates and arcs around it, that of
  /// the two axes a CR or CT names, else the working plane (decision 29).
  WorkingPlane plane() const {
    const auto& pole = channel_.contour.pole;
    if (pole && (is_polar() || motion_.path == Path::C)) return pole->plane;
    const WorkingPlane working = working_plane(channel_.machine());
    if (motion_.path != Path::Cr && motion_.path != Path::Ct) return working;
    const std::size_t tool_axis = machine::index(working.normal);
    const bool first = words_.axes[working.first].has_value();
    const bool second = words_.axes[working.second].has_value();
    if (!words_.axes[tool_axis] || first == second) return working;
    return WorkingPlane::spanned_by(tool_axis, first ? working.first : working.second);
  }

  bool is_polar() const {
    switch (motion_.path) {
      case Path::Lp:
      case Path::Cp:
      case Path::Ctp:
      case Path::ApprPlt:
      case Path::ApprPln:
      case Path::ApprPct:
      case Path::ApprPlct:
      case Path::DepPlct: return true;
      default: return false;
    }
  }

  /// Where the block ends in the working plane. @errors no pole.
  NcResult<Vec2> end_point() {
    if (!is_polar()) {
      const auto words = target(position_);
      return Vec2{words.values[plane_.first].value_or(start_.x),
                  words.values[plane_.second].value_or(start_.y)};
    }
    if (!contour().pole) return nc_error("polar coordinates need a pole: CC stands before them");
    Vec2& last = contour().last_polar;
    const Vec2 pole = contour().pole->point;
    const Vec2 from_pole = start_ - pole;
    if (motion_.path == Path::Cp) {
      last = {norm(from_pole), machine::degrees(std::atan2(from_pole.y, from_pole.x))};
    }
    if (words_.pr) last.x = resolved(*words_.pr, last.x);
    if (words_.pa) last.y = resolved(*words_.pa, last.y);
    return pole + polar(last.x, last.y);
  }

  NcResult<Element> element(const Curve& curve) {
    const auto feed = block_feed();
    if (!feed) return feed.error();
    Element element{plane_, curve, position_.linear, target(position_), *feed};
    element.side = contour().side();
    if (is_polar()) set_plane_target(element, curve.end);
    return element;
  }

  NcResult<void> move_along(Element element) {
    return contour().add(channel_.machine(), std::move(element), corner_follows(channel_));
  }

  NcResult<void> add(const Curve& curve) {
    auto made = element(curve);
    if (!made) return made.error();
    return move_along(*std::move(made));
  }

  /// A pole is not moved to, so decision 3 holds for its coordinates.
  NcResult<void> set_pole() {
    for (const klartext::Word& word : channel_.program().view(motion_.words)) {
      if (!is_axis(word.letter) || is_absent(word.value)) continue;
      if (const auto value = number(channel_, word.value); !value) return value.error();
    }
    std::array<bool, 3> named{};
    for (std::size_t axis = 0; axis < 3; ++axis) named[axis] = words_.axes[axis].has_value();
    const auto count = std::count(named.begin(), named.end(), true);
    if (count == 3) return nc_error("CC names the two axes of a plane, not three");
    const WorkingPlane working = working_plane(channel_.machine());
    const auto& before = contour().pole;
    Pole pole{working, {}};
    if (count == 2) {
      const std::size_t left_out = !named[0] ? 0 : !named[1] ? 1 : 2;
      pole.plane = WorkingPlane::across(static_cast<machine::Axis>(left_out));
    } else if (count == 1 && before) {
      pole.plane = before->plane;
    }
    machine::Vec3 point = position_.linear;
    if (count == 1 && before) point = pole.plane.with(point, before->point);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!named[axis]) continue;
      if (!pole.plane.contains(axis)) {
        return nc_error(1019, fmt::format("the {} axis does not lie in the plane of the circle; CC "
                                          "names both of its axes",
                                          "XYZ"[axis]));
      }
      point[axis] = resolved(*words_.axes[axis], position_.linear[axis]);
    }
    pole.point = pole.plane.project(point);
    contour().pole = pole;
    contour().last_polar = {};
    return {};
  }

  NcResult<void> corner(const std::optional<double>& size, bool is_chamfer) {
    return contour().set_corner(size.value_or(0), is_chamfer, words_.feed);
  }

  /// M91, M92: coordinates of the spindle nose from the machine datum.
  NcResult<void> machine_line() {
    if (auto done = contour().finish(channel_.machine()); !done) return done;
    const auto feed = block_feed();
    if (!feed) return feed.error();
    const auto from = channel_.machine().position(CoordinateSystem::Reference);
    return move_along({plane_, {}, from.linear, target(from), *feed, CoordinateSystem::Reference});
  }

  NcResult<void> line() {
    if (!words_.names_axes()) {
      // `L FMAX M99`, or every coordinate undefined: the feed may change, nothing moves.
      const auto feed = block_feed();
      return feed ? NcResult<void>() : feed.error();
    }
    const auto end = end_point();
    if (!end) return end.error();
    if (contour().lengthening() != 0 && motion_.path != Path::Ln) return lengthened_line(*end);
    return add({start_, *end, std::nullopt, 0});
  }

  /// R+ and R-: each named axis of the plane goes on, or stops short, by the tool's radius.
  NcResult<void> lengthened_line(Vec2 end) {
    auto made = element({start_, end, std::nullopt, 0});
    if (!made) return made.error();
    const double by = contour().lengthening() * CutterPath::radius(channel_.machine());
    for (const std::size_t axis : {plane_.first, plane_.second}) {
      auto& value = made->target.values[axis];
      const double travel = value ? *value - position_.linear[axis] : 0;
      if (travel != 0) *value += std::copysign(by, by * travel);
    }
    made->curve.end = plane_.project(plane_.with(position_.linear, end));
    return move_along(*std::move(made));
  }

  NcResult<void> arc() {
    for (std::size_t axis = 3; axis < machine::kAxes; ++axis) {
      if (words_.axes[axis]) return nc_error(1019, "a rotary axis cannot follow an arc");
    }
    const auto end = end_point();
    if (!end) return end.error();
    const auto curve = motion_.path == Path::Cr                                ? radius_arc(*end)
                       : motion_.path == Path::Ct || motion_.path == Path::Ctp ? tangential(*end)
                                                                               : centre_arc(*end);
    if (!curve) return curve.error();
    return add(*curve);
  }

  bool left_turn() const { return motion_.rotation != klartext::Rotation::Negative; }

  NcResult<Curve> radius_arc(Vec2 end) const {
    if (!words_.r) return nc_error("CR needs a radius R");
    const auto arc = arc_of_radius(start_, end, *words_.r, left_turn());
    if (!arc) {
      return nc_error(fmt::format("CR: no arc of radius {} mm joins two points {:.4f} mm apart",
                                  *words_.r, norm(end - start_)));
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
    if (!contour().pole) return nc_error("an arc needs a centre: CC stands before it");
    const Vec2 centre = contour().pole->point;
    const double radius = norm(start_ - centre);
    if (radius < tolerance::kSamePoint) return nc_error("the arc begins in its centre");
    const double error = norm(end - centre) - radius;
    if (std::abs(error) > tolerance::kBesideCircle) {
      return nc_error(fmt::format(
          "the end of the arc lies {:.4f} mm {} its circle in the plane {}{}: CC names the centre "
          "and by its two axes the plane",
          std::abs(error), error > 0 ? "outside" : "inside", "XYZ"[plane_.first],
          "XYZ"[plane_.second]));
    }
    double turn = sweep(start_, end, centre, left_turn());
    if (motion_.path == Path::Cp && words_.pa && words_.pa->incremental) {
      const double angle = std::abs(words_.pa->value);
      turn = left_turn() ? angle : -angle;
    }
    return Curve{start_, end, centre, turn};
  }

  /// Where the tool is when no compensation says it: on the left.
  double side() const { return channel_.contour.side() < 0 ? -1 : 1; }

  NcResult<void> approach() {
    const auto end = end_point();
    if (!end) return end.error();
    const auto before = contour().last_feed;
    auto to_start = element({start_, *end, std::nullopt, 0});
    if (!to_start) return to_start.error();
    set_plane_target(*to_start, *end);
    // F of APPR LCT is that of its whole way, of the others that of its second part.
    const bool is_whole = !before || cartesian() == Path::ApprLct;
    const machine::Feed first_part = is_whole ? to_start->feed : *before;
    return contour().add(
        channel_.machine(),
        Contour::Approach{cartesian(), *std::move(to_start), words_.len.value_or(0),
                          words_.cca.value_or(0), words_.r.value_or(0), first_part});
  }

  Path cartesian() const {
    switch (motion_.path) {
      case Path::ApprPlt: return Path::ApprLt;
      case Path::ApprPln: return Path::ApprLn;
      case Path::ApprPct: return Path::ApprCt;
      case Path::ApprPlct: return Path::ApprLct;
      default: return motion_.path;
    }
  }

  NcResult<void> depart() {
    const auto travel = arriving();
    if (!travel) return nc_error("DEP needs a contour element before it");
    const double left_side = side();
    const auto tool = contour().depart(channel_.machine(), plane_);
    if (!tool) return tool.error();
    contour().compensate(RadiusCompensation::R0);
    const Vec2 from = *tool;
    const Vec2 direction = *travel;
    const double length = words_.len.value_or(0);
    const double radius = words_.r.value_or(0);
    const Vec2 centre = from + left_of(direction) * (left_side * radius);
    const bool left = left_side > 0;
    switch (motion_.path) {
      case Path::DepLt: return leave({from, from + direction * length, std::nullopt, 0});
      case Path::DepLn:
        return leave({from, from + left_of(direction) * (left_side * length), std::nullopt, 0});
      case Path::DepCt: {
        const double angle = std::copysign(words_.cca.value_or(0), left_side * radius);
        return leave({from, centre + turned(from - centre, angle), centre, angle});
      }
      default: break;
    }
    const auto end = end_point();
    if (!end) return end.error();
    // DEP LCT is APPR LCT run backwards: the circle turns the other way seen from the end.
    const auto met = tangent_point(*end, centre, radius, !left);
    if (!met) return nc_error(1023, "DEP LCT ends inside its circle");
    if (auto done = leave({from, *met, centre, sweep(from, *met, centre, left)}); !done) {
      return done;
    }
    return add({*met, *end, std::nullopt, 0});
  }

  /// A move of the working plane alone.
  NcResult<void> leave(const Curve& curve) {
    const auto feed = block_feed();
    if (!feed) return feed.error();
    Element element{plane_, curve, channel_.machine().position().linear, {}, *feed};
    set_plane_target(element, curve.end);
    return move_along(element);
  }

  Channel& channel_;
  const Motion& motion_;
  const MotionWords& words_;
  const machine::Position position_;
  const WorkingPlane plane_;
  const Vec2 start_;
};

/// What the control takes into account and the simulated machine does not.
NcResult<void> note_what_has_no_effect(Channel& channel, const Motion& motion,
                                       const MotionWords& words) {
  if (words.has_m(92)) {
    auto noted = channel.note("M92 counts from the machine datum, as M91: the setup has no second");
    if (!noted) return noted;
  }
  if (motion.path != Path::Ln) return {};
  const auto view = channel.program().view(motion.words);
  const bool has_normal = std::any_of(view.begin(), view.end(), [](const klartext::Word& word) {
    return word.letter >= klartext::Letter::Nx && word.letter <= klartext::Letter::Nz;
  });
  const machine::Tool* tool = channel.machine().state().active_tool();
  const double oversize = channel.machine().state().tool.dr + (tool == nullptr ? 0 : tool->dr);
  if (oversize == 0 || !has_normal) return {};
  return channel.note("LN: DR does not move the path along the normal NX NY NZ");
}

}  // namespace

NcResult<Next> execute(Channel& channel, const Motion& motion) {
  auto words = read_words(channel, motion.words);
  if (!words) return words.error();
  channel.contour.compensate(motion.compensation);
  if (channel.contour.drawing() != nullptr) {
    if (auto done = Positioning(channel, motion, *words).run(); !done) return done.error();
    return Next{};
  }
  if (auto noted = note_what_has_no_effect(channel, motion, *words); !noted) return noted.error();
  if (auto done = start_m_functions(channel, words->m); !done) return done.error();
  if (auto done = orient_tool(channel, motion, *words); !done) return done.error();
  if (auto done = Positioning(channel, motion, *words).run(); !done) return done.error();
  return end_m_functions(channel, *words);
}

NcResult<Next> execute(Channel& channel, const klartext::MFunctions& functions) {
  const auto words = read_words(channel, functions.words);
  if (!words) return words.error();
  if (channel.contour.drawing() != nullptr) return Next{};
  if (auto done = start_m_functions(channel, words->m); !done) return done.error();
  return end_m_functions(channel, *words);
}

NcResult<Next> execute(Channel& channel, const klartext::Stop& stop) {
  const auto words = read_words(channel, stop.words);
  if (!words) return words.error();
  if (auto done = start_m_functions(channel, words->m); !done) return done.error();
  auto next = end_m_functions(channel, *words);
  if (!next || next->kind != Next::Kind::Block) return next;
  if (auto done = channel.programmed_stop("programmed stop"); !done) return done.error();
  return next;
}

}  // namespace fitgauge::interpreter
