#include "service/runs/control_files.hpp"

#include <doctest/doctest.h>

#include "unit/nc/machine/meshes.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MemoryDisk;
using machine::Mesh;

constexpr const char* kFlange = "TNC:\\parts\\flange.stl";

machine::Setup setup_with_mesh(double unit = 1, const machine::Vec3& origin = {}) {
  Mesh mesh{.file = kFlange, .unit = unit, .origin = origin, .spatial_angles_deg = {}};
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

TEST_CASE("meshes that have too many triangles together are refused at the one too many") {
  MemoryDisk disk;
  MeshFiles files(disk);
  machine::Setup setup = setup_with_mesh();
  disk.write(kFlange, machine::binary_stl(machine::torus(20, 5, 400, 200)));
  setup.features.push_back(setup.features.at(1));
  CHECK(
      refusal(files.load(setup, "", MissingFiles::Refused))
          .starts_with("/workpiece/features/2/file: the meshes of a workpiece must have at most"));
}

}  // namespace
}  // namespace fitgauge::app
