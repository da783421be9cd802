#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

/// The enclosed area, positive when the curves go around it to the left.
double area(const std::vector<Curve>& curves) {
  double twice = 0;
  for (const Curve& curve : curves) {
    twice += cross(curve.start, curve.end);
    if (!curve.is_arc()) continue;
    const double radius = norm(curve.start - *curve.centre);
    const double turn = machine::radians(curve.sweep_deg);
    twice += radius * radius * (turn - std::sin(turn));  // between the arc and its chord
  }
  return twice / 2;
}

double length(const Curve& curve) {
  if (!curve.is_arc()) return norm(curve.end - curve.start);
  return norm(curve.start - *curve.centre) * std::abs(machine::radians(curve.sweep_deg));
}

std::vector<Curve> reversed(std::vector<Curve> curves) {
  std::reverse(curves.begin(), curves.end());
  for (Curve& curve : curves) {
    std::swap(curve.start, curve.end);
    curve.sweep_deg = -curve.sweep_deg;
  }
  return curves;
}

/// Intersection of two lines; none if one is an arc or they are parallel.
std::optional<Vec2> corner_of(const Curve& before, const Curve& after) {
  if (before.is_arc() || after.is_arc()) return std::nullopt;
  const Vec2 along = before.end - before.start;
  const Vec2 other = after.end - after.start;
  const double across = cross(along, other);
  if (std::abs(across) < tolerance::kParallel * norm(along) * norm(other)) return std::nullopt;
  return before.start + along * (cross(after.start - before.start, other) / across);
}

/// The curves without the arcs that shrink to nothing at `distance` to the left.
std::vector<Curve> with_sharp_corners(std::vector<Curve> curves, double distance) {
  std::vector<Curve> kept;
  std::size_t left = curves.size();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Curve& before = kept.empty() ? curves.back() : kept.back();
    Curve& after = i + 1 < curves.size() ? curves[i + 1] : kept.empty() ? curves[i] : kept.front();
    const bool vanishes = curves[i].is_arc() && left > 3 && !offset_curve(curves[i], distance);
    const auto corner = vanishes ? corner_of(before, after) : std::nullopt;
    if (corner) {
      before.end = after.start = *corner;
      --left;
    } else {
      kept.push_back(curves[i]);
    }
  }
  return kept;
}

/// Begins in the middle of the longest curve: every corner is then between two curves.
void begin_in_the_middle(std::vector<Curve>& curves) {
  const auto longest = std::max_element(
      curves.begin(), curves.end(),
      [](const Curve& a, const Curve& b) { return length(a) < length(b) - tolerance::kSamePoint; });
  std::rotate(curves.begin(), longest, curves.end());
  Curve last = curves.front();
  Curve& first = curves.front();
  first.sweep_deg = last.sweep_deg = first.sweep_deg / 2;
  const Vec2 middle = first.is_arc()
                          ? *first.centre + turned(first.start - *first.centre, first.sweep_deg)
                          : (first.start + first.end) * 0.5;
  last.end = first.start = middle;
  curves.push_back(last);
}

bool are_the_same(const Frames& a, const Frames& b) {
  return a.datum_shift() == b.datum_shift() && a.mirror() == b.mirror() &&
         a.rotation() == b.rotation() && a.scaling() == b.scaling();
}

/// Transformations apply only in the subprogram.
NcResult<SlDrawing> draw(Channel& channel, std::uint32_t label) {
  const auto first = channel.linked().label(std::to_string(label));
  if (!first) return nc_error(1024, "a contour label of cycle 14 is not defined in this program");
  const Frames frames = channel.state().frames;
  const Contour path = std::exchange(channel.contour, Contour());
  channel.contour.tool_feed = path.tool_feed;
  channel.contour.pole = path.pole;
  channel.contour.draw(channel.machine());
  auto done = execute_label(channel, *first);
  if (done) done = channel.contour.finish(channel.machine());
  if (!done) return done.error();
  SlDrawing drawing = *channel.contour.drawing();
  channel.contour = path;
  if (!are_the_same(channel.state().frames, frames)) TRY(channel.machine().set_frames(frames));
  return drawing;
}

}  // namespace

NcResult<SlContour> read_contour(Channel& channel, std::uint32_t label) {
  auto drawing = TRY(draw(channel, label));
  SlContour contour;
  contour.curves = drawing.curves();
  std::vector<Curve>& curves = contour.curves;
  if (!curves.empty()) {
    const Vec2 first = curves.front().start;
    const Vec2 last = curves.back().end;
    if (norm(first - last) > tolerance::kNanometre) curves.push_back({last, first});
  }
  const double enclosed = area(curves);
  if (std::abs(enclosed) < tolerance::kSamePoint)
    return nc_error(1024, "contour label {} encloses nothing", label);
  contour.is_pocket = drawing.side() * enclosed >= 0;
  return contour;
}

SlPath path_along(const SlContour& contour, double reach, bool is_climb) {
  SlPath path;
  path.curves = contour.curves;
  const bool goes_left = contour.is_pocket == is_climb;
  if ((area(path.curves) > 0) != goes_left) path.curves = reversed(std::move(path.curves));
  path.side = is_climb ? 1 : -1;
  path.curves = with_sharp_corners(std::move(path.curves), path.side * reach);
  begin_in_the_middle(path.curves);
  const Curve& first = path.curves.front();
  path.start = first.start + left_of(*first.start_direction()) * (path.side * reach);
  return path;
}

Position SlDrawing::position() const {
  Position position = machine_->position();
  position.linear = machine_->state().frames.from_machine(at_);
  return position;
}

NcResult<void> SlDrawing::add(const Element& element) {
  const WorkingPlane& plane = element.plane;
  if (!(plane == WorkingPlane::across(machine_->state().tool_axis())))
    return nc_error("the contour of an SL cycle must be in the working plane");
  const Frames& now = machine_->state().frames;
  const Vec3 from = now.from_machine(at_);
  const auto mapped = [&](Vec2 point) {
    return plane.project(begun_in_.from_machine(now.to_machine(plane.with(from, point))));
  };
  const bool names_plane =
      element.target.values[plane.first] || element.target.values[plane.second];
  at_ = now.to_machine(plane.with(from, element.curve.end));
  const Vec2 origin = mapped({});
  const double hand = std::copysign(
      1, cross(mapped({1, 0}) - origin, mapped({0, 1}) - origin));  // -1 in a mirrored system
  if (element.side != 0) side_ = element.side * static_cast<int>(hand);
  if (!has_begun_) {
    has_begun_ = names_plane;
    return {};
  }
  if (!element.moves_in_plane()) return {};
  if (element.curve.is_arc()) TRY(check_scaling(machine_->state(), plane, "an arc is"));
  Curve curve{mapped(element.curve.start), mapped(element.curve.end), std::nullopt,
              element.curve.sweep_deg * hand};
  if (element.curve.centre) curve.centre = mapped(*element.curve.centre);
  curves_.push_back(curve);
  return {};
}

}  // namespace fitgauge::interpreter
