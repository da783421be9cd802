#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {
namespace {

__extension__ using Wide = __int128;

constexpr std::uint32_t kNone = 0xffffffff;

/// A point in whole nanometres.
struct GridPoint {
  std::int64_t x;
  std::int64_t y;

  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

/// Positive when c lies to the left of a -> b, 0 on the line: exact.
int orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const Wide turn = Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

/// Whether d lies inside the circle through the counter-clockwise a, b, c, beyond rounding.
bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  struct Lifted {
    long double x, y, square;
  };
  const auto lift = [&d](const GridPoint& p) {
    const auto x = static_cast<long double>(p.x - d.x);
    const auto y = static_cast<long double>(p.y - d.y);
    return Lifted{x, y, x * x + y * y};
  };
  const Lifted p = lift(a);
  const Lifted q = lift(b);
  const Lifted r = lift(c);
  const long double terms[]{p.square * q.x * r.y,  -p.square * q.y * r.x, q.square * r.x * p.y,
                            -q.square * r.y * p.x, r.square * p.x * q.y,  -r.square * p.y * q.x};
  long double sum = 0;
  long double magnitude = 0;
  for (const long double term : terms) {
    sum += term;
    magnitude += std::abs(term);
  }
  constexpr long double kRounding = 1e-17L;
  return sum > kRounding * magnitude;
}

/// Sweeps the points from left to right, joins each to the edges of the hull that it sees, and
/// flips edges until every circle is empty. Half-edge 3 t + k leads from corner k of triangle t to
/// the next.
class Sweep {
 public:
  explicit Sweep(std::vector<GridPoint> sorted) : points_(std::move(sorted)) {
    next_.resize(points_.size(), kNone);
    previous_.resize(points_.size(), kNone);
    outer_.resize(points_.size(), kNone);
  }

  void run() {
    const std::uint32_t first = first_fan();
    for (std::uint32_t p = first; p < points_.size(); ++p) join(p);
  }

  const std::vector<std::uint32_t>& corners() const { return corners_; }

  std::vector<std::uint32_t> hull() const {
    std::vector<std::uint32_t> loop;
    if (corners_.empty()) return loop;
    const auto start = static_cast<std::uint32_t>(points_.size() - 1);
    std::uint32_t at = start;
    do {
      loop.push_back(at);
      at = next_[at];
    } while (at != start);
    return loop;
  }

 private:
  /// Joins the leading points on one line with the first point beside it; @returns the next point
  /// to join.
  std::uint32_t first_fan() {
    const auto count = static_cast<std::uint32_t>(points_.size());
    std::uint32_t apex = 2;
    while (apex < count && orientation(points_[0], points_[1], points_[apex]) == 0) ++apex;
    if (apex >= count) return count;
    const bool left = orientation(points_[0], points_[1], points_[apex]) > 0;
    // The hull of the line's points and the apex, counter-clockwise.
    std::vector<std::uint32_t> line(apex);
    std::iota(line.begin(), line.end(), 0U);
    if (!left) std::reverse(line.begin(), line.end());
    std::uint32_t twin = kNone;  // of the next triangle's side to the apex
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const std::uint32_t edge = add(line[k], line[k + 1], apex);
      link(edge + 2, twin);
      if (k == 0) outer_[apex] = edge + 2;
      outer_[line[k]] = edge;
      twin = edge + 1;
      connect(line[k], line[k + 1]);
    }
    outer_[line.back()] = twin;
    connect(line.back(), apex);
    connect(apex, line.front());
    return apex + 1;
  }

