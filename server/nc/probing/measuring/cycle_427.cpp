#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/line_probing.hpp"

namespace fitgauge::probing::cycle_427 {

using namespace parameter;

constexpr std::array kParameters{coordinate(263, "Point, main axis"),
                                 coordinate(264, "Point, secondary axis"),
                                 kMeasuringHeight,
                                 kSetUpClearance,
                                 kMeasuringAxis,
                                 kDirection,
                                 kClearanceHeight,
                                 kMeasuringLog,
                                 coordinate(288, "Maximum coordinate", 0),
                                 coordinate(289, "Minimum coordinate", 0),
                                 kStopOnTolerance,
                                 kMonitoringTool,
                                 kReverseTool,
                                 kAngleOfIncidence};

constexpr std::array<CycleOutput, 5> kResults{{{160, "Measured coordinate", Unit::Length},
                                               {168, "Deviation of the coordinate", Unit::Length},
                                               {180, "Good", Unit::None},
                                               {181, "Rework", Unit::None},
                                               {182, "Reject", Unit::None}}};

CycleResult<void> measure(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const auto limits = TRY(size_limits(arguments, 288, 289));
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
                                        : face_correction(deviation, arguments.whole(267));
  return finish_measurement(context, {.values = {coordinate},
                                      .measuring_height = to_length(arguments.number(261)),
                                      .correction = correction});
}

constinit const TouchProbeCycle kCycle427 =
    cycle(427, "MEASURE COORDINATE", CycleKind::Measuring, kParameters, kResults,
          errors::kMeasuring | errors::kJudged | ErrorSet{1042, 1072}, measure,
          "All other parameters. The nominal coordinate is that of the point (Q263, Q264, "
          "Q261).",
          "Turning tools, which Q498 and Q531 concern: the values are checked and "
          "change nothing.");

}  // namespace fitgauge::probing::cycle_427
