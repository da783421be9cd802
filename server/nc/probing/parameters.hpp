#pragma once

#include "nc/probing/cycle_descriptor.hpp"

/// The parameters that cycles share, with the input ranges of the control's manuals: coordinates
/// ±99999.9999, lengths and clearances 0 to 99999.9999, angles ±360.
namespace fitgauge::probing::parameter {

inline constexpr double kLongest = 99999.9999;

/// A parameter by its Q number, or a word.
struct Address {
  constexpr Address(int number) : id(probing::q(number)) {}  // NOLINT: a number is an address
  constexpr Address(ParameterId word) : id(word) {}          // NOLINT: so is a word
  ParameterId id;
};

/// A number in a range.
constexpr CycleParameter ranged(Address address, std::string_view meaning, Unit unit,
                                ValueRange range, std::optional<double> by_default = {},
                                ValueKind kind = ValueKind::Number) {
  return {.id = address.id,
          .meaning = meaning,
          .unit = unit,
          .kind = kind,
          .range = range,
          .default_value = by_default};
}

constexpr CycleParameter coordinate(Address address, std::string_view meaning,
                                    std::optional<double> by_default = {}) {
  return ranged(address, meaning, Unit::Length, {-kLongest, kLongest}, by_default);
}

constexpr CycleParameter length(Address address, std::string_view meaning,
                                std::optional<double> by_default = {}) {
  return ranged(address, meaning, Unit::Length, {0, kLongest}, by_default);
}

constexpr CycleParameter angle(Address address, std::string_view meaning, double limit = 360,
                               std::optional<double> by_default = {}) {
  return ranged(address, meaning, Unit::Angle, {-limit, limit}, by_default);
}

/// A feed; 0 if the control's dialog allows it.
constexpr CycleParameter feed(Address address, std::string_view meaning,
                              std::optional<double> by_default = {}) {
  return ranged(address, meaning, Unit::Feed, {0, kLongest}, by_default, ValueKind::NumberOrMax);
}

/// A number without a unit.
constexpr CycleParameter plain(Address address, std::string_view meaning, double least, double most,
                               std::optional<double> by_default = {}) {
  return ranged(address, meaning, Unit::None, {least, most}, by_default);
}

/// A whole number of a few; without a default it must be given.
constexpr CycleParameter choice(Address address, std::string_view meaning, double first,
                                double last, std::optional<double> by_default = {}) {
  return ranged(address, meaning, Unit::None, {first, last}, by_default, ValueKind::Whole);
}

/// A parameter whose amount must not be less than that.
constexpr CycleParameter at_least(double least, CycleParameter parameter) {
  parameter.range.least = least;
  return parameter;
}

/// Marks a parameter that cycle blocks of older controls lack.
constexpr CycleParameter newer(CycleParameter parameter) {
  parameter.newer = true;
  return parameter;
}

/// A parameter that a block may leave out.
constexpr CycleParameter optional(CycleParameter parameter) {
  parameter.required = false;
  return parameter;
}

/// Coordinates of consecutive numbers.
constexpr auto coordinates(int first, const auto&... meanings) {
  return std::array{coordinate(first++, meanings)...};
}

/// Results of consecutive numbers.
constexpr auto results(int first, Unit unit, const auto&... meanings) {
  return std::array{CycleOutput{static_cast<std::uint16_t>(first++), meanings, unit}...};
}

template <class Row>
constexpr std::array<Row, 1> as_list(const Row& row) {
  return {row};
}
template <class Row, std::size_t N>
constexpr const std::array<Row, N>& as_list(const std::array<Row, N>& list) {
  return list;
}
/// One list of parameters, or of results, from lists and single ones.
constexpr auto list(const auto&... parts) {
  return std::apply([](const auto&... row) { return std::array{row...}; },
                    std::tuple_cat(as_list(parts)...));
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
inline constexpr CycleParameter kDirection =
    at_least(1, choice(267, "Traverse direction: -1 or +1", -1, 1));
/// Two points of a line, how they are touched and how the probe gets there: 400, 403 and 420.
constexpr auto line(const CycleParameter& measuring_axis) {
  return list(coordinates(263, "1st point, main axis", "1st point, secondary axis",
                          "2nd point, main axis", "2nd point, secondary axis"),
              measuring_axis, kDirection, kMeasuringHeight, kSetUpClearance, kClearanceHeight,
              kMoveToClearance);
}

/// A circle and how it is touched: 405, 412, 413, 421 and 422.
constexpr auto circle(const std::array<CycleParameter, 2>& centre) {
  return list(centre, length(262, "Nominal diameter"), angle(325, "Starting angle", 360, 0),
              at_least(5, angle(247, "Stepping angle", 120)), kMeasuringHeight, kSetUpClearance,
              kClearanceHeight, kMoveToClearance);
}
/// Exact radius of a ring, stud or sphere.
constexpr CycleParameter standard_radius(std::string_view meaning) {
  return ranged(407, meaning, Unit::Length, {0.0001, 99.9999});
}
inline constexpr CycleParameter kFirstTouchAngle =
    ranged(380, "Angle of the first touch", Unit::Angle, {0, 360}, 0);
inline constexpr CycleParameter kTouches = newer(choice(423, "Number of touches", 3, 4, 4));
inline constexpr CycleParameter kTraverse = newer(choice(365, "Traverse: 0 line, 1 arc", 0, 1, 1));

/// Three holes on a bolt circle: 416 and 430.
inline constexpr std::array kBoltCircle =
    list(coordinates(273, "Nominal centre, main axis", "Nominal centre, secondary axis"),
         length(262, "Nominal diameter of the bolt circle"), angle(291, "Angle of the 1st hole"),
         angle(292, "Angle of the 2nd hole"), angle(293, "Angle of the 3rd hole"), kMeasuringHeight,
         kClearanceHeight);

inline constexpr CycleParameter kCentreToleranceMain =
    length(279, "Tolerance of the centre, main axis", 0);
inline constexpr CycleParameter kCentreToleranceSecondary =
    length(280, "Tolerance of the centre, secondary axis", 0);
inline constexpr CycleParameter kMeasuringLog =
    choice(281, "Measuring log: 0 none, 1 file, 2 stop and show", 0, 2, 1);
inline constexpr CycleParameter kStopOnTolerance =
    choice(309, "Stop out of tolerance: 0 no, 1 yes", 0, 1, 0);
inline constexpr CycleParameter kMonitoringTool =
    ranged(330, "Tool to be corrected, number or name, 0 none", Unit::None, {0, 32767.9}, 0,
           ValueKind::NumberOrText);
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
  return in_part(part, choice(ParameterId::WordResult, "Q parameter for the result", 0, last));
}
constexpr CycleParameter height_parameter(std::uint8_t part) {
  return in_part(part, coordinate(ParameterId::WordHeight, kClearanceHeight.meaning));
}

/// QS400, as parse_tolerance() reads it.
constexpr CycleParameter tolerance_text(std::string_view meaning) {
  return {.id = q(400), .meaning = meaning, .kind = ValueKind::Text, .required = false};
}

inline constexpr std::array kStatusResults = results(180, Unit::None, "Good", "Rework", "Reject");

/// Results of 412, 413 and 416.
inline constexpr std::array kPresetCircleResults =
    results(151, Unit::Length, "Centre, main axis", "Centre, secondary axis", "Diameter");

/// Results of 410 and 411.
inline constexpr std::array kRectangleResults =
    list(results(151, Unit::Length, "Centre, main axis", "Centre, secondary axis"),
         results(154, Unit::Length, "Length, main axis", "Length, secondary axis"));

/// Results of 421, 422 and 430.
inline constexpr std::array kCircleResults =
    list(kPresetCircleResults,
         results(161, Unit::Length, "Deviation of the centre, main axis",
                 "Deviation of the centre, secondary axis", "Deviation of the diameter"),
         kStatusResults);

}  // namespace fitgauge::probing::parameter

/// Errors that cycles share. Those of single values (1004, 1011) follow from the parameters.
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
/// Errors of the sphere, the retraction, the axes, their ranges, and of what cannot be corrected.
inline constexpr ErrorSet kKinematics{1072, 1082, 1100, 1101, 1102};
/// Errors of a tilted plane, of the tool axis, and of impossible tool data.
inline constexpr ErrorSet kToolMeasuring{1075, 1079, 1109};

}  // namespace fitgauge::probing::errors
