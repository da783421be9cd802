#include "nc/run/channel.hpp"

/// SL cycles 21 to 24 over the contours of cycle 14 and the data of cycle 20.
namespace fitgauge::interpreter {
namespace {

/// A straight way of the tool's centre through material.
struct Lane {
  Vec2 from;
  Vec2 to;
};

/// Whether a point between the rays of the arc's start and end is in its sweep.
bool is_in_sweep(const Curve& arc, Vec2 point) {
  if (std::abs(arc.sweep_deg) >= 360) return true;
  const double turn = sweep(arc.start, point, *arc.centre, arc.is_left_turn());
  return std::abs(turn) <= std::abs(arc.sweep_deg);
}

double distance(const Curve& curve, Vec2 point) {
  const double to_ends = std::min(norm(point - curve.start), norm(point - curve.end));
  if (curve.is_arc()) {
    if (!is_in_sweep(curve, point)) return to_ends;
    return std::min(to_ends,
                    std::abs(norm(point - *curve.centre) - norm(curve.start - *curve.centre)));
  }
  const Vec2 way = curve.end - curve.start;
  const double part = dot(point - curve.start, way) / dot(way, way);
  if (part <= 0 || part >= 1) return to_ends;
  return std::abs(cross(way, point - curve.start)) / norm(way);
}

/// The full turns of a closed contour around a point.
bool encloses(const SlContour& contour, Vec2 point) {
  double turns = 0;
  for (const Curve& curve : contour.curves) {
    const Vec2 a = curve.start - point;
    const Vec2 b = curve.end - point;
    turns += std::atan2(cross(a, b), dot(a, b)) / (2 * machine::kPi);
    if (!curve.is_arc()) continue;
    // The point may be between the arc and its chord.
    const double radius = norm(curve.start - *curve.centre);
    const double beside = cross(b - a, a * -1) * curve.sweep_deg;
    const bool is_circle = norm(b - a) < tolerance::kSamePoint;
    if (norm(point - *curve.centre) < radius && (is_circle || beside < 0))
      turns += curve.sweep_deg > 0 ? 1 : -1;
  }
  return std::abs(turns) > 0.5;
}

bool is_in_material(const std::vector<SlContour>& contours, Vec2 point) {
  bool is_in_pocket = false;
  for (const SlContour& contour : contours) {
    if (!encloses(contour, point)) continue;
    if (!contour.is_pocket) return false;
    is_in_pocket = true;
  }
  return is_in_pocket;
}

/// Intersections of the line across at `y` with a circle.
void add_circle(Vec2 centre, double radius, double y, std::vector<double>& out) {
  const double square = radius * radius - (y - centre.y) * (y - centre.y);
  if (radius <= 0 || square < 0) return;
  out.push_back(centre.x - std::sqrt(square));
  out.push_back(centre.x + std::sqrt(square));
}

/// Places on the line at `y` where the distance to the curve may become `reach`.
void add_limits(const Curve& curve, double reach, double y, std::vector<double>& out) {
  add_circle(curve.start, reach, y, out);
  add_circle(curve.end, reach, y, out);
  if (curve.is_arc()) {
    const double radius = norm(curve.start - *curve.centre);
    add_circle(*curve.centre, radius - reach, y, out);
    add_circle(*curve.centre, reach - radius, y, out);
    add_circle(*curve.centre, radius + reach, y, out);
    return;
  }
  const Vec2 direction = unit(curve.end - curve.start);
  if (std::abs(direction.y) < tolerance::kParallel) return;
  for (const double side : {reach, -reach}) {
    const Vec2 beside = curve.start + left_of(direction) * side;
    out.push_back(beside.x + direction.x / direction.y * (y - beside.y));
  }
}

bool is_clear(const std::vector<SlContour>& contours, double reach, Vec2 point) {
  for (const SlContour& contour : contours) {
    for (const Curve& curve : contour.curves) {
      if (distance(curve, point) < reach) return false;
    }
  }
  return is_in_material(contours, point);
}

/// @param limits memory that all lanes use
NcResult<void> add_lanes(const std::vector<SlContour>& contours, double reach, double y,
                         std::vector<double>& limits, RunBudget& budget, std::vector<Lane>& lanes) {
  TRY(budget.check());
  limits.clear();
  for (const SlContour& contour : contours) {
    for (const Curve& curve : contour.curves) add_limits(curve, reach, y, limits);
  }
  std::ranges::sort(limits);
  bool goes_on = false;
  for (std::size_t i = 1; i < limits.size(); ++i) {
    TRY(budget.check());
    const double from = limits[i - 1];
    const double to = limits[i];
    if (to - from < tolerance::kSamePoint) continue;
    const bool is_free = is_clear(contours, reach, {(from + to) / 2, y});
    if (is_free && goes_on) lanes.back().to.x = to;
    if (is_free && !goes_on) lanes.push_back({{from, y}, {to, y}});
    goes_on = is_free;
  }
  return {};
}

/// Lanes along the main axis that clear the pockets around their islands, none nearer to a contour
/// than `reach` and none further from the next than `spacing`, to and fro. A contour that crosses
/// a pocket is a wall in it.
/// @errors limit (time, memory), cancelled.
NcResult<std::vector<Lane>> clearing_lanes(const std::vector<SlContour>& contours, double reach,
                                           double spacing, RunBudget& budget) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const SlContour& contour : contours) {
    for (const Curve& curve : contour.curves) {
      const Vec2 around = curve.centre.value_or(curve.start);
      const double radius = norm(curve.start - around);
      low = std::min({low, curve.end.y, around.y - radius});
      high = std::max({high, curve.end.y, around.y + radius});
    }
  }
  low += reach;
  high -= reach;
  std::vector<Lane> lanes;
  std::vector<double> limits;
  if (low > high) return lanes;
  // Whole steps, at most as long as the spacing; the first and last are next to the walls.
  const double steps = std::max(1.0, std::ceil((high - low) / spacing - tolerance::kNanometre));
  bool is_back = false;
  for (double step = 0; step <= steps; ++step) {
    const std::size_t before = lanes.size();
    const double y = low + (high - low) * step / steps;
    TRY(add_lanes(contours, reach, y, limits, budget, lanes));
    const auto added = std::span(lanes).subspan(before);
    if (is_back) {
      std::ranges::reverse(added);
      for (Lane& lane : added) std::swap(lane.from, lane.to);
    }
    if (!added.empty()) is_back = !is_back;
  }
  return lanes;
}

