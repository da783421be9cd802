#include "nc/machine/frames.hpp"

namespace fitgauge::machine {

Frames::Frames() { compose(); }

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
  return input_.is_finite() && input_.inverse().is_finite() &&
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

Vec3 Frames::rotary_zero(CoordinateSystem system) const {
  if (system == CoordinateSystem::Input) return preset_.rotary_offsets_deg + shift_.rotary;
  return system == CoordinateSystem::Workpiece ? preset_.rotary_offsets_deg : Vec3{};
}

}  // namespace fitgauge::machine
