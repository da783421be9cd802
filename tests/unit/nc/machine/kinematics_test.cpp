#include "nc/machine/frames.hpp"

#include <doctest/doctest.h>

#include "nc/machine/random.hpp"
#include "unit/nc/machine/vec_check.hpp"

using namespace fitgauge::machine;

namespace {

Kinematics trunnion() {
  return Kinematics({{Axis::C, AxisMount::Table, {0, 0, -50}, {0, 0, 1}},
                     {Axis::A, AxisMount::Table, {0, 0, -100}, {1, 0, 0}}});
}

Kinematics fork_head() {
  return Kinematics(
      {{Axis::C, AxisMount::Head, {}, {0, 0, 1}}, {Axis::B, AxisMount::Head, {}, {0, 1, 0}}});
}

Kinematics table_and_head() {
  return Kinematics({{Axis::C, AxisMount::Table, {0, 0, 0}, {0, 0, 1}},
                     {Axis::B, AxisMount::Head, {}, {0, 1, 0}}});
}

/// The tool's direction as the workpiece sees it.
Vec3 on_table(const Kinematics& kinematics, const Vec3& rotary) {
  return kinematics.table(rotary).inverse().direction(kinematics.tool_direction(rotary, Axis::Z));
}

}  // namespace

TEST_CASE("a table turns the workpiece against the sense of its axis") {
  const Kinematics kinematics = trunnion();
  check_near(kinematics.table({0, 0, 90}).point({10, 0, 0}), {0, -10, 0});
  check_near(kinematics.table({90, 0, 0}).point({0, 0, 0}), {0, 100, -100});
  // A carries C: first C turns the workpiece, then A turns both.
  check_near(kinematics.table({90, 0, 90}).point({10, 0, 0}), {0, 100, -90});
}

TEST_CASE("a head turns the tool with the sense of its axis") {
  check_near(fork_head().tool_direction({0, 90, 0}, Axis::Z), {1, 0, 0});
  check_near(fork_head().tool_direction({0, 90, 90}, Axis::Z), {0, 1, 0});
  check_near(trunnion().tool_direction({30, 0, 60}, Axis::Z), {0, 0, 1});
}

TEST_CASE("an axis is turned by its zero besides what it shows") {
  const Kinematics table({{Axis::C, AxisMount::Table, {0, 0, -50}, {0, 0, 1}},
                          {Axis::A, AxisMount::Table, {0, 0, -100}, {1, 0, 0}, 1.5}});
  check_near(table.table({88.5, 0, 0}).point({}), {0, 100, -100});
  check_near(table.orientations({0, 0, 1}, {}, Axis::Z).at(0), {-1.5, 0, 0});
  const Kinematics head({{Axis::B, AxisMount::Head, {}, {0, 1, 0}, -2}});
  check_near(head.tool_direction({0, 92, 0}, Axis::Z), {1, 0, 0});
  check_near(head.tool_vector({0, 92, 0}, Axis::Z, 100), {-100, 0, 0});
  check_near(head.orientations({1, 0, 0}, {}, Axis::Z).at(0), {0, 92, 0});
}

TEST_CASE("what an axis has come to rest with is turned by the axes that carry it") {
  const Kinematics table = trunnion();
  check_near(table.table({90, 0, 0}, {{{0, 0, 1}, {}, {}}}).point({}), {0, 100, -99});
  check_near(table.table({90, 0, 0}, {{{}, {}, {0, 0, 1}}}).point({}), {0, 101, -100});
  const Displacements of_b{{{}, {0, 1, 0}, {}}};
  check_near(fork_head().tool_vector({0, 0, 90}, Axis::Z, 100, of_b), {-1, 0, -100});
}

TEST_CASE("orientations put the tool along the normal") {
  const std::uint64_t seed = 451;
  INFO("seed ", seed);
  Random random(seed);
  for (const Kinematics& kinematics : {trunnion(), fork_head(), table_and_head()}) {
    for (int k = 0; k < 100; ++k) {
      const Vec3 normal = unit({random.normal(), random.normal(), random.normal()});
      const auto solutions = kinematics.orientations(normal, {}, Axis::Z);
      REQUIRE(solutions.size() == 2);
      for (const Vec3& rotary : solutions) check_near(on_table(kinematics, rotary), normal, 1e-8);
    }
  }
}

TEST_CASE("orientations keep what need not turn") {
  const auto tilted =
      trunnion().orientations(Matrix3::spatial({30, 0, 0}) * Vec3{0, 0, 1}, {}, Axis::Z);
  REQUIRE(tilted.size() == 2);
  check_near(tilted[0], {30, 0, 0});
  const auto upright = trunnion().orientations({0, 0, 1}, {0, 0, 77}, Axis::Z);
  REQUIRE(upright.size() == 1);
  check_near(upright[0], {0, 0, 77});
  const Kinematics only_a({{Axis::A, AxisMount::Table, {}, {1, 0, 0}}});
  CHECK(only_a.orientations(unit({1, 0, 1}), {}, Axis::Z).empty());
  check_near(only_a.orientations(unit({0, -1, 1}), {}, Axis::Z).at(0), {45, 0, 0});
  CHECK(Kinematics().orientations(unit({0, 1, 1}), {}, Axis::Z).empty());
}
