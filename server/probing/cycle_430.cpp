#include <array>

#include "probing/cycles.hpp"
#include "probing/feature_values.hpp"
#include "probing/hole_pattern.hpp"
#include "probing/measurement.hpp"
#include "probing/parameters.hpp"

namespace fitgauge::probing {
namespace {

using namespace parameter;

constexpr std::array kParameters{coordinate(273, "Nominal centre, main axis"),
                                 coordinate(274, "Nominal centre, secondary axis"),
                                 length(262, "Nominal diameter of the bolt circle"),
                                 angle(291, "Angle of the 1st hole"),
                                 angle(292, "Angle of the 2nd hole"),
                                 angle(293, "Angle of the 3rd hole"),
                                 kMeasuringHeight,
                                 kClearanceHeight,
                                 length(288, "Maximum diameter", 0),
                                 length(289, "Minimum diameter", 0),
                                 kCentreToleranceMain,
                                 kCentreToleranceSecondary,
                                 kMeasuringLog,
                                 kStopOnTolerance,
                                 kMonitoringTool};

CycleResult<void> measure(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const auto limits = size_limits(arguments, 288, 289);
  if (!limits) return limits.error();
  auto motion = begin_measurement(context);
  if (!motion) return motion.error();
  const auto nominal = bolt_circle_holes(arguments, {arguments.number(273), arguments.number(274)});
  const auto holes =
      probe_hole_centres(*motion, nominal, arguments.number(261), arguments.number(260));
  if (!holes) return holes.error();
  const auto circle = fit_circle(*holes);
  if (!circle) return circle.error();

  const MeasuredValue diameter{.characteristic = "Diameter",
                               .role = ValueRole::HoleSize,
                               .nominal = to_length(arguments.number(262)),
                               .measured = to_length(2 * circle->radius),
                               .limits = *limits,
                               .result_q = 153,
                               .deviation_q = 163,
                               .error_too_large = 1062,
                               .error_too_small = 1063};
  const auto [centre_main, centre_secondary] = centre_values(arguments, circle->centre);
  // Where holes lie is no matter of the tool's radius: it is only watched for breakage.
  return finish_measurement(context,
                            {.values = {centre_main, centre_secondary, diameter},
                             .measuring_height = to_length(arguments.number(261)),
                             .correction = ToolCorrection{.deviation = diameter.deviation()},
                             .form = circle_form(holes->size(), circle->residual)});
}

}  // namespace

constinit const TouchProbeCycle kCycle430{
    {.number = 430,
     .name = "MEAS. BOLT HOLE CIRC",
     .kind = CycleKind::Measuring,
     .parameters = kParameters,
     .results = kCircleResults,
     .simulated = "All parameters; Q330 watches for breakage only."},
    measure};

}  // namespace fitgauge::probing
