#pragma once

#include <array>

#include "nc/probing/measured_value.hpp"
#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing {

constexpr ValueRole size_role(Side side) {
  return side == Side::Inside ? ValueRole::HoleSize : ValueRole::ShaftSize;
}

/// The centre of a measured feature against Q273 ± Q279 and Q274 ± Q280: Q151, Q152, Q161, Q162.
std::array<MeasuredValue, 2> centre_values(const Arguments& arguments, Point2 centre);

}  // namespace fitgauge::probing
