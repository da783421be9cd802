#include "nc/probing/kinematics/positions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "nc/machine/tolerance.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;

/// Angles of a block and of a grid in whole billionths of a degree, in which steps and ties are
/// exact.
std::int64_t whole(double degrees) { return std::llround(degrees / tolerance::kSameAngle); }

/// The multiple of the grid that is nearest to numerator / denominator, of two equally near ones
/// that away from zero (decision 5).
double nearest_tooth(std::int64_t numerator, std::int64_t denominator, double grid) {
  const std::int64_t tooth = whole(grid) * denominator;
  const std::int64_t count = (2 * std::abs(numerator) + tooth) / (2 * tooth);
  return static_cast<double>(numerator < 0 ? -count : count) * grid;
}

double on_grid(double position, double grid) {
  return grid > 0 ? nearest_tooth(whole(position), 1, grid) : position;
}

CycleResult<void> check_range(Axis axis, double position, const machine::AxisRange& range) {
  if (position >= range.min && position <= range.max) return {};
  return nc_error(1101, fmt::format("{}{:+.4f} is outside {} to {}", name(axis), position,
                                    range.min, range.max));
}

/// Where the axis is going to stand: at its positions, at 0, at its incidence.
CycleResult<void> check_reach(const AxisPlan& plan, double backlash,
                              const machine::AxisRange& range) {
  std::vector<double> reached{plan.incidence};
  const double beside =
      plan.grid > 0 || plan.strobed || !plan.is_measured() ? 0 : std::abs(backlash);
  const auto reach = [&](double position) {
    reached.push_back(position - beside);
    reached.push_back(position + beside);
  };
  reach(0);
  for (const double position : plan.positions) reach(position);
  for (const double position : reached) {
    if (auto checked = check_range(plan.axis, position, range); !checked) return checked;
  }
  return {};
}

}  // namespace

std::vector<double> measuring_positions(double start, double end, int points, double grid) {
  std::vector<double> positions;
  const int steps = std::max(points - 1, 1);
  for (int k = 0; k < points; ++k) {
    positions.push_back(
        grid > 0 ? nearest_tooth(whole(start) * (steps - k) + whole(end) * k, steps, grid)
                 : start + k * ((end - start) / steps));
  }
  return positions;
}

CycleResult<std::vector<AxisPlan>> plan_positions(const Arguments& arguments,
                                                  const machine::MachineState& state) {
  std::vector<AxisPlan> plans;
  int first = 411;  // start, end, incidence and points of A; four further of B, then of C
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    const int start = first;
    first += 4;
    const auto& range = state.ranges[index(axis)];
    if (!range) continue;
    AxisPlan plan{.axis = axis,
                  .start = arguments.number(start),
                  .end = arguments.number(start + 1),
                  .incidence = on_grid(arguments.number(start + 2), range->hirth_grid_deg),
                  .points = arguments.whole(start + 3),
                  .grid = range->hirth_grid_deg};
    plan.positions = measuring_positions(plan.start, plan.end, plan.points, plan.grid);
    std::erase_if(plan.positions, [](double p) { return std::abs(p) < tolerance::kSameAngle; });
    plan.strobed = state.kinematics_options.strobed[index(axis) - 3];
    if (plan.strobed && state.nose[axis] != 0) {
      return nc_error(1005, fmt::format("{} is positioned by an M function and stands at {:+.4f}: "
                                        "turn it to 0 before the cycle",
                                        name(axis), state.nose[axis]));
    }
    if (auto checked = check_reach(plan, arguments.number_or(432, 0), *range); !checked) {
      return checked.error();
    }
    plans.push_back(std::move(plan));
  }
  if (plans.empty()) return nc_error(1100, "the machine has no rotary axis");
  return plans;
}

}  // namespace fitgauge::probing
