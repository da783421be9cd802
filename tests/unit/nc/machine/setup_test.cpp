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
  struct Row {
    std::string field;
    void (*spoil)(MachineSetup& m);
  };
  for (const Row& row :
       {Row{"axes/X/max_mm", [](MachineSetup& m) { m.axes[0]->max = -500; }},
        Row{"axes/A/direction",
            [](MachineSetup& m) {
              m.axes[3] = AxisSetup::of(Axis::A);
              m.axes[3]->direction = {};
            }},
        Row{"axes/Y", [](MachineSetup& m) { m.axes[1].reset(); }},
        Row{"start_mm/B", [](MachineSetup& m) { m.start[Axis::B] = 1; }},
        Row{"start_mm/Z", [](MachineSetup& m) { m.start[Axis::Z] = 501; }},
        Row{"rapid_mm_min", [](MachineSetup& m) { m.rapid_mm_min = 0; }},
        Row{"tools/1/number", [](MachineSetup& m) { m.tools.push_back(m.tools[0]); }},
        Row{"tools/0/probe", [](MachineSetup& m) { m.tools[0].row.probe = 2; }},
        Row{"tools/0/radius_mm", [](MachineSetup& m) { m.tools[0].row.r = 0; }},
        Row{"probes/0/dist_mm", [](MachineSetup& m) { m.probes[0].row.distance = kNan; }},
        Row{"probes/0/repeatability_um",
            [](MachineSetup& m) { m.probes[0].repeatability_um = -1; }},
        Row{"active_preset", [](MachineSetup& m) { m.active_preset = 2; }},
        Row{"presets/0/y_mm", [](MachineSetup& m) { m.presets[0].frame.origin.y = kNan; }},
        Row{"tt/radius_mm", [](MachineSetup& m) { m.tt.known.radius = 0; }},
        Row{"tt/actual_radius_mm", [](MachineSetup& m) { m.tt.actual_radius = -1; }},
        Row{"tools/0/radius_offset_mm", [](MachineSetup& m) { m.tools[0].row.r_offset = kNan; }},
        Row{"calibration_stud/height_mm",
            [](MachineSetup& m) {
              m.calibration_stud = Boss{{0, 0}, 10, 0, 20};
            }},
        Row{"calibration_ring/outer_diameter_mm", [](MachineSetup& m) {
              m.calibration_ring = CalibrationRing{{0, 0}, 0, 20, 50, 50};
            }}}) {
    CAPTURE(row.field);
    Setup setup;
    row.spoil(setup.machine);
    CHECK(refuses_only(setup, "/machine/" + row.field));
  }
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
