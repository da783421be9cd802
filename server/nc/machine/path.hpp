#pragma once

#include <functional>

#include "nc/machine/axis.hpp"

namespace fitgauge::machine {

/// The way of the spindle nose during one move, by a part from 0 to 1.
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
Path straight_path(const Position& start, const Position& end);

}  // namespace fitgauge::machine
