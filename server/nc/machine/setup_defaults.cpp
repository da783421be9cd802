#include "nc/machine/machine_setup.hpp"

namespace fitgauge::machine {

AxisSetup AxisSetup::of(Axis axis) {
  AxisSetup setup;
  setup.direction = unit_vector(axis);
  if (is_rotary(axis)) {
    setup.max = axis == Axis::C ? 360 : 120;
    setup.min = -setup.max;
  }
  return setup;
}

RotaryAxis AxisSetup::modelled(Axis axis) const {
  return {axis, mount, mount == AxisMount::Head ? Vec3{} : centre, direction};
}

RotaryAxis AxisSetup::built(Axis axis) const {
  RotaryAxis real = modelled(axis);
  real.centre = real.centre + centre_error;
  real.direction = Matrix3::spatial(tilt_error_deg) * real.direction;
  real.zero_deg = zero_error_deg;
  return real;
}

Position MachineSetup::start_position() const {
  Position position;
  for (const Axis axis : kAllAxes) {
    if (start[axis]) {
      position[axis] = *start[axis];
    } else if (axis == Axis::Z && axes[index(axis)]) {
      position[axis] = axes[index(axis)]->max;
    }
  }
  return position;
}

ToolSetup MachineSetup::default_probe_tool() {
  ToolSetup tool;
  tool.row.number = 30;
  tool.row.name = "PROBE";
  tool.row.l = 120;
  tool.row.r = 2;
  tool.row.probe = 1;
  return tool;
}

Preset MachineSetup::default_preset() {
  Preset preset;
  preset.number = 1;
  return preset;
}

}  // namespace fitgauge::machine