class ContourCycle {
 public:
  ContourCycle(Channel& channel, Machining& cycle)
      : channel_(channel),
        cycle_(cycle),
        data_(*channel.active_cycle.contour_data),
        number_(cycle.definition.cycle->descriptor.number),
        surface_(data_.value(5)),
        bottom_(surface_ + data_.value(1) + (number_ < 23 ? data_.value(4) : 0)),
        clearance_(surface_ + data_.value(6)),
        safe_(data_.value(7)),
        infeed_(std::abs(cycle.value(10))) {}

  NcResult<void> run() {
    if (bottom_ >= surface_) return nc_error(1042, "Q1 leaves no depth");
    for (const std::uint32_t label : channel_.active_cycle.contours) {
      auto contour = TRY(read_contour(channel_, label));
      contours_.push_back(std::move(contour));
    }
    if (number_ == 21) return drill_starts();
    if (number_ != 24) TRY(clear());
    for (const SlContour& contour : contours_) TRY(mill_along(contour));
    return {};
  }

 private:
  /// Returns the allowance on the side: Q14 for side finishing, otherwise Q3.
  double allowance() const { return number_ == 24 ? cycle_.value(14) : data_.value(3); }
  double reach() const { return cycle_.tool_radius() + allowance(); }
  bool is_climb() const { return (number_ == 24 ? cycle_.value(9) : data_.value(9)) >= 0; }

  /// Q208 of 22 and 23; 0 is the feed of milling.
  Feed retraction() const {
    if (!cycle_.definition.gives(208)) return Feed::rapid();
    return cycle_.feed(cycle_.value(208) > 0 ? 208 : 12);
  }

  NcResult<void> go_over(Vec2 point) {
    TRY(cycle_.to_height(safe_, Feed::rapid()));
    TRY(cycle_.to_point(point, Feed::rapid()));
    return cycle_.to_height(clearance_, Feed::rapid());
  }

