#pragma once

#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing {

/// What 412, 413 and 416 give.
inline constexpr std::array<CycleOutput, 3> kPresetCircleResults{
    {{151, "Centre, main axis", Unit::Length},
     {152, "Centre, secondary axis", Unit::Length},
     {153, "Diameter", Unit::Length}}};

/// Sets Q151 to Q153 and records the diameter against Q262, without limits and verdict.
void publish_circle(const CycleContext& context, Side side, const ProbedCircle& probed);

}  // namespace fitgauge::probing
