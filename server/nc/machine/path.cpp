#include "nc/machine/path.hpp"

namespace fitgauge::machine {

Path straight_path(const Position& start, const Position& end) {
  const Vec3 linear = end.linear - start.linear;
  const Vec3 rotary = end.rotary - start.rotary;
  Path path;
  path.nose = [start, linear, rotary](double part) {
    return Position{start.linear + linear * part, start.rotary + rotary * part};
  };
  path.start = start;
  path.end = end;
  path.is_straight = rotary == Vec3{};
  path.length = norm(linear);
  path.turn = std::max({std::abs(rotary.x), std::abs(rotary.y), std::abs(rotary.z)});
  path.nose_speed = path.length;
  return path;
}

}  // namespace fitgauge::machine
