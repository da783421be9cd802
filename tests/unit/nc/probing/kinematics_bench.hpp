#pragma once

#include "probing_bench.hpp"

namespace fitgauge::probing {

/// A trunnion table A, C (or what a test makes of it) with a calibration sphere of radius 15 at
/// `kSphere`, where the active preset lies too.
inline const machine::Vec3 kSphere{60, 25, 40};

inline machine::AxisSetup& add_axis(machine::Setup& setup, machine::Axis axis) {
  return setup.machine.axes[index(axis)].emplace(machine::AxisSetup::of(axis));
}

inline machine::Setup sphere_setup() {
  machine::Setup setup;
  setup.machine.calibration_sphere = machine::CalibrationSphere{kSphere, 15};
  setup.machine.presets.front().frame.origin = kSphere;
  return setup;
}

inline machine::Setup trunnion() {
  machine::Setup setup = sphere_setup();
  add_axis(setup, machine::Axis::A);
  add_axis(setup, machine::Axis::C);
  return setup;
}

/// A trunnion whose axes lie elsewhere than modelled.
inline machine::Setup with_location_errors() {
  machine::Setup setup = trunnion();
  setup.machine.axes[index(machine::Axis::A)]->centre_error = {0, 0.04, -0.03};
  setup.machine.axes[index(machine::Axis::C)]->centre_error = {-0.02, 0.05, 0};
  return setup;
}

/// A bench whose probe stands over the sphere.
class SphereBench : public ProbingBench {
 public:
  explicit SphereBench(const machine::Setup& setup) : ProbingBench(setup) {
    const machine::Vec3 above = setup.machine.calibration_sphere->centre + machine::Vec3{0, 0, 25};
    REQUIRE(
        machine.move({machine::AxisWords::linear(above), {}, machine::CoordinateSystem::Machine})
            .has_value());
  }
};

inline void set_tcpm(machine::Machine& machine, bool on) {
  machine::Modes modes = machine.state().modes;
  modes.tcpm = on;
  REQUIRE(machine.set_modes(modes).has_value());
}

/// A block that measures no axis yet.
inline Values kinematics_block() {
  return {{407, 15.0}, {320, 0.0}, {408, 80.0}, {253, 2000.0}, {380, 0.0},
          {414, 0.0},  {418, 0.0}, {422, 0.0},  {423, 4.0}};
}

/// What a block needs to measure an axis.
inline Values measured(machine::Axis axis, double start, double end, double points) {
  const int first = 411 + 4 * (static_cast<int>(index(axis)) - 3);
  return {{first, start}, {first + 1, end}, {first + 3, points}};
}

/// Where the modelled axis passes a height along it: the point nearest to `near`.
inline machine::Vec3 point_of(const machine::RotaryAxis& axis, const machine::Vec3& near) {
  return axis.centre + axis.direction * dot(near - axis.centre, axis.direction);
}

}  // namespace fitgauge::probing
