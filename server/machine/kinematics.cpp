#include "machine/kinematics.hpp"

#include <algorithm>

namespace fitgauge::machine {
namespace {

/// Table axes from the bed on (A, B, C), then head axes from the column on (C, B, A).
bool stands_before(const RotaryAxis& a, const RotaryAxis& b) {
  if (a.mount != b.mount) return a.mount == AxisMount::Table;
  return a.mount == AxisMount::Table ? a.axis < b.axis : a.axis > b.axis;
}

}  // namespace

Kinematics::Kinematics(std::vector<RotaryAxis> axes) : axes_(std::move(axes)) {
  for (RotaryAxis& axis : axes_) axis.direction = unit(axis.direction);
  std::sort(axes_.begin(), axes_.end(), stands_before);
}

const RotaryAxis* Kinematics::find(Axis axis) const {
  const auto found = std::find_if(axes_.begin(), axes_.end(),
                                  [axis](const RotaryAxis& known) { return known.axis == axis; });
  return found == axes_.end() ? nullptr : &*found;
}

Transform Kinematics::table(const Vec3& rotary) const {
  Transform chain;
  for (const RotaryAxis& axis : axes_) {
    if (axis.mount != AxisMount::Table) continue;
    const double angle = rotary[index(axis.axis) - 3];
    chain = chain * Transform::rotation_around(axis.centre, axis.direction, -angle);
  }
  return chain;
}

Vec3 Kinematics::tool_direction(const Vec3& rotary, Axis tool_axis) const {
  Matrix3 head;
  for (const RotaryAxis& axis : axes_) {
    if (axis.mount != AxisMount::Head) continue;
    head = head * Matrix3::rotation(axis.direction, rotary[index(axis.axis) - 3]);
  }
  return head * unit_vector(tool_axis);
}

}  // namespace fitgauge::machine
