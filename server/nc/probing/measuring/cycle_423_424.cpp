#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/rectangle_probing.hpp"

namespace fitgauge::probing::cycle_423_424 {

using namespace parameter;

constexpr std::array kParameters{coordinate(273, "Nominal centre, main axis"),
                                 coordinate(274, "Nominal centre, secondary axis"),
                                 length(282, "Nominal length, main axis"),
                                 length(283, "Nominal length, secondary axis"),
                                 kMeasuringHeight,
                                 kSetUpClearance,
                                 kClearanceHeight,
                                 kMoveToClearance,
                                 length(284, "Maximum length, main axis", 0),
                                 length(285, "Minimum length, main axis", 0),
                                 length(286, "Maximum length, secondary axis", 0),
                                 length(287, "Minimum length, secondary axis", 0),
                                 kCentreToleranceMain,
                                 kCentreToleranceSecondary,
                                 kMeasuringLog,
                                 kStopOnTolerance,
                                 kMonitoringTool};

constexpr std::array<CycleOutput, 11> kResults{
    {{151, "Centre, main axis", Unit::Length},
     {152, "Centre, secondary axis", Unit::Length},
     {154, "Length, main axis", Unit::Length},
     {155, "Length, secondary axis", Unit::Length},
     {161, "Deviation of the centre, main axis", Unit::Length},
     {162, "Deviation of the centre, secondary axis", Unit::Length},
     {164, "Deviation of the length, main axis", Unit::Length},
     {165, "Deviation of the length, secondary axis", Unit::Length},
     {180, "Good", Unit::None},
     {181, "Rework", Unit::None},
     {182, "Reject", Unit::None}}};

/// Both lengths show one oversize of the tool: their mean corrects it, and the larger one decides
/// on breakage.
ToolCorrection tool_correction(const MeasuredValue& main, const MeasuredValue& secondary) {
  ToolCorrection correction = radius_correction(main);
  const ToolCorrection other = radius_correction(secondary);
  correction.change = to_length((correction.change + other.change).to_mm() / 2);
  if (magnitude(other.deviation) > magnitude(correction.deviation)) {
    correction.deviation = other.deviation;
  }
  return correction;
}

CycleResult<void> measure(const CycleContext& context, Side side) {
  const Arguments& arguments = context.arguments;
  const auto main_limits = TRY(size_limits(arguments, 284, 285));
  const auto secondary_limits = TRY(size_limits(arguments, 286, 287));
  auto motion = TRY(begin_measurement(context));
  const RectanglePlan plan{.side = side,
                           .centre = {arguments.number(273), arguments.number(274)},
                           .length_main = arguments.number(282),
                           .length_secondary = arguments.number(283),
                           .height = arguments.number(261),
                           .start_distance = motion.start_distance(arguments.number(320)),
                           .via_clearance = arguments.whole(301) == 1};
  const auto rectangle = TRY(probe_rectangle(context, motion, plan, arguments.number(260)));

  const bool inside = side == Side::Inside;
  const MeasuredValue main{.characteristic = "Length, main axis",
                           .role = size_role(side),
                           .nominal = to_length(plan.length_main),
                           .measured = to_length(rectangle.length_main),
                           .limits = main_limits,
                           .result_q = 154,
                           .deviation_q = 164,
                           .error_too_large = inside ? 1052 : 1056,
                           .error_too_small = inside ? 1050 : 1054};
  const MeasuredValue secondary{.characteristic = "Length, secondary axis",
                                .role = size_role(side),
                                .nominal = to_length(plan.length_secondary),
                                .measured = to_length(rectangle.length_secondary),
                                .limits = secondary_limits,
                                .result_q = 155,
                                .deviation_q = 165,
                                .error_too_large = inside ? 1053 : 1057,
                                .error_too_small = inside ? 1051 : 1055};
  const auto [centre_main, centre_secondary] = centre_values(arguments, rectangle.centre);
  return finish_measurement(context, {.values = {centre_main, centre_secondary, main, secondary},
                                      .measuring_height = to_length(plan.height),
                                      .correction = tool_correction(main, secondary)});
}

constinit const TouchProbeCycle kCycle423 =
    cycle(423, "MEAS. RECTAN. INSIDE", CycleKind::Measuring, kParameters, kResults,
          errors::kMeasuring | errors::kJudged | errors::kCentre | ErrorSet{1050, 1051, 1052, 1053},
          with<measure, Side::Inside>, "All parameters; moves at measuring height are paraxial.");

constinit const TouchProbeCycle kCycle424 =
    cycle(424, "MEAS. RECTAN. OUTS.", CycleKind::Measuring, kParameters, kResults,
          errors::kMeasuring | errors::kJudged | errors::kCentre | ErrorSet{1054, 1055, 1056, 1057},
          with<measure, Side::Outside>, "All parameters; moves at measuring height are paraxial.");

}  // namespace fitgauge::probing::cycle_423_424
