#include <doctest/doctest.h>

#include "unit/nc/machine/machine_bench.hpp"

using namespace fitgauge::machine;

namespace {

Setup with_sphere(const CalibrationSphere& sphere) {
  Setup setup;
  setup.machine.calibration_sphere = sphere;
  return setup;
}

std::string refused_field(const Setup& setup) {
  const auto result = validate(setup);
  return result.has_value() ? std::string() : result.error().details.at(0).where;
}

/// Where a probing move straight down at X, Y touches.
Vec3 touch(Machine& machine, double x, double y) {
  REQUIRE(ok(machine.move(to({x, y, 90}))));
  const auto contact = machine.probe(towards({0, 0, -1}, 40));
  REQUIRE(ok(contact));
  return contact->tip;
}

}  // namespace

TEST_CASE("the calibration sphere stands on the table beside the workpiece") {
  Setup setup = with_sphere({{100, 20, 50}, 15});
  setup.features = {Block{{-50, -50, 0}, {50, 50, 60}}};
  MachineWithProbe machine(setup);
  CHECK(near(touch(machine, 100, 20).z, 65));
  CHECK(near(touch(machine, 0, 0).z, 60));
}

TEST_CASE("the calibration sphere turns with the table") {
  Setup setup = with_sphere({{100, 0, 50}, 15});
  setup.machine.axes[index(Axis::C)] = AxisSetup::of(Axis::C);
  MachineWithProbe machine(setup);
  machine.turn(Axis::C, 90);
  CHECK(near(touch(machine, 0, -100).z, 65));
}

TEST_CASE("each bad field of the calibration sphere is named") {
  CHECK(refused_field(with_sphere({{0, 0, 50}, 12.5})).empty());
  CHECK(refused_field(with_sphere({{0, 1e9, 50}, 12.5})) ==
        "/machine/calibration_sphere/center_mm/1");
  CHECK(refused_field(with_sphere({{0, 0, 50}, 0})) == "/machine/calibration_sphere/radius_mm");
}