  void join(std::uint32_t p) {
    // The point before is the rightmost of the hull, so the visible edges surround it.
    std::uint32_t begin = p - 1;
    std::uint32_t end = p - 1;
    while (sees(p, previous_[begin], begin)) begin = previous_[begin];
    while (sees(p, end, next_[end])) end = next_[end];

    std::uint32_t open = kNone;  // the side from the corner reached so far to p
    std::vector<std::uint32_t> suspects;
    for (std::uint32_t a = begin; a != end;) {
      const std::uint32_t b = next_[a];
      const std::uint32_t edge = add(b, a, p);  // sides b-a, a-p, p-b
      link(edge, outer_[a]);
      link(edge + 1, open);
      if (a == begin) outer_[begin] = edge + 1;
      open = edge + 2;
      suspects.push_back(edge);
      a = b;
    }
    outer_[p] = open;
    connect(begin, p);
    connect(p, end);
    flip(std::move(suspects));
  }

  bool sees(std::uint32_t p, std::uint32_t a, std::uint32_t b) const {
    return orientation(points_[a], points_[b], points_[p]) < 0;
  }

  void connect(std::uint32_t a, std::uint32_t b) {
    next_[a] = b;
    previous_[b] = a;
  }

  std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto edge = static_cast<std::uint32_t>(corners_.size());
    corners_.insert(corners_.end(), {a, b, c});
    twins_.insert(twins_.end(), 3, kNone);
    return edge;
  }

  void link(std::uint32_t a, std::uint32_t b) {
    twins_[a] = b;
    if (b != kNone) twins_[b] = a;
  }

  static std::uint32_t after(std::uint32_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
  static std::uint32_t before(std::uint32_t edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }

  void flip(std::vector<std::uint32_t> suspects) {
    while (!suspects.empty()) {
      const std::uint32_t a = suspects.back();
      suspects.pop_back();
      const std::uint32_t b = twins_[a];
      if (b == kNone) continue;
      const std::uint32_t opposite_a = corners_[before(a)];
      const std::uint32_t opposite_b = corners_[before(b)];
      if (!in_circle(points_[corners_[a]], points_[corners_[after(a)]], points_[opposite_a],
                     points_[opposite_b])) {
        continue;
      }
      // Turn the diagonal: each triangle gives one corner and takes the other's outer side.
      const std::uint32_t outer_a = twins_[before(a)];
      const std::uint32_t outer_b = twins_[before(b)];
      corners_[a] = opposite_b;
      corners_[b] = opposite_a;
      take(a, outer_b, before(b));
      take(b, outer_a, before(a));
      link(before(a), before(b));
      suspects.insert(suspects.end(), {a, b, after(a), after(b)});
    }
  }

  /// Half-edge `edge` replaces `old` next to `twin`, or on the hull.
  void take(std::uint32_t edge, std::uint32_t twin, std::uint32_t old) {
    link(edge, twin);
    if (twin == kNone && outer_[corners_[edge]] == old) outer_[corners_[edge]] = edge;
  }

  std::vector<GridPoint> points_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> twins_;
  std::vector<std::uint32_t> next_;  ///< the hull, by point
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> outer_;  ///< by point of the hull: the half-edge to the next one
};

}  // namespace

Triangulation delaunay(const std::vector<Vec3>& points) {
  constexpr double kNanometres = 1e6;
  std::vector<GridPoint> grid;
  grid.reserve(points.size());
  for (const Vec3& p : points)
    grid.push_back({std::llround(p.x * kNanometres), std::llround(p.y * kNanometres)});
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto at = [&grid](std::uint32_t p) { return grid[p]; };
  std::ranges::stable_sort(order, {}, at);
  order.erase(std::ranges::unique(order, {}, at).begin(), order.end());
  std::vector<GridPoint> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t p : order) sorted.push_back(grid[p]);

  Triangulation result;
  if (sorted.size() < 3) return result;
  Sweep sweep(std::move(sorted));
  sweep.run();
  const auto& corners = sweep.corners();
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
    result.triangles.push_back({order[corners[k]], order[corners[k + 1]], order[corners[k + 2]]});
  for (const std::uint32_t p : sweep.hull()) result.hull.push_back(order[p]);
  return result;
}

}  // namespace fitgauge::machine
