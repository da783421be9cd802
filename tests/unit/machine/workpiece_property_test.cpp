#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "machine/random.hpp"
#include "machine/workpiece.hpp"
#include "unit/machine/vec_check.hpp"

using namespace fitgauge::machine;

namespace {

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
    for (int k = 0; k < 3; ++k) features.emplace_back(bore());
    if (coin()) features.emplace_back(Boss{{between(20, 80), between(20, 80)}, 5, 60, 8});
    if (coin()) features.emplace_back(Plane{{0, 0, -45}, {0.05, 0, 1}});
    return features;
  }

 private:
  Random random_;
};

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
