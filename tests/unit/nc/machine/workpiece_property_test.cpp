#include <doctest/doctest.h>

#include "nc/machine/random.hpp"
#include "nc/machine/solid.hpp"
#include "nc/machine/workpiece.hpp"
#include "unit/nc/machine/meshes.hpp"
#include "unit/nc/machine/vec_check.hpp"

using namespace fitgauge::machine;

namespace {

constexpr Vec3 kRing{60, 40, 12};

/// Whether a point is material by the words of the setup alone: no distance is computed.
struct Inside {
  const Vec3& p;

  bool operator()(const Block& f) const {
    return p.x > f.min.x && p.y > f.min.y && p.z > f.min.z && p.x < f.max.x && p.y < f.max.y &&
           p.z < f.max.z;
  }
  bool operator()(const Boss& f) const {
    return p.z < f.top && p.z > f.top - f.height &&
           std::hypot(p.x - f.centre[0], p.y - f.centre[1]) < f.diameter / 2;
  }
  bool operator()(const Plane& f) const { return dot(p - f.point, f.normal) < 0; }
  bool operator()(const Sphere& f) const { return norm(p - f.centre) < f.diameter / 2; }
  /// The surfaces of this test are the plane z = x / 50 + y / 40 on a square of 80 mm.
  bool operator()(const Surface&) const {
    return p.x > 10 && p.x < 90 && p.y > 10 && p.y < 90 && p.z < p.x / 50 + p.y / 40;
  }
  /// The meshes of this test are a ring around the Z axis, of sixteen corners, lying at kRing.
  bool operator()(const Mesh&) const {
    const Vec3 from = p - kRing;
    const double half = kPi / 16;
    const double angle = std::remainder(std::atan2(from.y, from.x) - half, 2 * half);
    const double across = std::hypot(from.x, from.y) * std::cos(angle) / std::cos(half);
    return from.z < 0 && from.z > -25 && across > 8 && across < 20;
  }
  /// The void of a bore.
  bool operator()(const Bore& f) const {
    const Vec3 local = Matrix3::spatial({f.tilt_deg[0], f.tilt_deg[1], 0}).transposed() *
                       (p - Vec3{f.centre[0], f.centre[1], f.top});
    const double depth = -local.z;
    const double angle = std::atan2(local.y, local.x);
    const double radius =
        f.diameter / 2 + depth * f.taper_um_per_mm / 2000 +
        f.lobe_amplitude_um / 1000 * std::cos(f.lobes * (angle - radians(f.lobe_phase_deg)));
    return depth < f.depth && std::hypot(local.x, local.y) < radius;
  }
};

bool is_material(const std::vector<Feature>& features, const Vec3& p) {
  bool material = false;
  for (const Feature& feature : features) {
    if (std::visit(Inside{p}, feature)) material = !std::holds_alternative<Bore>(feature);
  }
  return material;
}

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_.next() >> 11) * 0x1p-53;
  }
  bool coin() { return random_.next() % 2 == 0; }
  Vec3 direction() { return unit({random_.normal(), random_.normal(), random_.normal()}); }
  Vec3 place() { return {between(-10, 110), between(-10, 110), between(-50, 40)}; }

  Bore bore() {
    Bore bore;
    bore.centre = {between(20, 80), between(20, 80)};
    bore.top = between(-5, 10);
    bore.depth = between(10, 60);
    bore.diameter = between(6, 40);
    if (coin()) {
      bore.lobes = static_cast<int>(between(1, 8));
      bore.lobe_amplitude_um = between(0, bore.diameter * (coin() ? 10 : 1));
      bore.lobe_phase_deg = between(-180, 180);
    }
    if (coin()) bore.taper_um_per_mm = between(-50, 200);
    if (coin()) bore.tilt_deg = {between(-10, 10), between(-10, 10)};
    return bore;
  }

  std::vector<Feature> features() {
    std::vector<Feature> features{Block{{0, 0, -40}, {100, 100, 0}}};
    if (coin()) {
      Surface surface;
      for (int x = 0; x < 5; ++x) {
        for (int y = 0; y < 5; ++y) {
          const Vec3 p{10.0 + 20 * x, 10.0 + 20 * y, 0};
          surface.points.push_back({p.x, p.y, p.x / 50 + p.y / 40});
        }
      }
      features.emplace_back(surface);
    }
    if (coin()) features.emplace_back(Boss{{between(10, 90), between(10, 90)}, 15, 20, 25});
    if (coin()) features.emplace_back(Sphere{{between(10, 90), between(10, 90), 5}, 30});
    if (coin()) {
      const auto body = std::make_shared<const TriangleTree>(ring(8, 20, 25, 16));
      features.emplace_back(
          Mesh{.file = {}, .origin = kRing, .spatial_angles_deg = {}, .body = body});
    }
    for (int k = 0; k < 3; ++k) features.emplace_back(bore());
    if (coin()) features.emplace_back(Boss{{between(20, 80), between(20, 80)}, 5, 60, 8});
    if (coin()) features.emplace_back(Plane{{0, 0, -45}, {0.05, 0, 1}});
    return features;
  }

 private:
  Random random_;
};

