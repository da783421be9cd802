#include "api/runs/setup_fields.hpp"

namespace fitgauge::api {
namespace {

machine::Feature read_block(SetupFields& fields) {
  machine::Block block;
  fields.required_mm({"min_mm", "The corner with the smallest coordinates"}, block.min);
  fields.required_mm({"max_mm", "The corner with the largest coordinates"}, block.max);
  return block;
}

machine::Feature read_bore(SetupFields& fields) {
  machine::Bore bore;
  bore.depth = 30;
  fields.required_mm({"center_mm", "X and Y of the opening's centre"}, bore.centre);
  fields.mm({"top_mm", "Z of the opening"}, bore.top);
  fields.mm({"depth_mm", "From the opening to the flat bottom"}, bore.depth);
  fields.required_mm({"diameter_mm", "At the opening"}, bore.diameter);
  fields.integer({"lobes", "n of r = R + a cos(n (angle - phase)); 0: round"}, bore.lobes, 0, 1000);
  fields.um({"lobe_amplitude_um", "a of the lobes"}, bore.lobe_amplitude_um);
  fields.number({"lobe_phase_deg", "Angle of the first lobe's top"}, bore.lobe_phase_deg);
  fields.number({"taper_um_per_mm", "Change of the diameter for each millimetre of depth"},
                bore.taper_um_per_mm);
  fields.numbers({"tilt_deg", "Of the bore's axis around X, then around Y, at the opening"},
                 bore.tilt_deg);
  return bore;
}

machine::Feature read_boss(SetupFields& fields) {
  machine::Boss boss;
  boss.top = 10;
  boss.height = 10;
  read_cylinder(fields, boss);
  return boss;
}

machine::Feature read_plane(SetupFields& fields) {
  machine::Plane plane;
  fields.mm({"point_mm", "A point of the plane"}, plane.point);
  fields.numbers({"normal", "Away from the material, any length"}, plane.normal);
  return plane;
}

machine::Feature read_sphere(SetupFields& fields) {
  machine::Sphere sphere;
  fields.required_mm({"center_mm", "Its centre"}, sphere.centre);
  fields.required_mm({"diameter_mm", "Its diameter"}, sphere.diameter);
  return sphere;
}

machine::Feature read_surface(SetupFields& fields) {
  machine::Surface surface;
  fields.required_mm({"points_mm",
                      "X, Y and Z of measured points; material below, piecewise "
                      "linear between them, nothing outside their hull"},
                     surface.points);
  return surface;
}

machine::Feature read_mesh(SetupFields& fields) {
  machine::Mesh mesh;
  fields.required_file({"file", "STL of the control's disk, text or binary: `parts/flange.stl`"},
                       mesh.file);
  constexpr std::array<std::string_view, 2> kUnits{"mm", "inch"};
  constexpr double kInch = 25.4;
  std::size_t unit = 0;
  fields.word({"unit", "Of the file's figures"}, kUnits, unit);
  mesh.unit = unit == 1 ? kInch : 1;
  fields.mm({"origin_mm", "Where the file's zero lies"}, mesh.origin);
  fields.numbers({"spatial_angles_deg",
                  "How the file's axes are turned around its zero, as "
                  "PLANE SPATIAL turns"},
                 mesh.spatial_angles_deg);
  return mesh;
}

constexpr std::array<SetupFields::Kind, 7> kKinds{{
    {"block", "Block", "Material between two corners"},
    {"bore", "Bore", "Removes material: a hole that is open upwards"},
    {"boss", "Boss", "Material: an upright cylinder"},
    {"plane", "Plane", "Material everywhere behind a plane"},
    {"sphere", "Sphere", "Material: a ball"},
    {"surface", "Surface", "Material below a measured surface"},
    {"mesh", "Mesh", "Material inside a closed mesh of triangles"},
}};
constexpr std::array<machine::Feature (*)(SetupFields&), kKinds.size()> kReaders{
    read_block, read_bore, read_boss, read_plane, read_sphere, read_surface, read_mesh};

}  // namespace

machine::Feature read_feature(SetupFields& fields) {
  machine::Feature feature = machine::Plane{};
  fields.one_of({"type", ""}, kKinds, [&feature](std::size_t kind, SetupFields& members) {
    feature = kReaders.at(kind)(members);
  });
  return feature;
}

}  // namespace fitgauge::api
