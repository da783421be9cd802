#include "nc/machine/frames.hpp"

#include <doctest/doctest.h>

#include "nc/machine/random.hpp"
#include "unit/nc/machine/vec_check.hpp"

using namespace fitgauge::machine;

namespace {

Vec3 random_vector(Random& random, double size) {
  return Vec3{random.normal(), random.normal(), random.normal()} * size;
}

Frames random_frames(Random& random) {
  Frames frames;
  frames.set_table(Transform::rotation_around(
      random_vector(random, 50), unit(random_vector(random, 1)), 30 * random.normal()));
  frames.set_preset({random_vector(random, 100), random_vector(random, 20), {}});
  frames.set_plane(TiltedPlane{random_vector(random, 30), random_vector(random, 10)});
  frames.set_datum_shift({random_vector(random, 40), {}});
  frames.set_mirror({random.next() % 2 == 0, random.next() % 2 == 0, random.next() % 2 == 0});
  frames.set_rotation({90 * random.normal(), Axis::Z});
  const Vec3 factor = random_vector(random, 0.1) + Vec3{1, 1, 1};
  frames.set_scaling({factor, random_vector(random, 5)});
  return frames;
}

}  // namespace

TEST_CASE("every chain of frames has an exact inverse for points and directions") {
  const std::uint64_t seed = 8255;
  INFO("seed ", seed);
  Random random(seed);
  for (int k = 0; k < 200; ++k) {
    const Frames frames = random_frames(random);
    const Vec3 point = random_vector(random, 200);
    for (const auto system : {CoordinateSystem::Input, CoordinateSystem::Workpiece,
                              CoordinateSystem::Basic, CoordinateSystem::Machine}) {
      check_near(frames.from_machine(frames.to_machine(point, system), system), point, 1e-10);
      check_near(frames.direction_from_machine(frames.direction_to_machine(point, system), system),
                 point, 1e-10);
      const Vec3 other = random_vector(random, 200);
      check_near(frames.to_machine(point, system) - frames.to_machine(other, system),
                 frames.direction_to_machine(point - other, system), 1e-10);
    }
  }
}

TEST_CASE("the chain is preset, tilted plane, datum shift, mirror, rotation, scaling") {
  Frames frames;
  frames.set_preset({{100, 200, 300}, {0, 0, 90}, {}});
  check_near(frames.to_machine({1, 2, 3}), {98, 201, 303});  // turned by 90 degrees, then shifted
  frames.set_datum_shift({{10, 0, 0}, {}});
  check_near(frames.to_machine({1, 2, 3}), {98, 211, 303});
  check_near(frames.to_machine({1, 2, 3}, CoordinateSystem::Workpiece), {98, 201, 303});
  frames.set_mirror({true, false, false});
  check_near(frames.to_machine({1, 2, 3}), {98, 209, 303});
  frames.set_rotation({90, Axis::Z});  // (1, 2) becomes (-2, 1), mirrored (2, 1), shifted (12, 1)
  check_near(frames.to_machine({1, 2, 3}), {99, 212, 303});
  frames.set_scaling({{2, 2, 2}, {0, 0, 0}});  // (2, 4) becomes (-4, 2), (4, 2), (14, 2)
  check_near(frames.to_machine({1, 2, 3}), {98, 214, 306});
  CHECK(frames.is_mirrored());
  CHECK(frames.is_scaled());
  CHECK(frames.is_rotated());
  frames.reset_transformations();
  CHECK_FALSE(frames.is_mirrored());
  CHECK_FALSE(frames.is_scaled());
  CHECK_FALSE(frames.is_rotated());
  check_near(frames.to_machine({1, 2, 3}), {98, 201, 303});
}

TEST_CASE("scaling keeps its centre, and a tilted plane its origin") {
  Frames frames;
  frames.set_scaling({{0.5, 2, 1}, {10, 20, 30}});
  check_near(frames.to_machine({10, 20, 30}), {10, 20, 30});
  check_near(frames.to_machine({12, 21, 30}), {11, 22, 30});
  frames.reset_transformations();
  frames.set_plane(TiltedPlane{{90, 0, 0}, {0, 0, 50}});
  check_near(frames.to_machine({0, 0, 0}), {0, 0, 50});
  check_near(frames.to_machine({1, 2, 3}), {1, -3, 52});
  frames.reset_transformations();  // the shift from before the tilt too
  check_near(frames.to_machine({1, 2, 3}), {1, -3, 2});
}

TEST_CASE("a basic rotation and its reset leave the preset's zero") {
  Frames frames;
  frames.set_preset({{5, 6, 7}, {0, 0, 30}, {}});
  PresetFrame straight = frames.preset();
  straight.basic_rotation_deg = {};
  frames.set_preset(straight);
  check_near(frames.to_machine({1, 0, 0}), {6, 6, 7});
}

TEST_CASE("rotary axes carry the preset's offset and the datum shift") {
  Frames frames;
  frames.set_preset({{}, {}, {1, 2, 3}});
  frames.set_datum_shift({{}, {10, 20, 30}});
  check_near(frames.rotary_to_machine({0, 0, 0}, CoordinateSystem::Input), {11, 22, 33});
  check_near(frames.rotary_to_machine({0, 0, 0}, CoordinateSystem::Workpiece), {1, 2, 3});
  check_near(frames.rotary_from_machine({11, 22, 33}, CoordinateSystem::Input), {0, 0, 0});
  check_near(frames.rotary_from_machine({11, 22, 33}, CoordinateSystem::Reference), {11, 22, 33});
}

TEST_CASE("spatial angles are read back from their rotation") {
  for (const Vec3 angles : {Vec3{10, 20, 30}, Vec3{-170, 80, 45}, Vec3{0, -30, 180}}) {
    check_near(spatial_angles(Matrix3::spatial(angles)), angles, 1e-9);
  }
  const Matrix3 upright = Matrix3::spatial({20, 90, 50});
  const Vec3 read = spatial_angles(upright);
  CHECK(read.x == 0);
  CHECK(near(read.y, 90));
  for (std::size_t row = 0; row < 3; ++row) {
    check_near(Matrix3::spatial(read).rows[row], upright.rows[row]);
  }
}

TEST_CASE("quarter turns map axes onto axes exactly") {
  for (const int turns : {-7, -2, -1, 0, 1, 2, 3, 4, 9}) {
    const SineCosine turn = sine_cosine(90.0 * turns);
    CHECK(std::abs(turn.sine) + std::abs(turn.cosine) == 1);
  }
}

TEST_CASE("frames that scale by 0 or are not finite are told apart") {
  Frames frames;
  CHECK(frames.is_valid());
  frames.set_scaling({{1, 0, 1}, {}});
  CHECK_FALSE(frames.is_valid());
  frames.reset_transformations();
  frames.set_datum_shift({{std::nan(""), 0, 0}, {}});
  CHECK_FALSE(frames.is_valid());
}