/// The contact by tracing step by step: slow, and the reference for Workpiece::contact.
std::optional<double> traced_contact(const Workpiece& part, const Vec3& start,
                                     const Vec3& direction, double radius, double longest) {
  fitgauge::Allowance unlimited;
  return first_zero([&](double way) { return part.clearance(start + direction * way, radius); },
                    longest, least_step(radius), unlimited);
}

}  // namespace

TEST_CASE("no material is nearer than the clearance says") {
  const std::uint64_t seed = 421;
  INFO("seed ", seed);
  Generator generator(seed);
  for (int part = 0; part < 40; ++part) {
    const auto features = generator.features();
    const Workpiece workpiece(features);
    for (int k = 0; k < 250; ++k) {
      const Vec3 centre = generator.place();
      const double radius = generator.between(0.1, 6);
      const double free = workpiece.clearance(centre, radius) + radius;
      if (is_material(features, centre)) {
        CHECK(free <= 1e-9);
        continue;
      }
      for (int ray = 0; ray < 20; ++ray) {
        const Vec3 p = centre + generator.direction() * (free * generator.between(0, 1 - 1e-9));
        INFO("part ", part, " centre ", centre.x, " ", centre.y, " ", centre.z);
        CHECK_FALSE((free > 0 && is_material(features, p)));
      }
    }
  }
}

TEST_CASE("a ball on its way to the contact never passes through material") {
  const std::uint64_t seed = 422;
  INFO("seed ", seed);
  Generator generator(seed);
  int contacts = 0;
  int early = 0;
  for (int part = 0; part < 40; ++part) {
    const auto features = generator.features();
    const Workpiece workpiece(features);
    for (int k = 0; k < 40; ++k) {
      const Vec3 start = generator.place();
      const Vec3 direction = generator.direction();
      const double radius = generator.between(0.5, 4);
      if (workpiece.clearance(start, radius) <= 0) continue;
      const auto way = workpiece.contact(start, direction, radius, 60);
      for (int sample = 0; sample < 40; ++sample) {
        const Vec3 centre = start + direction * (way.value_or(60) * generator.between(0, 1));
        const Vec3 p = centre + generator.direction() * (radius * (1 - 1e-8));
        INFO("part ", part, " centre ", centre.x, " ", centre.y, " ", centre.z);
        CHECK_FALSE(is_material(features, p));
      }
      if (!way) continue;
      // There is something to touch: close around the ball some point is material.
      ++contacts;
      const Vec3 centre = start + direction * *way;
      bool touches = false;
      for (int ray = 0; ray < 4000 && !touches; ++ray) {
        touches = is_material(features, centre + generator.direction() * (radius + 0.1));
      }
      early += !touches;
    }
  }
  INFO("contacts ", contacts, " early ", early);
  CHECK(contacts > 250);
  CHECK(early <= contacts / 50);  // corners inside the edges of crossing bores
}

