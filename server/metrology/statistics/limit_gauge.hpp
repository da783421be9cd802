#pragma once

#include "base/result.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::metrology {

/// The only published scheme: the tables of ISO 1938-1:2015 and 2026 are not public.
inline constexpr std::string_view kLimitGaugeScheme = "ISO/R 1938:1971";

/// Sizes of the gauges for one tolerance: a plug for a hole, a ring or snap gauge for a shaft.
struct LimitGauge {
  iso286::LimitDeviations go;  ///< upper and lower size of a new GO gauge, as lengths
  Length go_wear_limit;        ///< wear limit of a GO gauge
  iso286::LimitDeviations no_go;
};

/// @errors SizeOutOfRange over 500 mm; ClassUndefinedForSize for a grade without values (holes
///   IT6 to IT16, shafts IT5 to IT16), a custom tolerance class, and the one size step whose value
///   the sources disagree about (IT5 shafts, over 250 up to 315 mm).
Result<LimitGauge> limit_gauge(const iso286::LimitsOfSize& limits, std::string_view class_name);

// The numbers of ISO/R 1938:1971 (the same in DIN 7162, GOST 24853-81 and IS 3455), in tenths of a
// micrometre, by nominal size: up to 3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400 and 500 mm.
// Sources: Korotkov, table 3.4 (zzapomni.com, IT6 and IT7); ITRECHNER's tables (IT5 to IT16), their
// misprints put right after the first. tests/unit/metrology/statistics/gauge_test.cpp checks what
// holds between the rows.

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

// z: distance of the new GO gauge inside the limit, by grade from IT6 to IT16.
inline constexpr std::array<GaugeRow, 11> kInset = {{
    {10, 15, 15, 20, 20, 25, 25, 30, 40, 50, 60, 70, 80},                     // IT6
    {15, 20, 20, 25, 30, 35, 40, 50, 60, 70, 80, 100, 110},                   // IT7
    {20, 30, 30, 40, 50, 60, 70, 80, 90, 120, 140, 160, 180},                 // IT8
    {50, 60, 70, 80, 90, 110, 130, 150, 180, 210, 240, 280, 320},             // IT9
    {50, 60, 70, 80, 90, 110, 130, 150, 180, 240, 270, 320, 370},             // IT10
    {100, 120, 140, 160, 190, 220, 250, 280, 320, 400, 450, 500, 550},        // IT11
    {100, 120, 140, 160, 190, 220, 250, 280, 320, 450, 500, 650, 700},        // IT12
    {200, 240, 280, 320, 360, 420, 480, 540, 600, 800, 900, 1000, 1100},      // IT13
    {200, 240, 280, 320, 360, 420, 480, 540, 600, 1000, 1100, 1250, 1450},    // IT14
    {400, 480, 560, 640, 720, 800, 900, 1000, 1100, 1700, 1900, 2100, 2400},  // IT15
    {400, 480, 560, 640, 720, 800, 900, 1000, 1100, 2100, 2400, 2800, 3200},  // IT16
}};

// y: allowed distance of a worn GO gauge outside the limit, IT6 to IT8; 0 for coarser grades.
inline constexpr std::array<GaugeRow, 3> kWear = {{
    {10, 10, 10, 15, 15, 20, 20, 30, 30, 40, 50, 60, 70},   // IT6
    {15, 15, 15, 20, 30, 30, 30, 40, 40, 60, 70, 80, 90},   // IT7
    {30, 30, 30, 40, 40, 50, 50, 60, 60, 70, 90, 90, 110},  // IT8
}};

// alpha: the safety zone above 180 mm, IT6 to IT16.
inline constexpr std::array<GaugeRow, 11> kSafety = {{
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 20, 30, 40, 50},          // IT6
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 30, 40, 60, 70},          // IT7
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 40, 60, 70, 90},          // IT8
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 40, 60, 70, 90},          // IT9
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 70, 90, 110, 140},        // IT10
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 100, 150, 150, 200},      // IT11
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 150, 200, 300, 350},      // IT12
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 250, 350, 450, 550},      // IT13
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 450, 550, 700, 900},      // IT14
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 700, 900, 1100, 1400},    // IT15
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 1100, 1400, 1800, 2200},  // IT16
}};

// Gauges for shafts of IT5 and IT6, if they differ from those for holes. The inset of IT5 up to 315
// mm has no value: it is 4 in one source and 5 in another.
inline constexpr ShaftRows kShaft5 = {{10, 10, 10, 15, 15, 20, 20, 25, 30, 40, -1, 60, 70},
                                      {10, 10, 10, 15, 20, 20, 20, 30, 30, 30, 30, 40, 40},
                                      {0, 0, 0, 0, 0, 0, 0, 0, 0, 10, 15, 25, 30}};
inline constexpr GaugeRow kShaftWear6 = {15, 15, 15, 20, 30, 30, 30, 40, 40, 50, 60, 60, 70};

// Standard tolerances IT1 to IT5 and IT7 (ISO 286-1, table 1), which gauges are made to.
inline constexpr std::array<GaugeRow, 5> kFineTolerances = {{
    {8, 10, 10, 12, 15, 15, 20, 25, 35, 45, 60, 70, 80},           // IT1
    {12, 15, 15, 20, 25, 25, 30, 40, 50, 70, 80, 90, 100},         // IT2
    {20, 25, 25, 30, 40, 40, 50, 60, 80, 100, 120, 130, 150},      // IT3
    {30, 40, 40, 50, 60, 70, 80, 100, 120, 140, 160, 180, 200},    // IT4
    {40, 50, 60, 80, 90, 110, 130, 150, 180, 200, 230, 250, 270},  // IT5
}};
inline constexpr GaugeRow kTolerance7 = {100, 120, 150, 180, 210, 250, 300,
                                         350, 400, 460, 520, 570, 630};

}  // namespace fitgauge::metrology
