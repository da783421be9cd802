#include "nc/probing/cycles.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::probing::size_cycles {

using namespace parameter;

constexpr auto circle_parameters(int max_q, std::string_view max, int min_q, std::string_view min) {
  return list(
      circle(coordinates(273, "Nominal centre, main axis", "Nominal centre, secondary axis")),
      length(max_q, max, 0), length(min_q, min, 0), kCentreToleranceMain, kCentreToleranceSecondary,
      kMeasuringLog, kStopOnTolerance, kMonitoringTool, kTouches, kTraverse, kReverseTool,
      kAngleOfIncidence);
}

constexpr std::array k421Parameters =
    circle_parameters(275, "Maximum size of the hole", 276, "Minimum size of the hole");
constexpr std::array k422Parameters =
    circle_parameters(277, "Maximum size of the stud", 278, "Minimum size of the stud");

constexpr std::string_view kNotSimulated =
    "Turning tools, which Q498 and Q531 concern: the values are checked and change nothing.";

/// Ends the measurement of a diameter and its centre. The place of holes does not depend on the
/// tool's radius: without `is_cut` the tool is only watched for breakage.
CycleResult<void> finish_circle(const CycleContext& context, Side side, const ProbedCircle& probed,
                                const std::optional<Limits>& limits, int error_too_large,
                                int error_too_small, bool is_cut) {
  const MeasuredValue diameter{.characteristic = "Diameter",
                               .role = size_role(side),
                               .nominal = to_length(context.number(262)),
                               .measured = to_length(2 * probed.circle.radius),
                               .limits = limits,
                               .result_q = 153,
                               .deviation_q = 163,
                               .error_too_large = error_too_large,
                               .error_too_small = error_too_small};
  const auto [centre_main, centre_secondary] = centre_values(context, probed.circle.centre);
  return finish_measurement(
      context, {.values = {centre_main, centre_secondary, diameter},
                .correction = is_cut ? radius_correction(diameter)
                                     : ToolCorrection{.deviation = diameter.deviation()},
                .form = probed.form});
}

CycleResult<void> measure_circle(const CycleContext& context, Side side) {
  const bool inside = side == Side::Inside;
  const auto limits = TRY(inside ? size_limits(context, 275, 276) : size_limits(context, 277, 278));
  auto motion = TRY(begin_measurement(context));
  const auto probed = TRY(probe_circle(context, motion, side, place_of(context, 273, 274, 261)));
  return finish_circle(context, side, probed, limits, inside ? 1047 : 1049, inside ? 1046 : 1048,
                       true);
}

constexpr std::array k423Parameters =
    list(coordinates(273, "Nominal centre, main axis", "Nominal centre, secondary axis"),
         length(282, "Nominal length, main axis"), length(283, "Nominal length, secondary axis"),
         kMeasuringHeight, kSetUpClearance, kClearanceHeight, kMoveToClearance,
         length(284, "Maximum length, main axis", 0), length(285, "Minimum length, main axis", 0),
         length(286, "Maximum length, secondary axis", 0),
         length(287, "Minimum length, secondary axis", 0), kCentreToleranceMain,
         kCentreToleranceSecondary, kMeasuringLog, kStopOnTolerance, kMonitoringTool);

constexpr std::array k423Results =
    list(kRectangleResults,
         results(161, Unit::Length, "Deviation of the centre, main axis",
                 "Deviation of the centre, secondary axis"),
         results(164, Unit::Length, "Deviation of the length, main axis",
                 "Deviation of the length, secondary axis"),
         kStatusResults);

/// Both lengths show one oversize of the tool: the mean corrects it, the larger decides breakage.
ToolCorrection tool_correction(const MeasuredValue& main, const MeasuredValue& secondary) {
  ToolCorrection correction = radius_correction(main);
  const ToolCorrection other = radius_correction(secondary);
  correction.change = to_length((correction.change + other.change).to_mm() / 2);
  if (magnitude(other.deviation) > magnitude(correction.deviation))
    correction.deviation = other.deviation;
  return correction;
}

