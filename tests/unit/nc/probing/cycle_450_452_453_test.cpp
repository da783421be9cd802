#include <doctest/doctest.h>

#include "kinematics_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::Kinematics;
using machine::RotaryAxis;
using machine::Setup;
using machine::Vec3;

constexpr double kSave = 0;
constexpr double kRestore = 1;
constexpr double kStatus = 2;
constexpr double kDelete = 3;

Values record(double mode, const ArgumentValue& name) { return {{410, mode}, {409, name}}; }

Kinematics moved(const Kinematics& model, const Vec3& by) {
  std::vector<RotaryAxis> axes = model.axes();
  for (RotaryAxis& axis : axes) axis.centre = axis.centre + by;
  return Kinematics(axes, by);
}

Values table_axes() {
  return with(with(kinematics_block(), measured(Axis::A, -90, 90, 4)),
              measured(Axis::C, -90, 180, 4));
}

Values grid_block(double mode) {
  return {{406, mode}, {407, 15.0}, {408, 90.0}, {253, 2000.0}, {423, 4.0}};
}

/// A table whose axes lie and point elsewhere than modelled.
Setup with_errors() {
  Setup setup = with_location_errors();
  setup.machine.axes[index(Axis::A)]->min = -60;
  setup.machine.axes[index(Axis::A)]->max = 80;
  setup.machine.axes[index(Axis::A)]->tilt_error_deg = {0, 0.01, 0.02};
  setup.machine.axes[index(Axis::C)]->tilt_error_deg = {-0.01, 0.015, 0};
  return setup;
}

}  // namespace

TEST_CASE("450 restores the kinematics it has saved") {
  ProbingBench bench(trunnion());
  const Kinematics original = bench.machine.state().kinematics;
  CHECK(bench.run(450, record(kSave, 7.0)) == 0);
  REQUIRE(bench.machine.set_kinematics(moved(original, {1, 2, 3})).has_value());
  CHECK(bench.run(450, record(kSave, std::string("SHIFTED"))) == 0);
  CHECK(bench.run(450, record(kRestore, 7.0)) == 0);
  CHECK(bench.machine.state().kinematics == original);
  CHECK(bench.run(450, record(kRestore, std::string("SHIFTED"))) == 0);
  CHECK(bench.machine.state().kinematics == moved(original, {1, 2, 3}));
  CHECK(contains(log_of(bench, 450), "Restored from SHIFTED. Before:"));
  CHECK(contains(log_of(bench, 450), "-97.0000"));
}

TEST_CASE("450 lists and deletes its records") {
  ProbingBench bench(trunnion());
  CHECK(bench.run(450, {{410, kStatus}}) == 0);
  CHECK(contains(log_of(bench, 450), "0 of 16 records"));
  CHECK(bench.run(450, record(kSave, std::string("A <B>"))) == 0);
  CHECK(bench.run(450, {{410, kStatus}}) == 0);
  CHECK(contains(log_of(bench, 450), "1 of 16 records:</p>\n<p>A &lt;B&gt;</p>"));
  CHECK(bench.run(450, record(kDelete, std::string("A <B>"))) == 0);
  CHECK(bench.host.saved.empty());
}

TEST_CASE("a number and a text of the same digits name the same record") {
  ProbingBench bench(trunnion());
  CHECK(bench.run(450, record(kSave, 12.0)) == 0);
  CHECK(bench.run(450, record(kRestore, std::string("12"))) == 0);
}

TEST_CASE("a record of another machine is not restored") {
  ProbingBench bench(sphere_setup());
  bench.host.saved["HEAD"] = Kinematics({{Axis::B, machine::AxisMount::Head, {}, {0, 1, 0}}});
  CHECK(bench.run(450, record(kRestore, std::string("HEAD"))) == 1096);
}

TEST_CASE("errors of 450") {
  ProbingBench bench(trunnion());
  CHECK(bench.run(450, record(4, 1.0)) == 1004);
  CHECK(bench.run(450, record(kSave, 1.5)) == 1011);
  CHECK(bench.run(450, record(kSave, 100000.0)) == 1004);
  CHECK(bench.run(450, record(kSave, std::string())) == 1011);
  CHECK(bench.run(450, record(kSave, std::string(17, 'A'))) == 1011);
  CHECK(bench.run(450, record(kSave, std::string("A\nB"))) == 1011);
  CHECK(bench.run(450, record(kDelete, 1.0)) == 1011);
  for (int k = 0; k < 16; ++k) REQUIRE(bench.run(450, record(kSave, static_cast<double>(k))) == 0);
  CHECK(bench.run(450, record(kSave, 16.0)) == 1097);
  CHECK(bench.run(450, record(kSave, 15.0)) == 0);
}

