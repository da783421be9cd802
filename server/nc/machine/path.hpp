#pragma once

#include "nc/machine/axis.hpp"

namespace fitgauge::machine {

/// Speed of a move, in mm/min of the tool tip; in degrees/min if only rotary axes move.
struct Feed {
  bool is_rapid = true;
  double rate = std::numeric_limits<double>::infinity();  ///< of a rapid: at most, if slower

  /// FMAX: the machine's rapid, or `at_most` (FMAX of tchprobe.tp) if that is slower.
  static Feed rapid(double at_most = std::numeric_limits<double>::infinity()) {
    return {true, at_most};
  }
  static Feed at(double mm_min) { return {false, mm_min}; }

  /// The rate on a machine whose rapid is `machine_rapid`.
  double rate_on(double machine_rapid) const {
    return is_rapid && machine_rapid < rate ? machine_rapid : rate;
  }
};

/// Path of the spindle nose during one move, for a parameter from 0 to 1.
struct Path {
  std::function<Position(double part)> nose;
  Position start;
  Position end;
  bool is_straight = true;  ///< the nose runs straight and no rotary axis moves
  double length = 0;        ///< of the tool tip's way, in mm
  double turn = 0;          ///< of the rotary axis that turns most, in degrees
  double nose_speed = 0;    ///< an upper bound of the nose's way per part, in mm
};

/// All axes from `start` to `end` together.
inline Path straight_path(const Position& start, const Position& end) {
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
