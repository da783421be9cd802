#include <doctest/doctest.h>

#include "nc/machine/random.hpp"
#include "nc/machine/triangle_tree.hpp"
#include "nc/machine/workpiece.hpp"
#include "support/deep.hpp"
#include "unit/nc/machine/meshes.hpp"
#include "unit/nc/machine/vec_check.hpp"

/// Meshes against closed forms, and against a search that goes through every triangle with a
/// distance of its own (Ericson, Real-Time Collision Detection, 5.1.5).
namespace fitgauge::machine {
namespace {

Mesh mesh_of(Triangles triangles) {
  Mesh mesh;
  mesh.body = std::make_shared<const TriangleTree>(std::move(triangles));
  return mesh;
}

std::string refusal(const Result<void>& result) { return result ? "" : result.error().message; }

Vec3 closest(const Triangle& t, const Vec3& p) {
  const auto& [a, b, c] = t;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = dot(ab, p - a);
  const double d2 = dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = dot(ab, p - b);
  const double d4 = dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const double d5 = dot(ab, p - c);
  const double d6 = dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / (d4 - d3 + d5 - d6));
  return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

double distance(const Triangles& triangles, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) least = std::min(least, norm(p - closest(t, p)));
  return least;
}

/// How often the mesh winds around the point: 1 inside, 0 outside (van Oosterom and Strackee).
double winding(const Triangles& triangles, const Vec3& p) {
  double angle = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = t[0] - p;
    const Vec3 b = t[1] - p;
    const Vec3 c = t[2] - p;
    const double la = norm(a);
    const double lb = norm(b);
    const double lc = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)),
                            la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * kPi);
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_.next() >> 11) * 0x1p-53;
  }
  Vec3 within(const Vec3& half) {
    const double x = between(-half.x, half.x);
    const double y = between(-half.y, half.y);
    return {x, y, between(-half.z, half.z)};
  }
  Vec3 direction() {
    const double x = random_.normal();
    const double y = random_.normal();
    return unit({x, y, random_.normal()});
  }

 private:
  Random random_;
};

int probes() { return rounds(1'000, 100'000); }

}  // namespace

TEST_CASE("STL is read as text and as bytes, whatever its name line says") {
  const Triangles made = box({-1, 2, 3}, {5, 7, 11});
  CHECK(read_stl(text_stl(made)).value() == made);
  CHECK(read_stl(binary_stl(made)).value() == made);
  // Binary files often begin as a text does.
  std::string bytes = binary_stl(made);
  bytes.replace(0, 12, "solid flange");
  CHECK(read_stl(bytes).value() == made);
  CHECK(read_stl("SOLID\r\nFacet Normal 0 0 1 Outer Loop\r\n vertex +1 2.5e1 -3\nvertex 0 0 0 "
                 "vertex 1 0 0 endloop endfacet endsolid")
            .value() == Triangles{{Vec3{1, 25, -3}, Vec3{}, Vec3{1, 0, 0}}});
}

TEST_CASE("what is no STL says where") {
  const auto refused = [](std::string_view bytes) {
    const auto read = read_stl(bytes);
    return read ? "" : read.error().message;
  };
  CHECK(refused("").starts_with("is not an STL file"));
  CHECK(refused("BEGIN PGM 1 MM").starts_with("is not an STL file"));
  CHECK(refused(binary_stl(box({}, {1, 1, 1})) + "x").starts_with("is not an STL file"));
  CHECK(refused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x") ==
        "line 4: expected a number, found 'x'");
  CHECK(refused("solid a\nfacet normal 0 0 1\nouter hoop") ==
        "line 3: expected loop, found 'hoop'");
  CHECK(refused("solid a\nfacet normal 0 0 1\n") ==
        "line 3: expected outer, found 'the end of the file'");
  CHECK(refused("solid a\nfacet normal 0 0 1 outer loop vertex 1 2 1e99") ==
        "line 2: too far away");
  Triangles far = box({}, {1, 1, 1});
  far[6][1].y = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(binary_stl(far)) == "triangle 7 has a corner that is not a point");
}

TEST_CASE("volumes are the published ones of regular bodies") {
  CHECK(volume(icosahedron()) == doctest::Approx(5 * (3 + std::sqrt(5)) / 12 * 8).epsilon(1e-14));
  CHECK(volume(box({-1, 2, 3}, {5, 7, 11})) == doctest::Approx(6 * 5 * 8).epsilon(1e-14));
  // A ring of prisms: the area of a regular polygon is n R^2 sin(2 pi / n) / 2.
  const double area = 90 * std::sin(2 * kPi / 90) / 2;
  CHECK(volume(ring(12, 20, 30, 90)) ==
        doctest::Approx(area * (20.0 * 20 - 12.0 * 12) * 30).epsilon(1e-12));
  CHECK(volume(turned_round(icosahedron())) < 0);
}

TEST_CASE("a mesh that bounds no body is named") {
  for (const Triangles& good : {icosahedron(), ring(12, 20, 30, 16), torus(20, 5, 12, 6)}) {
    CHECK(refusal(check_closed(good)) == "");
    CHECK(refusal(check_closed(turned_round(good))).starts_with("is inverted: its volume is -"));
    Triangles open = good;
    open.pop_back();
    CHECK(refusal(check_closed(open)).starts_with("is open: the edge from ("));
    Triangles mixed = good;
    std::swap(mixed[3][0], mixed[3][1]);
    CHECK(refusal(check_closed(mixed)).starts_with("is inverted in part: triangles "));
    Triangles flat = good;
    flat.push_back({Vec3{0, 0, 0}, Vec3{1, 1, 1}, Vec3{2, 2, 2}});
    CHECK(refusal(check_closed(flat)) ==
          "is degenerate: triangle " + std::to_string(flat.size()) + " at (0, 0, 0) has no area");
  }
  CHECK(refusal(check_closed({})) == "has no triangle");
}