  /// Calls `cut` at each depth, the bottom last.
  template <class Cut>
  NcResult<void> at_each_depth(const Cut& cut) {
    for (double depth = surface_; depth != bottom_;) {
      const bool is_last = infeed_ == 0 || std::abs(bottom_ - depth) <= infeed_;
      const double next = is_last ? bottom_ : depth - infeed_;
      if (next == depth) return nc_error(1011, "the plunging depth Q10 is too small");
      depth = next;
      TRY(cut(depth));
    }
    return {};
  }

  NcResult<void> mill_along(const SlContour& contour) {
    const SlPath path = path_along(contour, reach(), is_climb());
    TRY(go_over(path.start));
    auto done = at_each_depth([&](double depth) -> NcResult<void> {
      TRY(cycle_.to_height(depth, cycle_.feed(11)));
      return follow(path);
    });
    if (!done) return done;
    return cycle_.to_height(safe_, retraction());
  }

  NcResult<void> follow(const SlPath& path) {
    Machine& machine = channel_.machine();
    CutterPath cutter(allowance());
    cutter.begin(path.start, path.side);
    for (const Curve& curve : path.curves) {
      TRY(channel_.budget.check());
      Element element{cycle_.plane(), curve, machine.position().linear, {}, cycle_.feed(12)};
      element.side = path.side;
      set_plane_target(element, curve.end);
      TRY(cutter.add(machine, element));
    }
    return cutter.finish(machine);
  }

  /// Straight lanes over the inside, each depth after the other.
  NcResult<void> clear() {
    const double spacing = data_.value(2) * cycle_.tool_radius();
    if (spacing <= 0) return {};
    const auto lanes = TRY(clearing_lanes(contours_, reach(), spacing, channel_.budget));
    return at_each_depth([&](double depth) -> NcResult<void> {
      for (const Lane& lane : lanes) {
        TRY(go_over(lane.from));
        TRY(cycle_.to_height(depth, cycle_.feed(11)));
        TRY(cycle_.to_point(lane.to, cycle_.feed(12)));
      }
      return lanes.empty() ? NcResult<void>() : cycle_.to_height(safe_, retraction());
    });
  }

  /// 21: drills at the places where 22 plunges to mill along its contours with the tool Q13.
  NcResult<void> drill_starts() {
    const Tool* tool = roughing_tool();
    if (tool == nullptr) return nc_error(1003, "Q13 is not the number of a tool");
    for (const SlContour& contour : contours_) {
      const double reach = radius_in_plane(cycle_.state(), tool->r + tool->dr) + data_.value(3);
      TRY(go_over(path_along(contour, reach, is_climb()).start));
      TRY(peck());
      TRY(cycle_.to_height(safe_, Feed::rapid()));
    }
    return {};
  }

  NcResult<void> peck() {
    const double above = advanced_stop(bottom_ - surface_);
    return at_each_depth([&](double depth) -> NcResult<void> {
      TRY(cycle_.to_height(depth, cycle_.feed(11)));
      if (depth == bottom_) return {};
      TRY(cycle_.to_height(clearance_, Feed::rapid()));
      return cycle_.to_height(depth + above, Feed::rapid());
    });
  }

  /// Q13, or the tool in the spindle.
  const Tool* roughing_tool() const {
    const auto number = static_cast<int>(cycle_.value(13));
    if (number == 0) return cycle_.state().active_tool();
    return cycle_.state().tools.find(number);
  }

  Channel& channel_;
  Machining& cycle_;
  const MachiningDefinition data_;
  const int number_;
  const double surface_;
  const double bottom_;  ///< the floor allowance Q4 left where the cycle leaves it
  const double clearance_;
  const double safe_;    ///< Q7
  const double infeed_;  ///< 0: at once
  std::vector<SlContour> contours_;
};

}  // namespace

NcResult<void> mill_contours(Channel& channel, Machining& cycle) {
  if (!channel.active_cycle.contour_data || channel.active_cycle.contours.empty())
    return nc_error(1017, "cycles 14 CONTOUR and 20 CONTOUR DATA must be before it");
  return ContourCycle(channel, cycle).run();
}

}  // namespace fitgauge::interpreter
