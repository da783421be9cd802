#include "nc/machine/axis.hpp"

namespace fitgauge::machine {

std::string_view name(Axis axis) {
  constexpr std::array<std::string_view, kAxes> kNames{"X", "Y", "Z", "A", "B", "C"};
  return kNames[index(axis)];
}

Vec3 unit_vector(Axis axis) {
  Vec3 vector;
  vector[index(axis) % 3] = 1;
  return vector;
}

}  // namespace fitgauge::machine
