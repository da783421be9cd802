#include "formats/step/faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "formats/step/values.hpp"

namespace fitgauge::step {
namespace {

using Vector = std::array<double, 3>;
using iso286::Feature;

/// Of directions, and of places relative to their size: files have 10 digits and more.
constexpr double kNear = 1e-6;

constexpr std::array<std::string_view, 4> kRound = {"CYLINDRICAL_SURFACE", "CONICAL_SURFACE",
                                                    "SPHERICAL_SURFACE", "TOROIDAL_SURFACE"};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector between(const Vector& a, const Vector& b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// A face on a surface with an axis: of a plane its normal, out of the material.
struct Face {
  bool is_round = false;
  bool is_same_sense = true;
  Vector point{};
  Vector axis{0, 0, 1};
};

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
  const std::uint32_t place_id = reference(file.parameters(surface[0].list), 1);
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
    if (other.is_round || dot(face.axis, other.axis) > kNear - 1) continue;
    const double distance = dot(between(face.point, other.point), face.axis);
    if (distance != 0 && std::abs(distance) < std::abs(nearest)) nearest = distance;
  }
  if (std::isinf(nearest)) return std::nullopt;
  return nearest > 0 ? Feature::Hole : Feature::Shaft;
}

}  // namespace

Shape shape_of(const Part21& file, std::span<const std::uint32_t> faces) {
  constexpr std::size_t kMostFaces = 256;
  std::vector<Face> read;
  for (const std::uint32_t id : faces) {
    const auto face = read_face(file, id);
    if (face && read.size() < kMostFaces) read.push_back(*face);
  }
  Shape shape{.faces = std::ssize(read), .is_round = !read.empty() && read[0].is_round};
  std::vector<Face> axes;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const Face& face = read[i];
    const auto feature = !face.is_round
                             ? across(face, read)
                             : std::optional(face.is_same_sense ? Feature::Shaft : Feature::Hole);
    if (i > 0 && feature != shape.feature) {
      shape.feature.reset();
      return shape;
    }
    shape.feature = feature;
    const bool is_known = std::any_of(axes.begin(), axes.end(),
                                      [&](const Face& axis) { return is_coaxial(axis, face); });
    if (face.is_round && !is_known) axes.push_back(face);
  }
  shape.count = std::max<std::int64_t>(1, static_cast<std::int64_t>(axes.size()));
  return shape;
}

}  // namespace fitgauge::step
