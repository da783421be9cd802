#pragma once

#include "nc/machine/frames.hpp"

namespace fitgauge::probing {

struct MountedAxis {
  machine::Axis axis;
  machine::AxisMount mount;
};

/// The nine kinds of machines that random tests of the kinematics draw.
inline const std::vector<std::vector<MountedAxis>>& kinds_of_machines() {
  using machine::Axis;
  constexpr auto kTable = machine::AxisMount::Table;
  constexpr auto kHead = machine::AxisMount::Head;
  static const std::vector<std::vector<MountedAxis>> kKinds{
      {{Axis::A, kTable}, {Axis::C, kTable}},
      {{Axis::B, kTable}, {Axis::C, kTable}},
      {{Axis::A, kTable}, {Axis::B, kTable}},
      {{Axis::C, kHead}, {Axis::A, kHead}},
      {{Axis::C, kHead}, {Axis::B, kHead}},
      {{Axis::C, kTable}, {Axis::A, kHead}},
      {{Axis::C, kTable}, {Axis::B, kHead}},
      {{Axis::A, kTable}, {Axis::C, kHead}, {Axis::B, kHead}},
      {{Axis::A, kTable}, {Axis::C, kTable}, {Axis::B, kHead}}};
  return kKinds;
}

}  // namespace fitgauge::probing
