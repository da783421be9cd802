#pragma once

#include "nc/probing/cycle_descriptor.hpp"

/// Errors that cycles share, for their descriptors. Errors of single values (1004, 1011) follow
/// from the parameters.
namespace fitgauge::probing::errors {

/// Tool axis, tool, touch probe; 30 to 33 and 480 to 484 do not use these.
inline constexpr ErrorSet kWithProbe{1001, 1092, 1093};
/// Adds 1014: nothing is within reach.
inline constexpr ErrorSet kTouching = kWithProbe | ErrorSet{1014};
/// Adds 1108: scaling factors differ by axis.
inline constexpr ErrorSet kMeasuring = kTouching | ErrorSet{1108};
/// Adds 1007 and 1008: cycles that do not allow scaling or mirror.
inline constexpr ErrorSet kUnscaled = kTouching | ErrorSet{1007, 1008};
/// Adds the errors of the target of a datum (Q303, Q305).
inline constexpr ErrorSet kDatumTransfer = kUnscaled | ErrorSet{1043, 1078, 1085};
/// Errors of the step angle and of points on a line.
inline constexpr ErrorSet kCircle{1066, 1067, 1081};
/// Errors of limits that contradict each other, and of the tool in Q330.
inline constexpr ErrorSet kJudged{1016, 1065};
/// Errors of Q309 for a centre.
inline constexpr ErrorSet kCentre{1044, 1045};
/// Errors of the sphere, the retraction height, the axes, their ranges, and values that cannot be
/// corrected.
inline constexpr ErrorSet kKinematics{1072, 1082, 1100, 1101, 1102};
/// Errors of a tilted plane, of the tool axis, and of impossible tool data.
inline constexpr ErrorSet kToolMeasuring{1075, 1079, 1109};

}  // namespace fitgauge::probing::errors
