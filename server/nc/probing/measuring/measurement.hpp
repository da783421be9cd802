#pragma once

#include <vector>

#include "nc/probing/measured_value.hpp"
#include "nc/probing/measuring/tool_monitoring.hpp"
#include "nc/probing/touch/probing_motion.hpp"
#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// What a measuring cycle with status has found; the values in the order of the log.
struct Measurement {
  std::vector<MeasuredValue> values;
  std::optional<Length> measuring_height{};  ///< Q261, the last line of the log
  std::optional<ToolCorrection> correction{};
  std::optional<Form> form{};
};

/// What every measuring cycle begins with: resets an active basic rotation and, with a
/// status among its results, clears Q180 to Q182.
/// @errors 1108 scaling factors that differ by axis: a circle would be an ellipse; those of
///   ProbingMotion::begin.
CycleResult<ProbingMotion> begin_measurement(const CycleContext& context);

/// What it ends with: results, status, log (Q281), record, tool correction (Q330), and last the
/// stop of Q309 (decision 6).
/// @errors 1092 and 1065 of the tool; a tolerance stop with the error of the worst value.
CycleResult<void> finish_measurement(const CycleContext& context, const Measurement& measurement);

}  // namespace fitgauge::probing
