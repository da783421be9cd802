#include "nc/machine/frames.hpp"

namespace fitgauge::machine {

Frames::Frames() { compose(); }

void Frames::set_table(const Transform& table) {
  table_ = table;
  table_inverse_ = table.inverse();
  compose();
}

void Frames::set_preset(const PresetFrame& preset) {
  preset_ = preset;
  compose();
}

void Frames::set_plane(const std::optional<TiltedPlane>& plane) {
  plane_ = plane;
  compose();
}

void Frames::set_datum_shift(const Position& shift) {
  shift_ = shift;
  compose();
}

void Frames::set_mirror(const std::array<bool, 3>& mirrored) {
  mirror_ = mirrored;
  compose();
}

void Frames::set_rotation(const PlaneRotation& rotation) {
  rotation_ = rotation;
  compose();
}

void Frames::set_scaling(const Scaling& scaling) {
  scaling_ = scaling;
  compose();
}

void Frames::reset_transformations() {
  shift_ = {};
  if (plane_) plane_->origin = {};
  mirror_ = {};
  rotation_ = {};
  scaling_ = {};
  compose();
}

bool Frames::is_valid() const {
  const Vec3& factor = scaling_.factor;
  return input_.is_finite() && input_inverse_.is_finite() &&
         machine::is_finite(rotary_zero(CoordinateSystem::Input)) && factor.x != 0 &&
         factor.y != 0 && factor.z != 0;
}

void Frames::compose() {
  workpiece_ = table_ * Transform::translation(preset_.origin) *
               Transform::orthogonal(Matrix3::spatial(preset_.basic_rotation_deg));
  input_ = workpiece_;
  if (plane_) {
    input_ = input_ * Transform::translation(plane_->origin) *
             Transform::orthogonal(Matrix3::spatial(plane_->spatial_deg));
  }
  const auto sign = [this](std::size_t axis) { return mirror_[axis] ? -1.0 : 1.0; };
  input_ = input_ * Transform::translation(shift_.linear) *
           Transform::orthogonal(Matrix3::diagonal({sign(0), sign(1), sign(2)})) *
           Transform::orthogonal(
               Matrix3::rotation(unit_vector(rotation_.tool_axis), rotation_.angle_deg)) *
           Transform::scaling(scaling_.centre, scaling_.factor);
  workpiece_inverse_ = workpiece_.inverse();
  input_inverse_ = input_.inverse();
}

const Transform& Frames::transform(CoordinateSystem system) const {
  switch (system) {
    case CoordinateSystem::Input: return input_;
    case CoordinateSystem::Workpiece: return workpiece_;
    case CoordinateSystem::Basic: return table_;
    case CoordinateSystem::Machine:
    case CoordinateSystem::Reference: break;
  }
  return machine_;
}

const Transform& Frames::inverse(CoordinateSystem system) const {
  switch (system) {
    case CoordinateSystem::Input: return input_inverse_;
    case CoordinateSystem::Workpiece: return workpiece_inverse_;
    case CoordinateSystem::Basic: return table_inverse_;
    case CoordinateSystem::Machine:
    case CoordinateSystem::Reference: break;
  }
  return machine_;
}

Vec3 Frames::to_machine(const Vec3& point, CoordinateSystem system) const {
  return transform(system).point(point);
}

Vec3 Frames::from_machine(const Vec3& point, CoordinateSystem system) const {
  return inverse(system).point(point);
}

Vec3 Frames::direction_to_machine(const Vec3& direction, CoordinateSystem system) const {
  return transform(system).direction(direction);
}

Vec3 Frames::direction_from_machine(const Vec3& direction, CoordinateSystem system) const {
  return inverse(system).direction(direction);
}

Vec3 Frames::rotary_zero(CoordinateSystem system) const {
  switch (system) {
    case CoordinateSystem::Input: return preset_.rotary_offsets_deg + shift_.rotary;
    case CoordinateSystem::Workpiece: return preset_.rotary_offsets_deg;
    case CoordinateSystem::Basic:
    case CoordinateSystem::Machine:
    case CoordinateSystem::Reference: break;
  }
  return {};
}

Vec3 Frames::rotary_to_machine(const Vec3& rotary, CoordinateSystem system) const {
  return rotary + rotary_zero(system);
}

Vec3 Frames::rotary_from_machine(const Vec3& rotary, CoordinateSystem system) const {
  return rotary - rotary_zero(system);
}

}  // namespace fitgauge::machine
