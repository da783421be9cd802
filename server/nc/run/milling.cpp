#include "nc/run/machining.hpp"

/// Pockets, slots, bores and threads: the finished contour of the centre of the tool at each depth.
namespace fitgauge::interpreter {
namespace {

/// Counter-clockwise inside for climb milling, which M3 and Q351 = 1 ask for.
double turn_inside(const Machining& cycle) { return cycle.value(351) < 0 ? -1 : 1; }

/// The rest at the side: the allowance when only roughing.
double side_allowance(const Machining& cycle) {
  return cycle.value(215) == 1 ? cycle.value(368) : 0;
}

double bottom_of(const Machining& cycle) {
  return cycle.heights.bottom + (cycle.value(215) == 1 ? cycle.value(369) : 0);
}

/// Calls `mill` at each depth, after plunging at `where`.
template <class Mill>
NcResult<void> at_each_depth(Machining& cycle, Vec2 where, const Mill& mill) {
  const double bottom = bottom_of(cycle);
  const double infeed = cycle.value(202) > 0 ? cycle.value(202) : std::abs(cycle.value(201));
  TRY(cycle.start());
  for (double depth = cycle.heights.surface; depth > bottom;) {
    const double next = depth - bottom <= infeed ? bottom : depth - infeed;
    if (next == depth) return nc_error(1011, "the plunging depth Q202 is too small");
    depth = next;
    TRY(cycle.to_point(where, cycle.feed(207)));
    TRY(cycle.to_height(depth, cycle.feed(206)));
    TRY(mill(depth));
  }
  TRY(cycle.to_height(cycle.heights.clearance, Feed::rapid()));
  return cycle.leave();
}

/// A closed contour of lines and corner arcs, in a local system.
struct Outline {
  Vec2 origin;
  double rotation_deg = 0;
  Vec2 at(Vec2 point) const { return origin + turned(point, rotation_deg); }
};

/// A rectangle of half sides `a`, `b` and corner radius `corner`, from and to the middle of its
/// right side; `turn`: 1 counter-clockwise, -1 clockwise.
NcResult<void> go_around(Machining& cycle, const Outline& outline, double a, double b,
                         double corner, double height, double turn) {
  const Feed feed = cycle.feed(207);
  TRY(cycle.to_point(outline.at({a, 0}), feed));
  // The corners in the order of a counter-clockwise turn; clockwise is its image in the main axis.
  constexpr std::array<Vec2, 4> kCorners{Vec2{1, 1}, Vec2{-1, 1}, Vec2{-1, -1}, Vec2{1, -1}};
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const Vec2 sign = kCorners[i];
    const Vec2 point{sign.x * a, sign.y * b};
    const Vec2 centre{sign.x * (a - corner), sign.y * (b - corner)};
    const bool arrives_along_y = i % 2 == 0;
    const Vec2 first = arrives_along_y ? Vec2{point.x, centre.y} : Vec2{centre.x, point.y};
    const Vec2 last = arrives_along_y ? Vec2{centre.x, point.y} : Vec2{point.x, centre.y};
    const auto placed = [&](Vec2 p) { return outline.at({p.x, p.y * turn}); };
    TRY(cycle.to_point(placed(first), feed));
    if (corner <= tolerance::kSamePoint) continue;
    TRY(cycle.arc(placed(centre), placed(last), turn * 90, height, feed));
  }
  return cycle.to_point(outline.at({a, 0}), feed);
}

/// A pocket or slot: back to its middle after each round.
NcResult<void> mill_inside(Machining& cycle, const Outline& outline, double a, double b,
                           double corner) {
  return at_each_depth(cycle, outline.origin, [&](double depth) -> NcResult<void> {
    TRY(go_around(cycle, outline, a, b, corner, depth, turn_inside(cycle)));
    return cycle.to_point(outline.origin, cycle.feed(207));
  });
}

NcResult<void> full_circle(Machining& cycle, Vec2 centre, double radius, double height) {
  const Vec2 start = centre + Vec2{radius, 0};
  TRY(cycle.to_point(start, cycle.feed(207)));
  TRY(cycle.arc(centre, start, turn_inside(cycle) * 360, height, cycle.feed(207)));
  return cycle.to_point(centre, cycle.feed(207));
}

/// Q367: the place of the tool on the figure.
std::size_t place_of(const Machining& cycle, double last) {
  return static_cast<std::size_t>(std::clamp(cycle.value(367), 0.0, last));
}

/// The offset of the figure's centre from the tool position.
Vec2 rectangle_centre(const Machining& cycle, double half_length, double half_width) {
  constexpr std::array<Vec2, 5> kSigns{Vec2{0, 0}, Vec2{1, 1}, Vec2{-1, 1}, Vec2{-1, -1},
                                       Vec2{1, -1}};
  const Vec2 sign = kSigns[place_of(cycle, 4)];
  return {sign.x * half_length, sign.y * half_width};
}

NcError does_not_fit(int number, double radius) {
  return nc_error(number, "the tool has a radius of " + std::to_string(radius) + " mm");
}

/// From the centre onto a circle and back, on half circles of half its radius. @param turn has the
/// sign of the way around, so that both are tangents.
NcResult<void> onto_circle(Machining& cycle, Vec2 centre, Vec2 point, double turn, double height,
                           const Feed& feed) {
  return cycle.arc((centre + point) * 0.5, point, std::copysign(180, turn), height, feed);
}
NcResult<void> off_circle(Machining& cycle, Vec2 centre, double turn, double height,
                          const Feed& feed) {
  const Vec2 middle = (centre + cycle.point()) * 0.5;
  return cycle.arc(middle, centre, std::copysign(180, turn), height, feed);
}

/// The allowance at the side of a stud: blocks without Q215 are of controls that leave the
/// allowance.
double stud_allowance(const Machining& cycle) {
  return cycle.definition.gives(215) ? side_allowance(cycle) : cycle.value(368);
}

/// Mills the rounds of a stud whose blank is larger by `excess` on each side. `point(part, beside)`
/// begins the round that leaves this part of the excess; `around(part, depth)` mills it.
template <class Point, class Around>
NcResult<void> mill_outside(Machining& cycle, double excess, const Point& point,
                            const Around& around) {
  constexpr double kBeside = 2;  // mm beside the blank; the control's value
  const double step = cycle.value(370) * cycle.tool_radius();
  if (step <= 0) return does_not_fit(1002, cycle.tool_radius());
  const double turn = turn_inside(cycle);
  const double rounds = std::max(1.0, std::ceil(excess / step - tolerance::kSamePoint));
  const Feed feed = cycle.feed(207);
  const Vec2 start = point(1, kBeside);
  TRY(cycle.to_point(start, Feed::rapid()));
  return at_each_depth(cycle, start, [&](double depth) -> NcResult<void> {
    TRY(onto_circle(cycle, start, point((rounds - 1) / rounds, 0), turn, depth, feed));
    for (double left = rounds - 1; left >= 0; --left) {
      TRY(cycle.to_point(point(left / rounds, 0), feed));
      TRY(around(left / rounds, depth));
    }
    return off_circle(cycle, start, turn, depth, feed);
  });
}

/// One helical path of a thread from `from` to `to`.
NcResult<void> thread_path(Machining& cycle, Vec2 centre, double radius, double from, double to) {
  const double pitch = cycle.value(239);
  const bool outside = cycle.definition.cycle->descriptor.number == 267;
  const Vec2 start = centre + Vec2{radius, 0};
  // A right-hand thread goes up turning counter-clockwise.
  const double up = to > from ? 1 : -1;
  const double sweep = (pitch < 0 ? -1 : 1) * up * 360 * std::abs(to - from) / std::abs(pitch);
  const Vec2 end = centre + turned(start - centre, sweep);
  if (outside) {
    const Vec2 beside = centre + Vec2{radius + cycle.value(200), 0};
    TRY(cycle.to_point(beside, cycle.feed(253)));
  }
  TRY(cycle.to_height(from, cycle.feed(253)));
  TRY(outside ? cycle.to_point(start, cycle.feed(207))
              : onto_circle(cycle, centre, start, sweep, from, cycle.feed(207)));
  TRY(cycle.arc(centre, end, sweep, to, cycle.feed(207)));
  if (!outside) return off_circle(cycle, centre, sweep, to, cycle.feed(207));
  const Vec2 beside = centre + (end - centre) * ((radius + cycle.value(200)) / radius);
  return cycle.to_point(beside, cycle.feed(207));
}

/// 264: drills the hole of the thread in infeeds. Without a depth there is no hole.
NcResult<void> drill_core(Machining& cycle) {
  MachiningDefinition core = cycle.definition;
  core.values[201] = cycle.value(356);
  if (core.value(201) == 0) return {};
  Machining drilling(cycle, core);
  return drill(drilling);
}

/// 263 to 267: the countersinking of the bore (Q356; of 264 that is the hole) and at the front
/// (Q358).
NcResult<void> countersink(Machining& cycle) {
  const bool is_core = cycle.definition.cycle->descriptor.number == 264;
  for (const int parameter : {356, 358}) {
    if (cycle.value(parameter) == 0 || (parameter == 356 && is_core)) continue;
    const double height = cycle.heights.surface + cycle.value(parameter);
    const int feed = cycle.value(254) > 0 ? 254 : 207;
    TRY(cycle.to_height(height, cycle.feed(feed)));
    TRY(cycle.to_height(cycle.heights.clearance, Feed::rapid()));
  }
  return {};
}

}  // namespace

