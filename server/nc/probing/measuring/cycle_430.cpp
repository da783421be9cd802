#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing::cycle_430 {

using namespace parameter;

constexpr std::array kParameters = join(
    kBoltCircle, std::array{length(288, "Maximum diameter", 0), length(289, "Minimum diameter", 0),
                            kCentreToleranceMain, kCentreToleranceSecondary, kMeasuringLog,
                            kStopOnTolerance, kMonitoringTool});

CycleResult<void> measure(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const auto limits = TRY(size_limits(arguments, 288, 289));
  auto motion = TRY(begin_measurement(context));
  const auto probed = TRY(probe_bolt_circle(context, motion));

  const MeasuredValue diameter{.characteristic = "Diameter",
                               .role = ValueRole::HoleSize,
                               .nominal = to_length(arguments.number(262)),
                               .measured = to_length(2 * probed.circle.radius),
                               .limits = limits,
                               .result_q = 153,
                               .deviation_q = 163,
                               .error_too_large = 1062,
                               .error_too_small = 1063};
  const auto [centre_main, centre_secondary] = centre_values(arguments, probed.circle.centre);
  // The place of holes does not depend on the tool's radius: the tool is only watched for breakage.
  return finish_measurement(context,
                            {.values = {centre_main, centre_secondary, diameter},
                             .measuring_height = to_length(arguments.number(261)),
                             .correction = ToolCorrection{.deviation = diameter.deviation()},
                             .form = probed.form});
}

constinit const TouchProbeCycle kCycle430 =
    cycle(430, "MEAS. BOLT HOLE CIRC", CycleKind::Measuring, kParameters, kCircleResults,
          errors::kMeasuring | errors::kJudged | errors::kCentre | ErrorSet{1062, 1063, 1081},
          measure, "All parameters; Q330 watches for breakage only.");

}  // namespace fitgauge::probing::cycle_430
