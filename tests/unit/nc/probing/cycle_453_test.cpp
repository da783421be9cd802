#include <doctest/doctest.h>

#include "kinematics_bench.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::RotaryAxis;
using machine::Setup;

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