/// Cylinders of the edges and spheres of the corners of a block, and its faces: the first of their
/// intersections with the line that lies on the rounded block. No distance is computed.
double first_on_rounded_block(const Block& block, const Vec3& start, const Vec3& d, double radius) {
  double first = HUGE_VAL;
  const Vec3 low = block.min;
  const Vec3 high = block.max;
  // `along`: the axes along which the touched face, edge or corner extends.
  const auto take = [&](double way, const std::array<bool, 3>& along) {
    if (!(way >= 0) || way >= first) return;
    const Vec3 at = start + d * way;
    for (std::size_t k = 0; k < 3; ++k) {
      if (along[k] && (at[k] < low[k] - 1e-12 || at[k] > high[k] + 1e-12)) return;
    }
    first = way;
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                 (corner & 4) != 0 ? high.z : low.z};
    // The squared distance to the corner without the axes of `along`, as a t^2 + 2 b t + c.
    for (int free = 0; free < 7; ++free) {
      double a = 0;
      double b = 0;
      double c = -radius * radius;
      std::array<bool, 3> along{};
      for (std::size_t k = 0; k < 3; ++k) {
        along[k] = (free >> k & 1) != 0;
        if (along[k]) continue;
        a += d[k] * d[k];
        b += d[k] * (start[k] - p[k]);
        c += (start[k] - p[k]) * (start[k] - p[k]);
      }
      const double root = std::sqrt(b * b - a * c);  // not a number where the line passes by
      if (a > 0) take((-b - root) / a, along);
    }
  }
  return first;
}