TEST_CASE("452 takes a drift of the tool into the kinematics and keeps the preset") {
  const Vec3 drift{0.04, -0.03, 0.12};
  Setup setup = trunnion();
  setup.machine.calibration_sphere->centre = kSphere + drift;
  for (const Axis axis : {Axis::A, Axis::C}) {
    setup.machine.axes[index(axis)]->centre_error = drift;
  }
  SphereBench bench(setup);
  const Kinematics before = bench.machine.state().kinematics;
  REQUIRE(bench.run(452, table_axes()) == 0);
  const Kinematics& after = bench.machine.state().kinematics;
  CHECK(norm(after.offset() + drift) < 1e-8);
  for (const RotaryAxis& axis : after.axes()) {
    // Along itself an axis has no location.
    const Vec3 moved_by = axis.centre - before.find(axis.axis)->centre;
    CHECK(norm(moved_by - axis.direction * dot(moved_by, axis.direction)) < 1e-8);
  }
  check_q(bench, {{147, drift.x}, {148, drift.y}, {149, drift.z}});
  CHECK(bench.machine.state().presets.find(1)->frame.origin == kSphere);
  CHECK(contains(log_of(bench, 452), "X 0.0400, Y -0.0300, Z 0.1200"));

  REQUIRE(bench.run(451, with(table_axes(), {{406, 0.0}})) == 0);
  for (const int q : {141, 143, 147, 148, 149}) CHECK(same(bench.host.q[q], 0));
}

TEST_CASE("452 corrects the axes too") {
  Setup setup = trunnion();
  setup.machine.axes[index(Axis::C)]->centre_error = {0.03, 0.01, 0};
  SphereBench bench(setup);
  REQUIRE(bench.run(452, table_axes()) == 0);
  for (const int q : {147, 148, 149}) CHECK(same(bench.host.q[q], 0));
  CHECK(bench.host.q[143] > 0.01);
  CHECK(same(bench.host.q[146], 0));
  REQUIRE(bench.run(451, table_axes()) == 0);
  CHECK(same(bench.host.q[143], 0));
}

TEST_CASE("452 needs axes whose location can be seen") {
  SphereBench bench(trunnion());
  CHECK(bench.run(452, kinematics_block()) == 1102);
  CHECK(bench.run(452, with(kinematics_block(), measured(Axis::C, 0, 359.9999, 2))) == 1102);
  CHECK(bench.machine.state().kinematics.offset() == Vec3{});
}

TEST_CASE("453 finds all axes together over the grid of their positions") {
  const Setup setup = with_errors();
  SphereBench bench(setup);
  REQUIRE(bench.run(453, grid_block(1)) == 0);
  CHECK(bench.host.q[141] > 0.01);
  CHECK(bench.host.q[141] == bench.host.q[143]);
  CHECK(bench.host.q[142] == -1);
  CHECK(same(bench.host.q[144], 0));
  for (const Axis axis : {Axis::A, Axis::C}) {
    const RotaryAxis real = setup.machine.axes[index(axis)]->built(axis);
    const RotaryAxis& model = *bench.machine.state().kinematics.find(axis);
    CHECK(norm(model.direction - real.direction) < 1e-9);
    CHECK(norm(point_of(model, kSphere) - point_of(real, kSphere)) < 1e-6);
  }
  REQUIRE(bench.run(453, grid_block(0)) == 0);
  CHECK(same(bench.host.q[141], 0));
  const std::string& log = bench.host.files.at("TCHPR453.html");
  CHECK(log.find("A -25.0000 C 90.0000") != std::string::npos);
  CHECK(log.find("Mode 0 = check;") != std::string::npos);
}

TEST_CASE("453 leaves the kinematics alone when it checks, and sets the preset") {
  SphereBench bench(with_errors());
  const machine::Kinematics before = bench.machine.state().kinematics;
  REQUIRE(bench.run(453, with(grid_block(0), {{431, 3.0}})) == 0);
  CHECK(bench.machine.state().kinematics == before);
  CHECK(norm(bench.machine.state().frames.preset().origin - kSphere) < 1e-6);
}

TEST_CASE("453: a mode there is not") {
  SphereBench bench(trunnion());
  CHECK(bench.run(453, grid_block(2)) == 1004);
}

}  // namespace fitgauge::probing