CycleResult<void> measure_rectangle(const CycleContext& context, Side side) {
  const auto main_limits = TRY(size_limits(context, 284, 285));
  const auto secondary_limits = TRY(size_limits(context, 286, 287));
  auto motion = TRY(begin_measurement(context));
  const std::array nominal{context.number(282), context.number(283)};
  const auto rectangle =
      TRY(probe_rectangle(context, motion, side, place_of(context, 273, 274, 261), nominal));
  const bool inside = side == Side::Inside;
  const auto value = [&](std::size_t axis, const std::optional<Limits>& limits) {
    const int error = static_cast<int>(axis) + (inside ? 1050 : 1054);
    return MeasuredValue{
        .characteristic = axis == 0 ? "Length, main axis" : "Length, secondary axis",
        .role = size_role(side),
        .nominal = to_length(nominal.at(axis)),
        .measured = to_length(rectangle.length.at(axis)),
        .limits = limits,
        .result_q = static_cast<std::uint16_t>(154 + axis),
        .deviation_q = static_cast<std::uint16_t>(164 + axis),
        .error_too_large = error + 2,
        .error_too_small = error};
  };
  const MeasuredValue main = value(0, main_limits);
  const MeasuredValue secondary = value(1, secondary_limits);
  const auto [centre_main, centre_secondary] = centre_values(context, rectangle.centre);
  return finish_measurement(context, {.values = {centre_main, centre_secondary, main, secondary},
                                      .correction = tool_correction(main, secondary)});
}

constexpr std::array k425Parameters =
    list(coordinates(328, "Starting point, main axis", "Starting point, secondary axis"),
         coordinate(310, "Offset of the 2nd measurement, 0 none", 0), kMeasuringAxisInPlane,
         kMeasuringHeight, kClearanceHeight, length(311, "Nominal length"),
         length(288, "Maximum length", 0), length(289, "Minimum length", 0), kMeasuringLog,
         kStopOnTolerance, kMonitoringTool, newer(kSetUpClearance), newer(kMoveToClearance));

constexpr std::array k426Parameters =
    list(coordinates(263, "1st point, main axis", "1st point, secondary axis",
                     "2nd point, main axis", "2nd point, secondary axis"),
         kMeasuringAxisInPlane, kMeasuringHeight, kSetUpClearance, kClearanceHeight,
         length(311, "Nominal length"), length(288, "Maximum length", 0),
         length(289, "Minimum length", 0), kMeasuringLog, kStopOnTolerance, kMonitoringTool);

constexpr std::array kWidthResults =
    list(results(156, Unit::Length, "Measured length", "Position of the centre line"),
         results(166, Unit::Length, "Deviation of the length"), kStatusResults);

std::size_t measuring_axis(const Arguments& arguments) {
  return static_cast<std::size_t>(arguments.whole(272) - 1);
}

/// From inside the slot: in the positive direction, then in the negative one, moved along by Q310.
std::array<Touch, 2> slot_touches(const Arguments& arguments) {
  const std::size_t axis = measuring_axis(arguments);
  const Vec3 start = place_of(arguments, 328, 329, 261);
  Vec3 up;
  up[axis] = 1;
  Vec3 offset;
  offset[1 - axis] = arguments.number(310);
  const bool via_clearance = arguments.whole(301) == 1 && arguments.number(310) != 0;
  return {Touch{.start = start, .direction = up},
          Touch{.start = start + offset,
                .direction = -up,
                .transit = via_clearance ? Transit::ClearanceHeight : Transit::Straight}};
}

/// From outside, each towards the other point.
std::array<Touch, 2> ridge_touches(const Arguments& arguments, double start_distance) {
  const std::size_t axis = measuring_axis(arguments);
  const Vec3 first = place_of(arguments, 263, 264, 261);
  const Vec3 second = place_of(arguments, 265, 266, 261);
  Vec3 towards;
  towards[axis] = first[axis] < second[axis] ? 1 : -1;
  return {Touch{.start = first - towards * start_distance, .direction = towards},
          Touch{.start = second + towards * start_distance,
                .direction = -towards,
                .transit = Transit::ClearanceHeight}};
}

CycleResult<void> measure_width(const CycleContext& context, Side side) {
  const auto limits = TRY(size_limits(context, 288, 289));
  auto motion = TRY(begin_measurement(context));
  const bool inside = side == Side::Inside;
  const auto touches =
      inside ? slot_touches(context) : ridge_touches(context, motion.start_distance());
  const std::size_t axis = measuring_axis(context);
  const Vec3 centre = (touches[0].start + touches[1].start) * 0.5;
  const auto contacts = TRY(
      touch_part(context, motion, touches, width_place(side, centre, axis, context.number(311))));

  const double first = contacts.front().surface[axis];
  const double second = contacts.back().surface[axis];
  set_lengths(context.host, 157, {(first + second) / 2});
  const MeasuredValue size{.characteristic = "Length",
                           .role = size_role(side),
                           .nominal = to_length(context.number(311)),
                           .measured = to_length(std::abs(first - second)),
                           .limits = limits,
                           .result_q = 156,
                           .deviation_q = 166,
                           .error_too_large = inside ? 1058 : 1060,
                           .error_too_small = inside ? 1059 : 1061};
  return finish_measurement(context, {.values = {size}, .correction = radius_correction(size)});
}