TEST_CASE("a contact with a block is that of the line with the rounded block") {
  Generator generator(424);
  int contacts = 0;
  for (int k = 0; k < 20'000; ++k) {
    const Block block{{0, 0, -40}, {generator.between(1, 100), generator.between(1, 80), 0}};
    const Workpiece workpiece({block});
    const double radius = generator.between(0, 6);
    const Vec3 start{generator.between(-60, 160), generator.between(-60, 140),
                     generator.between(-100, 60)};
    if (workpiece.clearance(start, radius) <= 0) continue;
    const Vec3 target{generator.between(0, 100), generator.between(0, 80),
                      generator.between(-40, 0)};
    const Vec3 direction = unit(target - start);
    const auto way = workpiece.contact(start, direction, radius, 300);
    const double expected = first_on_rounded_block(block, start, direction, radius);
    if (expected > 300) {
      CHECK_FALSE(way);
      continue;
    }
    REQUIRE(way);
    ++contacts;
    CHECK(std::abs(*way - expected) < 1e-9);
  }
  CHECK(contacts > 5'000);
}

TEST_CASE("a contact in a bore is where the circle of the ball's centre is left") {
  Generator generator(425);
  for (int k = 0; k < 20'000; ++k) {
    Bore bore;
    bore.diameter = generator.between(5, 60);
    bore.depth = 50;
    const Workpiece workpiece({Block{{-50, -50, -40}, {50, 50, 0}}, bore});
    const double radius = generator.between(0.1, 2);
    const double free = bore.diameter / 2 - radius;
    const double off = free * generator.between(0, 0.999);
    const double from = generator.between(-kPi, kPi);
    const double heading = generator.between(-kPi, kPi);
    const double rise = generator.between(-0.1, 0.1);  // of the direction, per mm across
    const Vec3 start{off * std::cos(from), off * std::sin(from), -20};
    const Vec3 direction = unit({std::cos(heading), std::sin(heading), rise});
    // The chord from a point inside a circle, in polar form.
    const double turn = heading - from;
    const double across =
        std::sqrt(free * free - off * off * std::sin(turn) * std::sin(turn)) - off * std::cos(turn);
    const double expected = across * std::hypot(1.0, rise);
    const auto way = workpiece.contact(start, direction, radius, 200);
    REQUIRE(way);
    CHECK(std::abs(*way - expected) < 1e-9);
  }
}

TEST_CASE("what is found at once is what tracing finds step by step") {
  const std::uint64_t seed = 426;
  INFO("seed ", seed);
  Generator generator(seed);
  int contacts = 0;
  int grazes = 0;
  for (int part = 0; part < 150; ++part) {
    const Workpiece workpiece(generator.features());
    for (int k = 0; k < 40; ++k) {
      const Vec3 start = generator.place();
      const Vec3 direction = generator.direction();
      const double radius = generator.between(0.2, 4);
      if (workpiece.clearance(start, radius) <= 0) continue;
      const auto way = workpiece.contact(start, direction, radius, 100);
      const auto traced = traced_contact(workpiece, start, direction, radius, 100);
      if (!way && !traced) continue;
      ++contacts;
      if (way && traced && std::abs(*way - *traced) < 1e-9) continue;
      // One of them has passed what the ball only grazes: it is in no material there.
      ++grazes;
      const double nearer = std::min(way.value_or(HUGE_VAL), traced.value_or(HUGE_VAL));
      INFO("part ", part, " k ", k, " way ", way.value_or(-1), " traced ", traced.value_or(-1));
      CHECK(std::abs(workpiece.clearance(start + direction * nearer, radius)) < 1e-9);
      CHECK(workpiece.clearance(start + direction * (nearer + 1e-4), radius) > -1e-7);
    }
  }
  INFO("contacts ", contacts, " grazes ", grazes);
  CHECK(contacts > 1000);
  CHECK(grazes <= contacts / 100);
}

TEST_CASE("a move close along a face is decided at once, not traced") {
  const Workpiece workpiece({Plane{}});
  std::stop_source source;
  source.request_stop();
  fitgauge::Allowance stopped(std::chrono::hours(1), 1 << 20, source.get_token());
  for (const double gap : {1e-3, 1e-5, 1e-8}) {
    CHECK_FALSE(workpiece.contact({0, 0, 2 + gap}, {1, 0, 0}, 2, 1e6, stopped));
    CHECK(stopped.found() == fitgauge::Allowance::Spent::Nothing);  // nothing has looked at it
  }
}

TEST_CASE("of many features those are found that one by one come first") {
  const std::uint64_t seed = 427;
  INFO("seed ", seed);
  Generator generator(seed);
  std::vector<Feature> features{Block{{0, 0, -40}, {100, 100, 0}}, Plane{{0, 0, -45}, {0, 0, 1}}};
  for (int k = 0; k < 30; ++k) {
    const Vec3 at = generator.place();
    features.emplace_back(Sphere{at, generator.between(1, 8)});
    features.emplace_back(Boss{{at.y, at.x}, at.z, 5, generator.between(1, 8)});
    features.emplace_back(Block{at - Vec3{1, 2, 3}, at + Vec3{2, 1, 1}});
    Bore bore = generator.bore();
    bore.centre = {generator.between(0, 100), generator.between(0, 100)};
    bore.diameter = generator.between(3, 8);
    bore.lobes = 0;
    bore.taper_um_per_mm = std::max(bore.taper_um_per_mm, 0.0);
    features.emplace_back(bore);
  }
  // Each solid alone, with the bores that come after it.
  std::vector<Workpiece> alone;
  for (auto solid = features.begin(); solid != features.end(); ++solid) {
    if (std::holds_alternative<Bore>(*solid)) continue;
    std::vector<Feature> part{*solid};
    std::copy_if(solid, features.end(), std::back_inserter(part),
                 [](const Feature& feature) { return std::holds_alternative<Bore>(feature); });
    alone.emplace_back(part);
  }
  const Workpiece workpiece(features);
  int contacts = 0;
  for (int k = 0; k < 150; ++k) {
    const Vec3 start = generator.place();
    const Vec3 direction = k % 3 == 0 ? Vec3{0, 0, -1} : generator.direction();
    const double radius = generator.between(0.2, 2);
    double clearance = HUGE_VAL;
    std::optional<double> way;
    for (const Workpiece& part : alone) {
      clearance = std::min(clearance, part.clearance(start, radius));
      const auto found = part.contact(start, direction, radius, 100);
      if (found && (!way || *found < *way)) way = found;
    }
    CHECK(workpiece.clearance(start, radius) == clearance);
    const auto found = workpiece.contact(start, direction, radius, 100);
    REQUIRE(found.has_value() == way.has_value());
    if (!way) continue;
    CHECK(std::abs(*found - *way) < 1e-9);
    contacts += *way > 0;
  }
  CHECK(contacts > 50);
}
