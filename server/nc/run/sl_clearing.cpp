#include "nc/run/sl_clearing.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::interpreter {
namespace {

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
    if (norm(point - *curve.centre) < radius && (is_circle || beside < 0)) {
      turns += curve.sweep_deg > 0 ? 1 : -1;
    }
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

class Clearing {
 public:
  Clearing(const std::vector<SlContour>& contours, double reach, RunBudget& budget)
      : contours_(contours), reach_(reach), budget_(budget) {}

  NcResult<void> add_lanes(double y, bool is_back, std::vector<Lane>& lanes) {
    TRY(budget_.check());
    limits_.clear();
    for (const SlContour& contour : contours_) {
      for (const Curve& curve : contour.curves) add_limits(curve, reach_, y, limits_);
    }
    std::sort(limits_.begin(), limits_.end());
    const std::size_t before = lanes.size();
    bool goes_on = false;
    for (std::size_t i = 1; i < limits_.size(); ++i) {
      TRY(budget_.check());
      const double from = limits_[i - 1];
      const double to = limits_[i];
      if (to - from < tolerance::kSamePoint) continue;
      const bool is_free = is_clear({(from + to) / 2, y});
      if (is_free && goes_on) lanes.back().to.x = to;
      if (is_free && !goes_on) lanes.push_back({{from, y}, {to, y}});
      goes_on = is_free;
    }
    if (!is_back) return {};
    const auto added = lanes.begin() + static_cast<std::ptrdiff_t>(before);
    std::reverse(added, lanes.end());
    std::for_each(added, lanes.end(), [](Lane& lane) { std::swap(lane.from, lane.to); });
    return {};
  }

 private:
  bool is_clear(Vec2 point) const {
    for (const SlContour& contour : contours_) {
      for (const Curve& curve : contour.curves) {
        if (distance(curve, point) < reach_) return false;
      }
    }
    return is_in_material(contours_, point);
  }

  const std::vector<SlContour>& contours_;
  const double reach_;
  RunBudget& budget_;
  std::vector<double> limits_;
};

}  // namespace

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
  if (low > high) return lanes;
  // Whole steps, at most as long as the spacing; the first and last are next to the walls.
  const double steps = std::max(1.0, std::ceil((high - low) / spacing - tolerance::kNanometre));
  Clearing clearing(contours, reach, budget);
  bool is_back = false;
  for (double step = 0; step <= steps; ++step) {
    const std::size_t before = lanes.size();
    TRY(clearing.add_lanes(low + (high - low) * step / steps, is_back, lanes));
    if (lanes.size() > before) is_back = !is_back;
  }
  return lanes;
}

}  // namespace fitgauge::interpreter