constexpr std::array k427Parameters =
    list(coordinates(263, "Point, main axis", "Point, secondary axis"), kMeasuringHeight,
         kSetUpClearance, kMeasuringAxis, kDirection, kClearanceHeight, kMeasuringLog,
         coordinate(288, "Maximum coordinate", 0), coordinate(289, "Minimum coordinate", 0),
         kStopOnTolerance, kMonitoringTool, kReverseTool, kAngleOfIncidence);

constexpr std::array k427Results =
    list(results(160, Unit::Length, "Measured coordinate"),
         results(168, Unit::Length, "Deviation of the coordinate"), kStatusResults);

CycleResult<void> measure_coordinate(const CycleContext& context) {
  const auto limits = TRY(size_limits(context, 288, 289));
  auto motion = TRY(begin_measurement(context));
  const auto touched = TRY(touch_coordinate(context, motion));

  const MeasuredValue coordinate{.characteristic = "Coordinate",
                                 .role = ValueRole::ShaftSize,
                                 .nominal = to_length(touched.nominal[touched.axis]),
                                 .measured = to_length(touched.surface[touched.axis]),
                                 .limits = limits,
                                 .result_q = 160,
                                 .deviation_q = 168};
  const Length deviation = coordinate.deviation();
  const ToolCorrection correction = touched.axis == 2
                                        ? length_correction(deviation)
                                        : face_correction(deviation, context.whole(267));
  return finish_measurement(context, {.values = {coordinate}, .correction = correction});
}

constexpr std::array k430Parameters =
    list(kBoltCircle, length(288, "Maximum diameter", 0), length(289, "Minimum diameter", 0),
         kCentreToleranceMain, kCentreToleranceSecondary, kMeasuringLog, kStopOnTolerance,
         kMonitoringTool);

CycleResult<void> measure_bolt_circle(const CycleContext& context) {
  const auto limits = TRY(size_limits(context, 288, 289));
  auto motion = TRY(begin_measurement(context));
  const auto probed = TRY(probe_bolt_circle(context, motion));
  return finish_circle(context, Side::Inside, probed, limits, 1062, 1063, false);
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(421, "MEASURE HOLE", CycleKind::Measuring, k421Parameters, kCircleResults,
          errors::kMeasuring | errors::kCircle | errors::kJudged | errors::kCentre |
              ErrorSet{1046, 1047},
          with<measure_circle, Side::Inside>, "All other parameters.", kNotSimulated),
    cycle(422, "MEAS. CIRCLE OUTSIDE", CycleKind::Measuring, k422Parameters, kCircleResults,
          errors::kMeasuring | errors::kCircle | errors::kJudged | errors::kCentre |
              ErrorSet{1048, 1049},
          with<measure_circle, Side::Outside>, "All other parameters.", kNotSimulated),
    cycle(423, "MEAS. RECTAN. INSIDE", CycleKind::Measuring, k423Parameters, k423Results,
          errors::kMeasuring | errors::kJudged | errors::kCentre | ErrorSet{1050, 1051, 1052, 1053},
          with<measure_rectangle, Side::Inside>,
          "All parameters; moves at measuring height are paraxial."),
    cycle(424, "MEAS. RECTAN. OUTS.", CycleKind::Measuring, k423Parameters, k423Results,
          errors::kMeasuring | errors::kJudged | errors::kCentre | ErrorSet{1054, 1055, 1056, 1057},
          with<measure_rectangle, Side::Outside>,
          "All parameters; moves at measuring height are paraxial."),
    cycle(425, "MEASURE INSIDE WIDTH", CycleKind::Measuring, k425Parameters, kWidthResults,
          errors::kMeasuring | errors::kJudged | ErrorSet{1058, 1059},
          with<measure_width, Side::Inside>,
          "All parameters; both touches begin at the starting point, so Q320 moves nothing."),
    cycle(426, "MEASURE RIDGE WIDTH", CycleKind::Measuring, k426Parameters, kWidthResults,
          errors::kMeasuring | errors::kJudged | ErrorSet{1060, 1061},
          with<measure_width, Side::Outside>,
          "All parameters; each point is touched towards the other one."),
    cycle(427, "MEASURE COORDINATE", CycleKind::Measuring, k427Parameters, k427Results,
          errors::kMeasuring | errors::kJudged | ErrorSet{1042, 1072}, measure_coordinate,
          "All other parameters. The nominal coordinate is that of the point (Q263, Q264, Q261).",
          kNotSimulated),
    cycle(430, "MEAS. BOLT HOLE CIRC", CycleKind::Measuring, k430Parameters, kCircleResults,
          errors::kMeasuring | errors::kJudged | errors::kCentre | ErrorSet{1062, 1063, 1081},
          measure_bolt_circle, "All parameters; Q330 watches for breakage only.")};

}  // namespace fitgauge::probing::size_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle> fitgauge::probing::kSizeCycles =
    size_cycles::kCycles;
