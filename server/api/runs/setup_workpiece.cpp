#include <algorithm>

#include "api/runs/setup_reader.hpp"

namespace fitgauge::api {
namespace {

machine::Feature read_block(SetupReader& reader) {
  machine::Block block;
  reader.required_mm("min_mm", block.min);
  reader.required_mm("max_mm", block.max);
  return block;
}

machine::Feature read_bore(SetupReader& reader) {
  machine::Bore bore;
  bore.depth = 30;
  reader.required_mm("center_mm", bore.centre);
  reader.mm("top_mm", bore.top);
  reader.mm("depth_mm", bore.depth);
  reader.required_mm("diameter_mm", bore.diameter);
  reader.integer("lobes", bore.lobes, 0, 1000);
  reader.um("lobe_amplitude_um", bore.lobe_amplitude_um);
  reader.number("lobe_phase_deg", bore.lobe_phase_deg);
  reader.number("taper_um_per_mm", bore.taper_um_per_mm);
  reader.numbers("tilt_deg", bore.tilt_deg);
  return bore;
}

machine::Feature read_boss(SetupReader& reader) {
  machine::Boss boss;
  boss.top = 10;
  boss.height = 10;
  read_cylinder(reader, boss);
  return boss;
}

machine::Feature read_plane(SetupReader& reader) {
  machine::Plane plane;
  reader.mm("point_mm", plane.point);
  reader.numbers("normal", plane.normal);
  return plane;
}

machine::Feature read_sphere(SetupReader& reader) {
  machine::Sphere sphere;
  reader.required_mm("center_mm", sphere.centre);
  reader.required_mm("diameter_mm", sphere.diameter);
  return sphere;
}

machine::Feature read_surface(SetupReader& reader) {
  machine::Surface surface;
  reader.required_mm("points_mm", surface.points);
  return surface;
}

struct FeatureKind {
  std::string_view type;
  machine::Feature (*read)(SetupReader&);
};
constexpr std::array<FeatureKind, 6> kFeatures{{{"block", read_block},
                                                {"bore", read_bore},
                                                {"boss", read_boss},
                                                {"plane", read_plane},
                                                {"sphere", read_sphere},
                                                {"surface", read_surface}}};

}  // namespace

machine::Feature read_feature(SetupReader& reader) {
  const auto type = reader.fields().text("type");
  const auto kind = std::find_if(kFeatures.begin(), kFeatures.end(),
                                 [&type](const FeatureKind& k) { return type && k.type == *type; });
  if (kind != kFeatures.end()) return kind->read(reader);
  if (type) {
    reader.fields().report(ErrorCode::FieldInvalid, "type",
                           "type takes block, bore, boss, plane, sphere or surface");
  }
  reader.fields().accept_all();  // what else it may have depends on its type
  return machine::Plane{};
}

}  // namespace fitgauge::api
