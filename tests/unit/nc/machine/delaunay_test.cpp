#include <doctest/doctest.h>

#include "nc/machine/random.hpp"
#include "nc/machine/triangle_tree.hpp"
#include "unit/nc/machine/vec_check.hpp"

using namespace fitgauge::machine;

namespace {

double area(const std::vector<Vec3>& p, const std::array<std::uint32_t, 3>& t) {
  return ((p[t[1]].x - p[t[0]].x) * (p[t[2]].y - p[t[0]].y) -
          (p[t[1]].y - p[t[0]].y) * (p[t[2]].x - p[t[0]].x)) /
         2;
}

double hull_area(const std::vector<Vec3>& p, const std::vector<std::uint32_t>& hull) {
  double twice = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec3& a = p[hull[k]];
    const Vec3& b = p[hull[(k + 1) % hull.size()]];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

/// Every triangle is counter-clockwise, they cover the hull, and no circle holds another point.
void check_triangulation(const std::vector<Vec3>& points) {
  const Triangulation mesh = delaunay(points);
  double sum = 0;
  std::set<std::uint32_t> used;
  for (const auto& t : mesh.triangles) {
    CHECK(area(points, t) > 0);
    sum += area(points, t);
    used.insert(t.begin(), t.end());
    const Vec3 b = points[t[1]] - points[t[0]];
    const Vec3 c = points[t[2]] - points[t[0]];
    const double d = 2 * (b.x * c.y - b.y * c.x);
    const double bb = b.x * b.x + b.y * b.y;
    const double cc = c.x * c.x + c.y * c.y;
    const Vec3 centre{(c.y * bb - b.y * cc) / d, (b.x * cc - c.x * bb) / d, 0};
    const double radius = std::hypot(centre.x, centre.y);
    for (const Vec3& p : points) {
      const Vec3 from = p - points[t[0]] - centre;
      CHECK(std::hypot(from.x, from.y) > radius * (1 - 1e-7));
    }
  }
  CHECK(used.size() == points.size());
  CHECK(mesh.triangles.size() == 2 * points.size() - mesh.hull.size() - 2);
  CHECK(near(sum, hull_area(points, mesh.hull), 1e-6));
}

}  // namespace

TEST_CASE("random points are triangulated with empty circles") {
  const std::uint64_t seed = 8210;
  INFO("seed ", seed);
  Random random(seed);
  for (const std::size_t count : {3U, 4U, 10U, 60U}) {
    std::vector<Vec3> points(count);
    for (Vec3& point : points) {
      point = {std::round(random.normal() * 1e4) / 100, random.normal() * 50, 0};
    }
    check_triangulation(points);
  }
}

TEST_CASE("grids, columns and fans with many points on one line and circle are triangulated") {
  std::vector<Vec3> grid;
  for (int x = 0; x < 7; ++x) {
    for (int y = 0; y < 5; ++y) grid.push_back({x * 0.1, y * 0.1, 0});
  }
  check_triangulation(grid);
  check_triangulation({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}, {1, 2, 0}});
  check_triangulation({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}, {2, 1, 0}});
  check_triangulation({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {5, 1, 0}, {6, 1, 0}});
  check_triangulation({{3, 0, 0}, {0, 4, 0}, {-5, 0, 0}, {0, -5, 0}, {3, 4, 0}, {-3, 4, 0}});
}

TEST_CASE("points on one line, too few and repeated ones") {
  CHECK(delaunay({}).triangles.empty());
  CHECK(delaunay({{0, 0, 0}, {1, 0, 0}}).triangles.empty());
  CHECK(delaunay({{0, 0, 0}, {1, 2, 0}, {2, 4, 0}, {3, 6, 0}}).triangles.empty());
  CHECK(delaunay({{0, 0, 0}, {1, 0, 0}, {0, 0, 5}, {0, 1, 0}}).triangles.size() == 1);
}

TEST_CASE("the tree finds the nearest point and the height as a search of all triangles does") {
  const std::uint64_t seed = 82101;
  INFO("seed ", seed);
  Random random(seed);
  std::vector<Vec3> points(120);
  for (Vec3& point : points) {
    point = {random.normal() * 30, random.normal() * 30, random.normal()};
  }
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : delaunay(points).triangles) {
    triangles.push_back({points[a], points[b], points[c]});
  }
  const TriangleTree tree(triangles);
  for (int k = 0; k < 200; ++k) {
    const Vec3 at{random.normal() * 40, random.normal() * 40, random.normal() * 5};
    double least = 1e9;
    for (const Triangle& triangle : triangles) {
      least = std::min(least, norm(nearest_point(triangle, at) - at));
    }
    CHECK(near(norm(tree.nearest(at).point - at), least, 1e-12));
    if (const auto height = tree.height(at.x, at.y)) {
      check_near(
          nearest_point(*tree.nearest({at.x, at.y, *height}).triangle, {at.x, at.y, *height}),
          {at.x, at.y, *height});
    }
  }
}

TEST_CASE("the nearest point of a triangle lies on its face, an edge or a corner") {
  const Triangle triangle{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}};
  check_near(nearest_point(triangle, {2, 3, 7}), {2, 3, 0});
  check_near(nearest_point(triangle, {4, -5, 1}), {4, 0, 0});
  check_near(nearest_point(triangle, {10, 10, 1}), {5, 5, 0});
  check_near(nearest_point(triangle, {-3, -4, 0}), {0, 0, 0});
  check_near(nearest_point(triangle, {20, -1, 3}), {10, 0, 0});
}
