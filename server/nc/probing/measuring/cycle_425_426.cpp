#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measuring/measurement.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/part_here.hpp"

namespace fitgauge::probing::cycle_425_426 {

using namespace parameter;

constexpr std::array k425Parameters{coordinate(328, "Starting point, main axis"),
                                    coordinate(329, "Starting point, secondary axis"),
                                    coordinate(310, "Offset of the 2nd measurement, 0 none", 0),
                                    kMeasuringAxisInPlane,
                                    kMeasuringHeight,
                                    kClearanceHeight,
                                    length(311, "Nominal length"),
                                    length(288, "Maximum length", 0),
                                    length(289, "Minimum length", 0),
                                    kMeasuringLog,
                                    kStopOnTolerance,
                                    kMonitoringTool,
                                    newer(kSetUpClearance),
                                    newer(kMoveToClearance)};

constexpr std::array k426Parameters{coordinate(263, "1st point, main axis"),
                                    coordinate(264, "1st point, secondary axis"),
                                    coordinate(265, "2nd point, main axis"),
                                    coordinate(266, "2nd point, secondary axis"),
                                    kMeasuringAxisInPlane,
                                    kMeasuringHeight,
                                    kSetUpClearance,
                                    kClearanceHeight,
                                    length(311, "Nominal length"),
                                    length(288, "Maximum length", 0),
                                    length(289, "Minimum length", 0),
                                    kMeasuringLog,
                                    kStopOnTolerance,
                                    kMonitoringTool};

constexpr std::array<CycleOutput, 6> kResults{{{156, "Measured length", Unit::Length},
                                               {157, "Position of the centre line", Unit::Length},
                                               {166, "Deviation of the length", Unit::Length},
                                               {180, "Good", Unit::None},
                                               {181, "Rework", Unit::None},
                                               {182, "Reject", Unit::None}}};

std::size_t measuring_axis(const Arguments& arguments) {
  return static_cast<std::size_t>(arguments.whole(272) - 1);
}

/// From inside the slot: first in the positive direction; then in the negative one, moved along the
/// slot by Q310.
std::array<Touch, 2> slot_touches(const Arguments& arguments) {
  const std::size_t axis = measuring_axis(arguments);
  const Vec3 start{arguments.number(328), arguments.number(329), arguments.number(261)};
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
  const double height = arguments.number(261);
  const Vec3 first{arguments.number(263), arguments.number(264), height};
  const Vec3 second{arguments.number(265), arguments.number(266), height};
  Vec3 towards;
  towards[axis] = first[axis] < second[axis] ? 1 : -1;
  return {Touch{.start = first - towards * start_distance, .direction = towards},
          Touch{.start = second + towards * start_distance,
                .direction = -towards,
                .transit = Transit::ClearanceHeight}};
}

CycleResult<void> measure(const CycleContext& context, Side side) {
  const Arguments& arguments = context.arguments;
  const auto limits = TRY(size_limits(arguments, 288, 289));
  auto motion = TRY(begin_measurement(context));
  const bool inside = side == Side::Inside;
  const auto touches = inside
                           ? slot_touches(arguments)
                           : ridge_touches(arguments, motion.start_distance(arguments.number(320)));
  const std::size_t axis = measuring_axis(arguments);
  const Vec3 centre = (touches[0].start + touches[1].start) * 0.5;
  const auto contacts = TRY(touch_part(context, motion, touches, arguments.number(260),
                                       width_place(side, centre, axis, arguments.number(311))));

  const double first = contacts.front().surface[axis];
  const double second = contacts.back().surface[axis];
  set_length(context.host, 157, (first + second) / 2);
  const MeasuredValue size{.characteristic = "Length",
                           .role = size_role(side),
                           .nominal = to_length(arguments.number(311)),
                           .measured = to_length(std::abs(first - second)),
                           .limits = limits,
                           .result_q = 156,
                           .deviation_q = 166,
                           .error_too_large = inside ? 1058 : 1060,
                           .error_too_small = inside ? 1059 : 1061};
  return finish_measurement(context, {.values = {size},
                                      .measuring_height = to_length(arguments.number(261)),
                                      .correction = radius_correction(size)});
}

constinit const TouchProbeCycle kCycle425 =
    cycle(425, "MEASURE INSIDE WIDTH", CycleKind::Measuring, k425Parameters, kResults,
          errors::kMeasuring | errors::kJudged | ErrorSet{1058, 1059}, with<measure, Side::Inside>,
          "All parameters; both touches begin at the starting point, so Q320 moves nothing.");

constinit const TouchProbeCycle kCycle426 =
    cycle(426, "MEASURE RIDGE WIDTH", CycleKind::Measuring, k426Parameters, kResults,
          errors::kMeasuring | errors::kJudged | ErrorSet{1060, 1061}, with<measure, Side::Outside>,
          "All parameters; each point is touched towards the other one.");

}  // namespace fitgauge::probing::cycle_425_426
