#pragma once

#include <array>
#include <cstdint>

namespace fitgauge::metrology {

// Private to the library; see limit_gauge_tables.cpp.

/// The upper ends of the size steps, in mm.
inline constexpr std::array kGaugeSteps = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};

/// A value for each step, in tenths of a micrometre.
using GaugeRow = std::array<std::int16_t, kGaugeSteps.size()>;
inline constexpr std::int16_t kNoGaugeValue = -1;

struct ShaftRows {
  GaugeRow inset;
  GaugeRow wear;
  GaugeRow safety;
};

extern const std::array<GaugeRow, 11> kInset;
extern const std::array<GaugeRow, 3> kWear;
extern const std::array<GaugeRow, 11> kSafety;
extern const ShaftRows kShaft5;
extern const GaugeRow kShaftWear6;
extern const std::array<GaugeRow, 5> kFineTolerances;
extern const GaugeRow kTolerance7;

}  // namespace fitgauge::metrology
