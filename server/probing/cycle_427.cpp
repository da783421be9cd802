#include <array>

#include "probing/cycles.hpp"
#include "probing/measurement.hpp"
#include "probing/parameters.hpp"
#include "probing/probing_motion.hpp"

namespace fitgauge::probing {
namespace {

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
  const auto limits = size_limits(arguments, 288, 289);
  if (!limits) return limits.error();
  const int direction = arguments.whole(267);
  if (direction == 0) return nc_error(1042, "Q267 must be -1 or +1");
  if (auto prepared = prepare_measurement(context); !prepared) return prepared;
  auto motion = ProbingMotion::begin(context);
  if (!motion) return motion.error();

  const auto axis = static_cast<std::size_t>(arguments.whole(272) - 1);
  const Vec3 nominal{arguments.number(263), arguments.number(264), arguments.number(261)};
  Vec3 along;
  along[axis] = direction;
  const std::array touches{
      Touch{.start = nominal - along * motion->start_distance(arguments.number(320)),
            .direction = along}};
  const auto contacts = motion->touch_all(touches, arguments.number(260));
  if (!contacts) return contacts.error();

  const MeasuredValue coordinate{.characteristic = "Coordinate",
                                 .role = ValueRole::ShaftSize,
                                 .nominal = to_length(nominal[axis]),
                                 .measured = to_length(contacts->front().surface[axis]),
                                 .limits = *limits,
                                 .result_q = 160,
                                 .deviation_q = 168};
  const ToolCorrection correction =
      axis == 2 ? length_correction(coordinate.deviation()) : radius_correction(coordinate);
  return finish_measurement(context, {.values = {coordinate},
                                      .measuring_height = to_length(arguments.number(261)),
                                      .correction = correction});
}

}  // namespace

constinit const TouchProbeCycle kCycle427{
    {.number = 427,
     .name = "MEASURE COORDINATE",
     .kind = CycleKind::Measuring,
     .parameters = kParameters,
     .results = kResults,
     .simulated = "All parameters; Q498 and Q531 concern turning tools and change nothing. The "
                  "nominal coordinate is that of the point (Q263, Q264, Q261)."},
    measure};

}  // namespace fitgauge::probing
