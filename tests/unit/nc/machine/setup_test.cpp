#include <doctest/doctest.h>

#include "nc/machine/machine_setup.hpp"

using namespace fitgauge::machine;
using fitgauge::Error;
using fitgauge::ErrorCode;

namespace {

/// Whether the setup is refused for exactly the field at `pointer`.
bool refuses_only(const Setup& setup, const std::string& pointer) {
  const auto result = validate(setup);
  if (!result.has_error()) return false;
  const Error& error = result.error();
  for (const Error& detail : error.details) INFO(detail.where, ": ", detail.message);
  return error.code == ErrorCode::SetupInvalid && error.details.size() == 1 &&
         error.details[0].where == pointer && !error.details[0].message.empty();
}

Setup with(Feature feature) {
  Setup setup;
  setup.features = {std::move(feature)};
  return setup;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a bad fixture is named by its place among the fixtures") {
  Setup setup = with(Sphere{{}, 25});
  setup.fixtures = {Sphere{{}, 25}, Sphere{{}, -1}};
  const auto valid = validate(setup);
  REQUIRE(valid.has_error());
  CHECK(valid.error().details.at(0).where == "/workpiece/fixtures/1/diameter_mm");
}

TEST_CASE("the default setup is valid and has the defaults of the contract") {
  const Setup setup;
  CHECK(validate(setup).has_value());
  CHECK(setup.seed == 1);
  const MachineSetup& machine = setup.machine;
  CHECK(machine.axes[0]->min == -500);
  CHECK(machine.axes[2]->max == 500);
  CHECK_FALSE(machine.axes[3]);
  CHECK(AxisSetup::of(Axis::A).max == 120);
  CHECK(AxisSetup::of(Axis::B).direction == Vec3{0, 1, 0});
  CHECK(machine.rapid_mm_min == 15000);
  CHECK(machine.tools.at(0).row.number == 30);
  CHECK(machine.tools.at(0).row.l == 120);
  CHECK(machine.tools.at(0).row.r == 2);
  CHECK(machine.probes.at(0).row.distance == 20);
  CHECK(machine.tt.known.centre == Vec3{300, 0, 50});
  CHECK(machine.presets.at(0).number == 1);
  CHECK(machine.active_preset == 1);
}

TEST_CASE("each bad field of the machine is named") {
  Setup setup;
  setup.machine.axes[0]->max = -500;
  CHECK(refuses_only(setup, "/machine/axes/X/max_mm"));
  setup = {};
  setup.machine.axes[3] = AxisSetup::of(Axis::A);
  setup.machine.axes[3]->direction = {};
  CHECK(refuses_only(setup, "/machine/axes/A/direction"));
  setup = {};
  setup.machine.axes[1].reset();
  CHECK(refuses_only(setup, "/machine/axes/Y"));
  setup = {};
  setup.machine.start[Axis::B] = 1;
  CHECK(refuses_only(setup, "/machine/start_mm/B"));
  setup = {};
  setup.machine.start[Axis::Z] = 501;
  CHECK(refuses_only(setup, "/machine/start_mm/Z"));
  setup = {};
  setup.machine.rapid_mm_min = 0;
  CHECK(refuses_only(setup, "/machine/rapid_mm_min"));
  setup = {};
  setup.machine.tools.push_back(setup.machine.tools[0]);
  CHECK(refuses_only(setup, "/machine/tools/1/number"));
  setup = {};
  setup.machine.tools[0].row.probe = 2;
  CHECK(refuses_only(setup, "/machine/tools/0/probe"));
  setup = {};
  setup.machine.tools[0].row.r = 0;
  CHECK(refuses_only(setup, "/machine/tools/0/radius_mm"));
  setup = {};
  setup.machine.probes[0].row.distance = kNan;
  CHECK(refuses_only(setup, "/machine/probes/0/dist_mm"));
  setup = {};
  setup.machine.probes[0].repeatability_um = -1;
  CHECK(refuses_only(setup, "/machine/probes/0/repeatability_um"));
  setup = {};
  setup.machine.active_preset = 2;
  CHECK(refuses_only(setup, "/machine/active_preset"));
  setup = {};
  setup.machine.presets[0].frame.origin.y = kNan;
  CHECK(refuses_only(setup, "/machine/presets/0/y_mm"));
  setup = {};
  setup.machine.tt.known.radius = 0;
  CHECK(refuses_only(setup, "/machine/tt/radius_mm"));
  setup = {};
  setup.machine.tt.actual_radius = -1;
  CHECK(refuses_only(setup, "/machine/tt/actual_radius_mm"));
  setup = {};
  setup.machine.tools[0].row.r_offset = kNan;
  CHECK(refuses_only(setup, "/machine/tools/0/radius_offset_mm"));
  setup = {};
  setup.machine.calibration_stud = Boss{{0, 0}, 10, 0, 20};
  CHECK(refuses_only(setup, "/machine/calibration_stud/height_mm"));
  setup = {};
  setup.machine.calibration_ring = CalibrationRing{{0, 0}, 0, 20, 50, 50};
  CHECK(refuses_only(setup, "/machine/calibration_ring/outer_diameter_mm"));
}

TEST_CASE("each bad field of the workpiece is named") {
  const std::string at = "/workpiece/features/0";
  CHECK(refuses_only(with(Block{{0, 0, 0}, {1, 0, 1}}), at + "/max_mm/1"));
  Bore bore;
  bore.diameter = 10;
  bore.depth = 5;
  CHECK(validate(with(bore)).has_value());
  Bore bad = bore;
  bad.diameter = 0;
  CHECK(refuses_only(with(bad), at + "/diameter_mm"));
  bad = bore;
  bad.lobes = -1;
  CHECK(refuses_only(with(bad), at + "/lobes"));
  bad = bore;
  bad.lobe_amplitude_um = 6000;
  CHECK(refuses_only(with(bad), at + "/lobe_amplitude_um"));
  bad = bore;
  bad.depth = 20;
  bad.taper_um_per_mm = -600;
  CHECK(refuses_only(with(bad), at + "/taper_um_per_mm"));
  bad = bore;
  bad.tilt_deg[1] = 90;
  CHECK(refuses_only(with(bad), at + "/tilt_deg/1"));
  CHECK(refuses_only(with(Boss{{0, 0}, 0, 0, 5}), at + "/height_mm"));
  CHECK(refuses_only(with(Plane{{0, 0, 0}, {0, 0, 0}}), at + "/normal"));
  CHECK(refuses_only(with(Sphere{{0, 0, kNan}, 5}), at + "/center_mm/2"));
  CHECK(refuses_only(with(Surface{{{0, 0, 0}, {1, 1, 0}}}), at + "/points_mm"));
  CHECK(refuses_only(with(Surface{{{0, 0, 0}, {1, 1, 0}, {2, 2, 5}}}), at + "/points_mm"));
  CHECK(refuses_only(with(Surface{{{0, 0, 0}, {1, 1, 0}, {2, 0, 5}, {1, 1, 3}}}),
                     at + "/points_mm/3"));
}

TEST_CASE("all bad fields are reported together") {
  Setup setup = with(Sphere{{0, 0, 0}, -1});
  setup.machine.rapid_mm_min = -1;
  setup.machine.active_preset = 9;
  const auto result = validate(setup);
  REQUIRE(result.has_error());
  CHECK(result.error().details.size() == 3);
}
