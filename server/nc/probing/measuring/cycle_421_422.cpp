#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing::cycle_421_422 {

using namespace parameter;

constexpr auto parameters(int max_q, std::string_view max, int min_q, std::string_view min) {
  return join(circle(coordinate(273, "Nominal centre, main axis"),
                     coordinate(274, "Nominal centre, secondary axis")),
              std::array{length(max_q, max, 0), length(min_q, min, 0), kCentreToleranceMain,
                         kCentreToleranceSecondary, kMeasuringLog, kStopOnTolerance,
                         kMonitoringTool, kTouches, kTraverse, kReverseTool, kAngleOfIncidence});
}

constexpr auto k421Parameters =
    parameters(275, "Maximum size of the hole", 276, "Minimum size of the hole");
constexpr auto k422Parameters =
    parameters(277, "Maximum size of the stud", 278, "Minimum size of the stud");

constexpr std::string_view kNotSimulated =
    "Turning tools, which Q498 and Q531 concern: the values are checked and change nothing.";

CycleResult<void> measure(const CycleContext& context, Side side) {
  const Arguments& arguments = context.arguments;
  const bool inside = side == Side::Inside;
  const auto limits =
      TRY(inside ? size_limits(arguments, 275, 276) : size_limits(arguments, 277, 278));
  auto motion = TRY(begin_measurement(context));
  const auto probed =
      TRY(probe_circle(context, motion, side, {arguments.number(273), arguments.number(274)}));

  const MeasuredValue diameter{.characteristic = "Diameter",
                               .role = size_role(side),
                               .nominal = to_length(arguments.number(262)),
                               .measured = to_length(2 * probed.circle.radius),
                               .limits = limits,
                               .result_q = 153,
                               .deviation_q = 163,
                               .error_too_large = inside ? 1047 : 1049,
                               .error_too_small = inside ? 1046 : 1048};
  const auto [centre_main, centre_secondary] = centre_values(arguments, probed.circle.centre);
  return finish_measurement(context, {.values = {centre_main, centre_secondary, diameter},
                                      .measuring_height = to_length(arguments.number(261)),
                                      .correction = radius_correction(diameter),
                                      .form = probed.form});
}

constinit const TouchProbeCycle kCycle421 = cycle(
    421, "MEASURE HOLE", CycleKind::Measuring, k421Parameters, kCircleResults,
    errors::kMeasuring | errors::kCircle | errors::kJudged | errors::kCentre | ErrorSet{1046, 1047},
    with<measure, Side::Inside>, "All other parameters.", kNotSimulated);

constinit const TouchProbeCycle kCycle422 = cycle(
    422, "MEAS. CIRCLE OUTSIDE", CycleKind::Measuring, k422Parameters, kCircleResults,
    errors::kMeasuring | errors::kCircle | errors::kJudged | errors::kCentre | ErrorSet{1048, 1049},
    with<measure, Side::Outside>, "All other parameters.", kNotSimulated);

}  // namespace fitgauge::probing::cycle_421_422
