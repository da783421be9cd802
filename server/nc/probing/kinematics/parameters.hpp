#pragma once

#include "nc/probing/parameters.hpp"

/// The parameters and results that cycles 451 to 453 share.
namespace fitgauge::probing::parameter {

inline constexpr CycleParameter kSphereRadius{.id = q(407),
                                              .meaning = "Exact radius of the calibration sphere",
                                              .unit = Unit::Length,
                                              .range = {0.0001, 99.9999}};
inline constexpr CycleParameter kRetractionHeight =
    length(408, "Retraction height before a rotary axis turns, 0 none", 0);
inline constexpr CycleParameter kPrePositioningFeed{.id = q(253),
                                                    .meaning = "Feed for pre-positioning",
                                                    .unit = Unit::Feed,
                                                    .kind = ValueKind::NumberOrMax,
                                                    .range = {0.0001, kLongest},
                                                    .default_value = 750};
inline constexpr CycleParameter kReferenceOfTouches{.id = q(380),
                                                    .meaning = "Angle of the first touch",
                                                    .unit = Unit::Angle,
                                                    .range = {0, 360},
                                                    .default_value = 0};
inline constexpr CycleParameter kTouchesOfSphere =
    choice(423, "Number of touches around the sphere", 3, 8, 4);
inline constexpr CycleParameter kPresetAtSphere = choice(
    431, "Preset at the sphere: 0 no, 1 before, 2 after, 3 before and after measuring", 0, 3, 0);
inline constexpr CycleParameter kBacklashAngle =
    newer(angle(432, "Angle to measure the backlash with, 0 off", 3, 0));

inline constexpr std::array kSphereApproach{kSphereRadius, kSetUpClearance, kRetractionHeight,
                                            kPrePositioningFeed, kReferenceOfTouches};

constexpr double kLargestRotaryAngle = 359.9999;

inline constexpr std::array kRotaryAxes{
    angle(411, "Start angle of A", kLargestRotaryAngle, -90),
    angle(412, "End angle of A", kLargestRotaryAngle, 90),
    angle(413, "Angle of A while other axes are measured", kLargestRotaryAngle, 0),
    choice(414, "Number of positions of A, 0: not measured", 0, 12, 0),
    angle(415, "Start angle of B", kLargestRotaryAngle, -90),
    angle(416, "End angle of B", kLargestRotaryAngle, 90),
    angle(417, "Angle of B while other axes are measured", kLargestRotaryAngle, 0),
    choice(418, "Number of positions of B, 0: not measured", 0, 12, 2),
    angle(419, "Start angle of C", kLargestRotaryAngle, -90),
    angle(420, "End angle of C", kLargestRotaryAngle, 90),
    angle(421, "Angle of C while other axes are measured", kLargestRotaryAngle, 0),
    choice(422, "Number of positions of C, 0: not measured", 0, 12, 2)};

/// Always in mm, in an INCH program too.
inline constexpr std::array<CycleOutput, 9> kKinematicsResults{
    {{141, "Measured standard deviation of A, mm; -1 not measured", Unit::None},
     {142, "Measured standard deviation of B, mm; -1 not measured", Unit::None},
     {143, "Measured standard deviation of C, mm; -1 not measured", Unit::None},
     {144, "Optimised standard deviation of A, mm; -1 not measured", Unit::None},
     {145, "Optimised standard deviation of B, mm; -1 not measured", Unit::None},
     {146, "Optimised standard deviation of C, mm; -1 not measured", Unit::None},
     {147, "Offset error in X, mm", Unit::None},
     {148, "Offset error in Y, mm", Unit::None},
     {149, "Offset error in Z, mm", Unit::None}}};

}  // namespace fitgauge::probing::parameter
