#include "service/runs/control_files.hpp"

#include <doctest/doctest.h>

#include "nc/machine/workpiece.hpp"
#include "unit/nc/machine/meshes.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MemoryDisk;
using machine::Mesh;
using machine::Workpiece;

constexpr const char* kFlange = "TNC:\\parts\\flange.stl";

machine::Setup setup_with_mesh(double unit = 1, const machine::Vec3& origin = {},
                               const machine::Vec3& angles = {}) {
  Mesh mesh{.file = kFlange, .unit = unit, .origin = origin, .spatial_angles_deg = angles};
  machine::Setup setup;
  setup.features = {machine::Block{{-900, -900, -900}, {-800, -800, -800}}, std::move(mesh)};
  return setup;
}

const Mesh& mesh_of(const machine::Setup& setup) { return std::get<Mesh>(setup.features.at(1)); }

std::string refusal(const Result<void>& result) {
  if (result) return "";
  const Error detail = result.error().details.front();
  return detail.where + ": " + detail.message;
}

TEST_CASE("a file in inches, turned and shifted, lies where the setup says") {
  MemoryDisk disk;
  // A box of 1 by 2 by 3 inches from its zero; PLANE SPATIAL SPC+90 turns X to Y and Y to -X.
  disk.write(kFlange, machine::binary_stl(machine::box({0, 0, 0}, {1, 2, 3})));
  machine::Setup setup = setup_with_mesh(25.4, {10, 20, -30}, {0, 0, 90});
  MeshFiles files(disk);
  REQUIRE(files.load(setup, "", MissingFiles::Refused).has_value());
  const Workpiece part({setup.features.at(1)});
  const Workpiece same({machine::Block{{10 - 50.8, 20, -30}, {10, 45.4, -30 + 76.2}}});
  for (const machine::Vec3& at : {machine::Vec3{15, 30, 0}, machine::Vec3{-50, 60, 60},
                                  machine::Vec3{-20, 30, 0}, machine::Vec3{0, 10, -40}}) {
    CHECK(part.clearance(at, 0) == doctest::Approx(same.clearance(at, 0)).epsilon(1e-12));
  }
  CHECK(part.contact({-100, 30, 0}, {1, 0, 0}, 2, 100).value() == doctest::Approx(100 - 40.8 - 2));
}

TEST_CASE("orders of one part share its mesh until the file changes") {
  MemoryDisk disk;
  disk.write(kFlange, machine::text_stl(machine::icosahedron()));
  MeshFiles files(disk);
  machine::Setup first = setup_with_mesh();
  machine::Setup second = setup_with_mesh(1, {5, 0, 0});
  machine::Setup inches = setup_with_mesh(25.4);
  for (machine::Setup* setup : {&first, &second, &inches}) {
    CHECK(files.load(*setup, "", MissingFiles::Refused).has_value());
  }
  CHECK(mesh_of(first).body == mesh_of(second).body);
  CHECK(mesh_of(first).body != mesh_of(inches).body);
  disk.write(kFlange, machine::text_stl(machine::box({0, 0, 0}, {1, 1, 1})));
  CHECK(files.load(second, "", MissingFiles::Refused).has_value());
  CHECK(mesh_of(second).body->triangles().size() == 12);
}

TEST_CASE("a file that cannot be used is named with its place") {
  MemoryDisk disk;
  MeshFiles files(disk);
  machine::Setup setup = setup_with_mesh();
  CHECK(refusal(files.load(setup, "/setup", MissingFiles::Refused)) ==
        "/setup/workpiece/features/1/file: TNC:\\parts\\flange.stl is not on the control's disk");
  CHECK(files.load(setup, "", MissingFiles::Allowed).has_value());

  auto open = machine::icosahedron();
  open.pop_back();
  disk.write(kFlange, machine::binary_stl(open));
  CHECK(refusal(files.load(setup, "", MissingFiles::Allowed))
            .starts_with("/workpiece/features/1/file: TNC:\\parts\\flange.stl is open: the edge"));

  disk.write(kFlange, machine::binary_stl(machine::torus(20, 5, 400, 200)));
  setup.features.push_back(setup.features.at(1));
  CHECK(
      refusal(files.load(setup, "", MissingFiles::Refused))
          .starts_with("/workpiece/features/2/file: the meshes of a workpiece must have at most"));
}

}  // namespace
}  // namespace fitgauge::app
