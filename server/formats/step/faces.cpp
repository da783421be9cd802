#include "formats/step/faces.hpp"

#include "formats/step/values.hpp"

namespace fitgauge::step {
namespace {

using Vector = std::array<double, 3>;
using iso286::Feature;

/// Tolerance of directions, and of places relative to their size: files have 10 digits and more.
constexpr double kNear = 1e-6;

constexpr std::array<std::string_view, 4> kRound = {"CYLINDRICAL_SURFACE", "CONICAL_SURFACE",
                                                    "SPHERICAL_SURFACE", "TOROIDAL_SURFACE"};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector between(const Vector& a, const Vector& b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

std::uint32_t reference(const std::vector<Parameter>& from, std::size_t at) {
  return at < from.size() && from[at].is(Parameter::Kind::Reference) ? from[at].id : 0;
}

std::optional<Vector> numbers(const Part21& file, std::uint32_t id, std::uint32_t from,
                              std::string_view name) {
  const auto found = record_of(file, id, name, from);
  if (found.size() != 2) return std::nullopt;
  const auto items = file.parameters(found[1].text);
  if (items.size() != 3) return std::nullopt;
  Vector read{};
  for (std::size_t i = 0; i < 3; ++i) read.at(i) = number_of(items[i]);
  return read;
}

bool is_coaxial(const Face& a, const Face& b) {
  const Vector apart = between(a.point, b.point);
  const double along = dot(apart, a.axis);
  const double reach = std::max({length(a.point), length(b.point), 1.0});
  return std::abs(dot(a.axis, b.axis)) > 1 - kNear &&
         std::sqrt(std::max(0.0, dot(apart, apart) - along * along)) < kNear * reach;
}

/// The distance between a plane and the nearest opposite plane.
std::optional<Feature> across(const Face& face, std::span<const Face> all) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Face& other : all) {
    if (other.is_round || other.is_open || dot(face.axis, other.axis) > kNear - 1) continue;
    const double distance = dot(between(face.point, other.point), face.axis);
    if (distance != 0 && std::abs(distance) < std::abs(nearest)) nearest = distance;
  }
  if (std::isinf(nearest)) return std::nullopt;
  return nearest > 0 ? Feature::Hole : Feature::Shaft;
}

}  // namespace

std::optional<Face> read_face(const Part21& file, std::uint32_t id) {
  const auto records = file.records(id, id);
  if (records.size() != 1 ||
      (records[0].name != "ADVANCED_FACE" && records[0].name != "FACE_SURFACE")) {
    return std::nullopt;
  }
  const auto face = file.parameters(records[0].list);
  const std::uint32_t surface_id = reference(face, 2);
  if (face.size() != 4 || surface_id == 0) return std::nullopt;
  const auto surface = file.records(surface_id, id);
  if (surface.size() != 1) return std::nullopt;
  Face read{.is_round = std::find(kRound.begin(), kRound.end(), surface[0].name) != kRound.end(),
            .is_same_sense = face[3].text == ".T."};
  if (!read.is_round && surface[0].name != "PLANE") return std::nullopt;
  const auto shape = file.parameters(surface[0].list);
  if (surface[0].name == kRound[0] && shape.size() == 3) read.radius = number_of(shape[2]);
  const std::uint32_t place_id = reference(shape, 1);
  const auto place = record_of(file, place_id, "AXIS2_PLACEMENT_3D", surface_id);
  const auto point = numbers(file, reference(place, 1), place_id, "CARTESIAN_POINT");
  if (!point) return std::nullopt;
  read.point = *point;
  if (const auto axis = numbers(file, reference(place, 2), place_id, "DIRECTION"))
    read.axis = *axis;
  const double size = length(read.axis);
  if (!(size > 0)) return std::nullopt;
  for (double& each : read.axis) each *= (read.is_round || read.is_same_sense ? 1 : -1) / size;
  return read;
}

void lay_on(Face& face, std::span<const Face> solids) {
  std::array<bool, 2> senses{};
  for (const Face& solid : solids) {
    const bool is_near = std::abs(solid.radius - face.radius) < kNear * face.radius;
    if (is_near && is_coaxial(solid, face)) senses.at(solid.is_same_sense ? 1 : 0) = true;
  }
  face.is_open = senses[0] == senses[1];
  face.is_same_sense = senses[1];
}

Shape shape_of(std::span<const Face> faces) {
  Shape shape{.faces = std::ssize(faces),
              .is_round = !faces.empty() && faces[0].is_round,
              .is_open = !faces.empty()};
  std::vector<Face> axes;
  for (const Face& face : faces) {
    const bool is_known = std::any_of(axes.begin(), axes.end(),
                                      [&](const Face& axis) { return is_coaxial(axis, face); });
    if (face.is_round && !is_known) axes.push_back(face);
    if (face.is_open) continue;
    const auto feature = !face.is_round
                             ? across(face, faces)
                             : std::optional(face.is_same_sense ? Feature::Shaft : Feature::Hole);
    if (!std::exchange(shape.is_open, false) && feature != shape.feature) {
      shape.feature.reset();
      return shape;
    }
    shape.feature = feature;
  }
  shape.count = std::max<std::int64_t>(1, static_cast<std::int64_t>(axes.size()));
  return shape;
}

}  // namespace fitgauge::step
