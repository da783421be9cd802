#pragma once

#include "nc/run/run_budget.hpp"
#include "nc/run/sl_contour.hpp"

namespace fitgauge::interpreter {

/// A straight way of the tool's centre through material.
struct Lane {
  Vec2 from;
  Vec2 to;
};

/// Lanes along the main axis that clear the pockets around their islands, none nearer to a contour
/// than `reach` and none further from the next than `spacing`, to and fro. A contour that crosses
/// a pocket is a wall in it.
/// @errors limit (time, memory), cancelled.
NcResult<std::vector<Lane>> clearing_lanes(const std::vector<SlContour>& contours, double reach,
                                           double spacing, RunBudget& budget);

}  // namespace fitgauge::interpreter
