#pragma once

#include "nc/probing/cycle_descriptor.hpp"

/// Errors that cycles share, for their descriptors; errors of single values (1004, 1011) follow
/// from the parameters.
namespace fitgauge::probing::errors {

/// Tool axis, tool, touch probe (30 to 33 and 480 to 484: none).
inline constexpr ErrorSet kWithProbe{1001, 1092, 1093};
/// Nothing within reach, too.
inline constexpr ErrorSet kTouching = kWithProbe | ErrorSet{1014};
/// Scaling factors that differ by axis, too.
inline constexpr ErrorSet kMeasuring = kTouching | ErrorSet{1108};
/// Touching without scaling and mirror.
inline constexpr ErrorSet kUnscaled = kTouching | ErrorSet{1007, 1008};
/// Adds the errors of the target of a datum (Q303, Q305).
inline constexpr ErrorSet kDatumTransfer = kUnscaled | ErrorSet{1043, 1078, 1085};
/// Step angle, points on a line.
inline constexpr ErrorSet kCircle{1066, 1067, 1081};
/// Limits that contradict each other, the tool of Q330.
inline constexpr ErrorSet kJudged{1016, 1065};
/// Q309 of a centre.
inline constexpr ErrorSet kCentre{1044, 1045};
/// The sphere, the retraction height, the axes and their ranges, what cannot be corrected.
inline constexpr ErrorSet kKinematics{1072, 1082, 1100, 1101, 1102};
/// A tilted plane, the tool axis, tool data that cannot be.
inline constexpr ErrorSet kToolMeasuring{1075, 1079, 1109};

}  // namespace fitgauge::probing::errors
