#pragma once

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// The effect of Q330 on the row of the named tool, in the coordinates of the measurement.
struct ToolCorrection {
  enum class Target : std::uint8_t { Radius, Length };
  Target target = Target::Radius;
  Length change{};     ///< added to DR or DL
  Length deviation{};  ///< of the measured value: compared with RBREAK or LBREAK
};

/// Radius error of the tool that cut the feature: half the deviation, added for a hole, subtracted
/// for an outside dimension (decision 8).
ToolCorrection radius_correction(const MeasuredValue& size);

/// Radius error of the tool that cut one face, which was touched in that direction (Q267): if
/// material is missing the tool is larger than its radius in the table (decision 8).
ToolCorrection face_correction(Length deviation, int direction);

/// Length error of the tool that cut a face across the probe axis: a face that is too high was cut
/// by a tool shorter than in the table (decision 8).
ToolCorrection length_correction(Length deviation);

/// Corrects the tool that Q330 names, inside the tolerance too and on top of earlier corrections
/// (decision 8), by what the deviation is without scaling and mirror. Beyond RBREAK or LBREAK it
/// locks the tool. Q330 = 0 does nothing.
/// @errors 1092 the tool table has no such tool; 1065 the tool is locked now.
CycleResult<void> correct_tool(const CycleContext& context, const ToolCorrection& correction);

/// The result of a measuring cycle with status; the values in the order of the log.
struct Measurement {
  std::vector<MeasuredValue> values;
  ToolCorrection correction{};
  std::optional<Form> form{};
};

/// Begins every measuring cycle: resets an active basic rotation, and clears Q180 to Q182 if the
/// cycle has a status.
/// @errors 1108 scaling factors that differ by axis: a circle would be an ellipse; those of
///   ProbingMotion::begin.
CycleResult<ProbingMotion> begin_measurement(const CycleContext& context);

/// Sets the Q parameters of the values.
void publish(CycleHost& host, std::span<const MeasuredValue> values);
/// Judged by the worst of the values that have limits. @pre there are values.
MeasuringRecord record_of(const CycleContext& context, const Measurement& measurement);

/// The end of every measuring cycle: results, status, log (Q281), record, tool correction (Q330),
/// and last the stop of Q309 (decision 6).
/// @errors 1092 and 1065 of the tool; a tolerance stop with the error of the worst value.
CycleResult<void> finish_measurement(const CycleContext& context, const Measurement& measurement);

/// The centre of a measured feature against Q273 ± Q279 and Q274 ± Q280: Q151, Q152, Q161, Q162.
std::array<MeasuredValue, 2> centre_values(const Arguments& arguments, const Vec3& centre);

}  // namespace fitgauge::probing