NcResult<void> mill_bore(Machining& cycle) {
  const Heights& heights = cycle.heights;
  const double radius = cycle.value(335) / 2 - cycle.tool_radius();
  if (radius < 0) return does_not_fit(1003, cycle.tool_radius());
  TRY(cycle.start());
  const Feed feed = cycle.feed(206);
  if (radius < tolerance::kSamePoint) {  // a hole with the diameter of the tool is drilled
    TRY(cycle.to_height(heights.bottom, feed));
  } else {
    const Vec2 centre = cycle.point();
    const Vec2 start = centre + Vec2{radius, 0};
    const double turns = (heights.clearance - heights.bottom) / cycle.value(334);
    const double sweep = turn_inside(cycle) * 360 * turns;
    const Vec2 end = centre + turned(start - centre, sweep);
    TRY(onto_circle(cycle, centre, start, sweep, heights.clearance, feed));
    TRY(cycle.arc(centre, end, sweep, heights.bottom, feed));
    TRY(cycle.arc(centre, end, turn_inside(cycle) * 360, heights.bottom, feed));
    TRY(off_circle(cycle, centre, sweep, heights.bottom, feed));
  }
  TRY(cycle.to_height(heights.clearance, Feed::rapid()));
  return cycle.leave();
}

NcResult<void> mill_rectangle(Machining& cycle) {
  const double inset = cycle.tool_radius() + side_allowance(cycle);
  const double a = cycle.value(218) / 2 - inset;
  const double b = cycle.value(219) / 2 - inset;
  if (a < 0 || b < 0) return does_not_fit(1029, cycle.tool_radius());
  Outline outline{cycle.point(), cycle.value(224)};
  outline.origin = outline.at(rectangle_centre(cycle, cycle.value(218) / 2, cycle.value(219) / 2));
  const double corner = std::clamp(cycle.value(220) - inset, 0.0, std::min(a, b));
  return mill_inside(cycle, outline, a, b, corner);
}