TEST_CASE("inside and outside are told apart beside faces, edges and corners") {
  const Triangles made = torus(20, 8, 9, 5);
  const Workpiece part({mesh_of(made)});
  Draw draw(18);
  for (int k = 0; k < 2'000; ++k) {
    Vec3 at = draw.within({30, 30, 10});
    if (k % 3 == 1)
      at = made[static_cast<std::size_t>(k) % made.size()][0] + draw.within({1, 1, 1});
    const double true_distance = distance(made, at) * (winding(made, at) > 0.5 ? -1 : 1);
    CHECK(std::abs(part.clearance(at, 0) - true_distance) < 1e-12);
  }
}

TEST_CASE("a probe touches where a search through all triangles touches") {
  const Triangles made = torus(20, 8, 12, 6);
  const Workpiece part({mesh_of(made)});
  Draw draw(19);
  int contacts = 0;
  int misses = 0;
  for (int k = 0; k < probes(); ++k) {
    const double radius = draw.between(0.5, 4);
    const Vec3 start = draw.within({40, 40, 20});
    const Vec3 direction = draw.direction();
    if (part.clearance(start, radius) <= 0) continue;
    constexpr double kLongest = 60;
    double way = 0;
    double gap = distance(made, start) - radius;
    for (int step = 0; step < 300 && way < kLongest && gap > 1e-13; ++step) {
      way += gap;
      gap = distance(made, start + direction * way) - radius;
    }
    const auto touched = part.contact(start, direction, radius, kLongest);
    if (way >= kLongest) {
      CHECK_FALSE(touched);
      ++misses;
    } else if (gap <= 1e-13) {
      REQUIRE(touched);
      CHECK(std::abs(*touched - way) < 1e-9);
      ++contacts;
    }
  }
  CHECK(contacts > probes() / 10);
  CHECK(misses > probes() / 5);
}

TEST_CASE("a tessellated bore is touched in closed form, within its chord of the exact one") {
  constexpr int kCorners = 90;
  constexpr double kRadius = 12.5;
  constexpr double kBall = 2;
  const Workpiece part({mesh_of(ring(kRadius, 20, 30, kCorners))});
  const double half = kPi / kCorners;
  const double chord = kRadius * (1 - std::cos(half));
  for (int k = 0; k < kCorners; ++k) {
    const auto way = [&](double angle) {
      const Vec3 out{std::cos(angle), std::sin(angle), 0};
      return part.contact({0, 0, -10}, out, kBall, 20).value();
    };
    // Square to a face, and towards a corner, where the ball lies against both faces beside it.
    const double face = way((2 * k + 1) * half);
    CHECK(near(face, kRadius * std::cos(half) - kBall, 1e-9));
    CHECK(near(way(2 * k * half), kRadius - kBall / std::cos(half), 1e-9));
    CHECK(face > kRadius - kBall - chord - 1e-9);
  }
  // From outside an edge is touched, where the prism reaches the circle.
  CHECK(near(part.contact({50, 0, -10}, {-1, 0, 0}, kBall, 50).value(), 50 - 20 - kBall, 1e-9));
  // The rim of the hole from above, half a millimetre beside a corner: against the edges of it.
  const double across = 0.5 * std::cos(half);
  CHECK(near(part.contact({kRadius - 0.5, 0, 10}, {0, 0, -1}, kBall, 50).value(),
             10 - std::sqrt(kBall * kBall - across * across), 1e-9));
}

TEST_CASE("a ball that starts in a mesh touches at once, one in its hole does not") {
  const Workpiece part({mesh_of(ring(12.5, 20, 30, 90))});
  for (const double radius : {0.0, 0.5, 3.0}) {
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}) {
      CHECK(part.contact({16, 0, -15}, direction, radius, 0.1) == 0.0);
      CHECK(part.contact({16, 0, -15}, direction, radius, 100) == 0.0);
      CHECK_FALSE(part.contact({0, 0, -15}, direction, radius, 0.1));
    }
    CHECK_FALSE(part.contact({0, 0, -15}, {0, 0, 1}, radius, 100));
    CHECK(near(part.contact({30, 0, -15}, {-1, 0, 0}, radius, 100).value(), 10 - radius, 1e-9));
  }
}

TEST_CASE("a bore is taken from a mesh as from a block") {
  const Vec3 min{0, 0, -40};
  const Vec3 max{100, 80, 0};
  const Bore bore{{50, 40}, 0, 30, 25.013};
  const Workpiece meshed({mesh_of(box(min, max)), bore});
  const Workpiece solid({Block{min, max}, bore});
  Draw draw(20);
  int contacts = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 start = Vec3{50, 40, -10} + draw.within({12, 12, 25});
    const Vec3 direction = draw.direction();
    CHECK(near(meshed.clearance(start, 1), solid.clearance(start, 1), 1e-9));
    const auto way = meshed.contact(start, direction, 1, 60);
    const auto exact = solid.contact(start, direction, 1, 60);
    REQUIRE(way.has_value() == exact.has_value());
    if (way) CHECK(near(*way, *exact, 1e-8));
    contacts += way.has_value();
  }
  CHECK(contacts > 250);
}

}  // namespace fitgauge::machine
