#pragma once

#include "nc/probing/cycle_descriptor.hpp"

/// The parameters that cycles share, with the input ranges of the control's manuals: coordinates
/// ±99999.9999, lengths and clearances 0 to 99999.9999, angles ±360.
namespace fitgauge::probing::parameter {

inline constexpr double kLongest = 99999.9999;

constexpr CycleParameter coordinate(int number, std::string_view meaning,
                                    std::optional<double> by_default = {}) {
  return {.id = q(number),
          .meaning = meaning,
          .unit = Unit::Length,
          .range = {-kLongest, kLongest},
          .default_value = by_default};
}

constexpr CycleParameter length(int number, std::string_view meaning,
                                std::optional<double> by_default = {}) {
  CycleParameter made = coordinate(number, meaning, by_default);
  made.range.min = 0;
  return made;
}

constexpr CycleParameter angle(int number, std::string_view meaning, double limit = 360,
                               std::optional<double> by_default = {}) {
  return {.id = q(number),
          .meaning = meaning,
          .unit = Unit::Angle,
          .range = {-limit, limit},
          .default_value = by_default};
}

/// A whole number of a few; without a default it must be given.
constexpr CycleParameter choice(int number, std::string_view meaning, double first, double last,
                                std::optional<double> by_default = {}) {
  return {.id = q(number),
          .meaning = meaning,
          .kind = ValueKind::Whole,
          .range = {first, last},
          .default_value = by_default};
}

/// Marks a parameter that cycle blocks of older controls lack.
constexpr CycleParameter newer(CycleParameter parameter) {
  parameter.newer = true;
  return parameter;
}

/// The parameters or results of one list and then of another.
template <class T, std::size_t A, std::size_t B>
constexpr std::array<T, A + B> join(const std::array<T, A>& first, const std::array<T, B>& second) {
  std::array<T, A + B> all;
  std::ranges::copy(first, all.begin());
  std::ranges::copy(second, all.begin() + A);
  return all;
}

inline constexpr CycleParameter kMeasuringHeight = coordinate(261, "Measuring height");
inline constexpr CycleParameter kSetUpClearance = length(320, "Set-up clearance", 0);
inline constexpr CycleParameter kClearanceHeight = coordinate(260, "Clearance height");
inline constexpr CycleParameter kMoveToClearance =
    choice(301, "Move to clearance height: 0 no, 1 yes", 0, 1, 0);
inline constexpr CycleParameter kMeasuringAxisInPlane =
    choice(272, "Measuring axis: 1 main, 2 secondary", 1, 2);
inline constexpr CycleParameter kMeasuringAxis =
    choice(272, "Measuring axis: 1 main, 2 secondary, 3 probe axis", 1, 3);
inline constexpr CycleParameter kDirection = choice(267, "Traverse direction: -1 or +1", -1, 1);
/// Two points of a line, how they are touched and how the probe gets there: 400, 403 and 420.
constexpr std::array<CycleParameter, 10> line(const CycleParameter& measuring_axis) {
  return {coordinate(263, "1st point, main axis"),
          coordinate(264, "1st point, secondary axis"),
          coordinate(265, "2nd point, main axis"),
          coordinate(266, "2nd point, secondary axis"),
          measuring_axis,
          kDirection,
          kMeasuringHeight,
          kSetUpClearance,
          kClearanceHeight,
          kMoveToClearance};
}

/// A circle and how it is touched: 405, 412, 413, 421 and 422.
constexpr std::array<CycleParameter, 9> circle(const CycleParameter& centre_main,
                                               const CycleParameter& centre_secondary) {
  return {centre_main,
          centre_secondary,
          length(262, "Nominal diameter"),
          angle(325, "Starting angle", 360, 0),
          angle(247, "Stepping angle", 120),
          kMeasuringHeight,
          kSetUpClearance,
          kClearanceHeight,
          kMoveToClearance};
}
inline constexpr CycleParameter kTouches = newer(choice(423, "Number of touches", 3, 4, 4));
inline constexpr CycleParameter kTraverse = newer(choice(365, "Traverse: 0 line, 1 arc", 0, 1, 1));

/// Three holes on a bolt circle: 416 and 430.
inline constexpr std::array kBoltCircle{coordinate(273, "Nominal centre, main axis"),
                                        coordinate(274, "Nominal centre, secondary axis"),
                                        length(262, "Nominal diameter of the bolt circle"),
                                        angle(291, "Angle of the 1st hole"),
                                        angle(292, "Angle of the 2nd hole"),
                                        angle(293, "Angle of the 3rd hole"),
                                        kMeasuringHeight,
                                        kClearanceHeight};

inline constexpr CycleParameter kCentreToleranceMain =
    length(279, "Tolerance of the centre, main axis", 0);
inline constexpr CycleParameter kCentreToleranceSecondary =
    length(280, "Tolerance of the centre, secondary axis", 0);
inline constexpr CycleParameter kMeasuringLog =
    choice(281, "Measuring log: 0 none, 1 file, 2 stop and show", 0, 2, 1);
inline constexpr CycleParameter kStopOnTolerance =
    choice(309, "Stop out of tolerance: 0 no, 1 yes", 0, 1, 0);
inline constexpr CycleParameter kMonitoringTool = {
    .id = q(330),
    .meaning = "Tool to be corrected, number or name, 0 none",
    .kind = ValueKind::NumberOrText,
    .range = {0, 32767.9},
    .default_value = 0};
inline constexpr CycleParameter kReverseTool =
    newer(choice(498, "Reverse tool: 0 no, 1 yes", 0, 1, 0));
inline constexpr CycleParameter kAngleOfIncidence = newer(angle(531, "Angle of incidence", 180, 0));

inline constexpr double kLastRow = 9999;  ///< that Q305 can name
inline constexpr CycleParameter kTableRow =
    choice(305, "Row of the preset or datum table, 0: active at once", 0, kLastRow, 0);
inline constexpr CycleParameter kPresetRow =
    choice(305, "Row of the preset table, 0: active at once", 0, kLastRow, 0);
inline constexpr CycleParameter kReferenceAngle = angle(307, "Angle of the reference line", 360, 0);
inline constexpr CycleParameter kTransfer = choice(
    303, "Measured value transfer: 0 datum table, 1 preset table, -1 of old programs", -1, 1, 1);

/// A parameter of a sub-line, as the dotted cycles have them.
constexpr CycleParameter in_part(std::uint8_t part, CycleParameter parameter) {
  parameter.part = part;
  return parameter;
}
constexpr CycleParameter result_parameter(std::uint8_t part, double last = 1999) {
  return in_part(part, {.id = ParameterId::WordResult,
                        .meaning = "Q parameter for the result",
                        .kind = ValueKind::Whole,
                        .range = {0, last}});
}
constexpr CycleParameter height_parameter(std::uint8_t part) {
  return in_part(part, {.id = ParameterId::WordHeight,
                        .meaning = kClearanceHeight.meaning,
                        .unit = Unit::Length,
                        .range = kClearanceHeight.range});
}

inline constexpr std::array<CycleOutput, 3> kStatusResults{
    {{180, "Good", Unit::None}, {181, "Rework", Unit::None}, {182, "Reject", Unit::None}}};

/// Results of 412, 413 and 416.
inline constexpr std::array<CycleOutput, 3> kPresetCircleResults{
    {{151, "Centre, main axis", Unit::Length},
     {152, "Centre, secondary axis", Unit::Length},
     {153, "Diameter", Unit::Length}}};

/// Results of 410 and 411.
inline constexpr std::array<CycleOutput, 4> kRectangleResults{
    {{151, "Centre, main axis", Unit::Length},
     {152, "Centre, secondary axis", Unit::Length},
     {154, "Length, main axis", Unit::Length},
     {155, "Length, secondary axis", Unit::Length}}};

/// Results of 421, 422 and 430.
inline constexpr std::array kCircleResults = join(
    join(kPresetCircleResults,
         std::array<CycleOutput, 3>{{{161, "Deviation of the centre, main axis", Unit::Length},
                                     {162, "Deviation of the centre, secondary axis", Unit::Length},
                                     {163, "Deviation of the diameter", Unit::Length}}}),
    kStatusResults);

}  // namespace fitgauge::probing::parameter

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