NcResult<void> mill_circle(Machining& cycle) {
  const double half = cycle.value(223) / 2;
  const double radius = half - cycle.tool_radius() - side_allowance(cycle);
  if (radius < 0) return does_not_fit(1029, cycle.tool_radius());
  // Q367 = 1 to 4: the tool is at a quarter of the circle, on its axes.
  constexpr std::array<Vec2, 5> kCentres{Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0},
                                         Vec2{0, -1}};
  const Vec2 centre = cycle.point() + kCentres[place_of(cycle, 4)] * half;
  return at_each_depth(cycle, centre,
                       [&](double depth) { return full_circle(cycle, centre, radius, depth); });
}

NcResult<void> mill_slot(Machining& cycle) {
  const double half_length = cycle.value(218) / 2;
  const double half_width = cycle.value(219) / 2;
  const double radius = half_width - cycle.tool_radius() - side_allowance(cycle);
  if (radius < 0) return does_not_fit(1028, cycle.tool_radius());
  const double reach = half_length - half_width;  // of the end circles' centres
  constexpr std::array<double, 5> kEnds{0, 1, 1, -1, -1};
  const std::size_t place = place_of(cycle, 4);
  double along = kEnds[place] * (place == 2 || place == 3 ? reach : half_length);
  // The old cycle begins in the slot, with the tool at its end.
  if (cycle.definition.cycle->descriptor.dotted) along = half_length - cycle.tool_radius();
  Outline outline{cycle.point(), cycle.value(374)};
  outline.origin = outline.at({along, 0});
  return mill_inside(cycle, outline, reach + radius, radius, radius);
}

NcResult<void> mill_circular_slot(Machining& cycle) {
  const double width = cycle.value(219) / 2 - cycle.tool_radius() - side_allowance(cycle);
  if (width < 0) return does_not_fit(1028, cycle.tool_radius());
  const double pitch = cycle.value(375) / 2;
  const double length = cycle.value(248);
  if (pitch - width <= 0) return nc_error(1003, "the slot lies across the centre of its circle");
  // Q367: position of the tool on the slot; Q376 is the angle of that place.
  constexpr std::array<double, 4> kParts{0, 0, 0.5, 1};
  const std::size_t place = place_of(cycle, 3);
  const double angle = cycle.value(376) - kParts[place] * length;
  const Vec2 centre = place == 0 ? Vec2{cycle.value(216), cycle.value(217)}
                                 : cycle.point() - polar(pitch, cycle.value(376));
  const Feed feed = cycle.feed(207);
  const auto slots = static_cast<int>(std::max(1.0, cycle.value(377)));
  for (int i = 0; i < slots; ++i) {
    const double first = angle + i * cycle.value(378);
    const double last = first + length;
    const auto on = [&](double radius, double at) { return centre + polar(radius, at); };
    if (i > 0 || place == 0) {
      TRY(cycle.to_height(cycle.heights.second, Feed::rapid()));
      TRY(cycle.to_point(on(pitch, first), Feed::rapid()));
    }
    const auto mill = [&](double depth) -> NcResult<void> {
      TRY(cycle.to_point(on(pitch + width, first), feed));
      TRY(cycle.arc(centre, on(pitch + width, last), length, depth, feed));
      if (width <= tolerance::kSamePoint) return {};
      const double end = std::copysign(180, length);
      TRY(cycle.arc(on(pitch, last), on(pitch - width, last), end, depth, feed));
      TRY(cycle.arc(centre, on(pitch - width, first), -length, depth, feed));
      return cycle.arc(on(pitch, first), on(pitch + width, first), end, depth, feed);
    };
    TRY(at_each_depth(cycle, on(pitch, first), mill));
  }
  return {};
}

NcResult<void> mill_thread(Machining& cycle) {
  const Heights& heights = cycle.heights;
  const int number = cycle.definition.cycle->descriptor.number;
  const double pitch = std::abs(cycle.value(239));
  const double nominal = cycle.value(335) / 2;
  const double radius =
      number == 267 ? nominal + cycle.tool_radius() : nominal - cycle.tool_radius();
  if (radius <= 0) return does_not_fit(1003, cycle.tool_radius());
  if (number == 264) TRY(drill_core(cycle));
  TRY(cycle.start());
  TRY(countersink(cycle));
  const Vec2 centre = cycle.point();
  // Climb milling turns counter-clockwise inside and clockwise outside: a right-hand thread goes up
  // in a hole and down on a bolt. 265 drills the thread on its way down.
  const bool follows_hand = (cycle.value(351) < 0) == (cycle.value(239) < 0);
  const bool up = number != 265 && follows_hand == (number != 267);
  // 265 has no Q355 and mills the whole depth. 263 and 264 mill it in one turn, with a tool whose
  // teeth cut all threads.
  const double per_step = number == 265 ? 1 : cycle.value(355);
  const double depth = heights.surface - heights.bottom;
  const double stretch = per_step == 1 ? depth : pitch;
  const double step = per_step > 1 ? per_step * pitch : depth;
  for (double bottom = heights.bottom; bottom < heights.surface - tolerance::kSamePoint;
       bottom += step) {
    const double top = bottom + stretch;
    TRY(thread_path(cycle, centre, radius, up ? bottom : top, up ? top : bottom));
    if (bottom + step == bottom) break;
  }
  TRY(cycle.to_height(heights.clearance, Feed::rapid()));
  if (number == 267) TRY(cycle.to_point(centre, Feed::rapid()));
  return cycle.leave();
}

NcResult<void> mill_rectangular_stud(Machining& cycle) {
  const double left = stud_allowance(cycle);
  const double reach = cycle.tool_radius() + left;
  const Vec2 half{cycle.value(218) / 2, cycle.value(219) / 2};
  const Vec2 excess = Vec2{cycle.value(424) / 2, cycle.value(425) / 2} - half;
  Outline outline{cycle.point(), cycle.value(224)};
  outline.origin = outline.at(rectangle_centre(cycle, half.x, half.y));
  const auto sides = [&](double part) {
    return half + Vec2{reach, reach} +
           Vec2{std::max(0.0, excess.x - left) * part, std::max(0.0, excess.y - left) * part};
  };
  return mill_outside(
      cycle, std::max(excess.x, excess.y) - left,
      [&](double part, double beside) {
        return outline.at({sides(part).x + beside, 0});
      },
      [&](double part, double depth) {
        const Vec2 side = sides(part);
        const double corner = std::min({cycle.value(220) + reach, side.x, side.y});
        return go_around(cycle, outline, side.x, side.y, corner, depth, -turn_inside(cycle));
      });
}

NcResult<void> mill_circular_stud(Machining& cycle) {
  const double left = stud_allowance(cycle);
  const double excess = std::max(0.0, (cycle.value(222) - cycle.value(223)) / 2 - left);
  const Vec2 centre = cycle.point();
  const double angle = std::max(0.0, cycle.value(376));  // -1: where the control likes
  const auto point = [&](double part, double beside) {
    const double finished = cycle.value(223) / 2 + left + cycle.tool_radius();
    return centre + polar(finished + part * excess + beside, angle);
  };
  return mill_outside(cycle, excess, point, [&](double part, double depth) {
    return cycle.arc(centre, point(part, 0), turn_inside(cycle) * -360, depth, cycle.feed(207));
  });
}

NcResult<void> engrave(Machining& cycle) {
  TRY(cycle.start());
  TRY(cycle.to_height(cycle.heights.bottom, cycle.feed(206)));
  TRY(cycle.to_height(cycle.heights.clearance, Feed::rapid()));
  return cycle.leave();
}

}  // namespace fitgauge::interpreter
