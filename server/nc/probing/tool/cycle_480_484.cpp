#include "nc/probing/cycles.hpp"
#include "nc/probing/dotted_parameters.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/tool/tool_measuring.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::cycle_480_484 {

using namespace parameter;

constexpr std::array k30Parameters{height_parameter(1)};
constexpr std::array k480Parameters{kClearanceHeight};
constexpr std::array k484Parameters{choice(536, "Stop before running: 0 stop, 1 no stop", 0, 1, 0)};

/// Two opposite sides of the contact plate.
struct Width {
  double middle;  ///< from the point they were touched around
  double half;    ///< of the way of the tool's axis between them
};

CycleResult<Width> touch_across(ToolProbing& probing, Point2 centre, double height,
                                Point2 outwards) {
  const auto near = TRY(probing.touch_side(centre, height, outwards, Spindle::Stands));
  const auto far =
      TRY(probing.touch_side(centre, height, {-outwards.x, -outwards.y}, Spindle::Stands));
  return Width{(near - far) / 2, (near + far) / 2};
}

/// Touches the top, then X, Y and X again. The first pair meets a disc along a chord, because the
/// centre in Y is still unknown. It gives the centre in X, but not the width.
CycleResult<machine::ToolTouchProbe> touch_plate(ToolProbing& probing, Point2 near,
                                                 double tool_radius) {
  const auto top = TRY(probing.touch_top(near, Spindle::Stands));
  Point2 centre = near;
  double half = 0;
  for (const Point2 outwards : {Point2{1, 0}, Point2{0, 1}, Point2{1, 0}}) {
    const auto width = TRY(touch_across(probing, centre, top - tt_parameters::kDepth, outwards));
    centre = {centre.x + outwards.x * width.middle, centre.y + outwards.y * width.middle};
    half = width.half;
  }
  TRY(probing.retract());
  TRY(probing.move_over(centre));
  return machine::ToolTouchProbe{
      {to_length(centre.x).to_mm(), to_length(centre.y).to_mm(), to_length(top).to_mm()},
      to_length(half - tool_radius).to_mm()};
}

CycleResult<void> calibrate(const CycleContext& context, CycleResult<ToolProbing> probing,
                            Point2 near) {
  if (!probing) return probing.error();
  const machine::MachineState& state = context.machine.state();
  auto found = TRY(touch_plate(*probing, near, state.tool_radius()));
  found.shape = state.tt.shape;
  if (found.radius <= 0)
    return nc_error(1109, "the tool table has a radius R of the calibrating tool too large");
  return lift(context.machine.write_tool_touch_probe(found));
}

CycleResult<void> calibrate_at_known_place(const CycleContext& context) {
  const machine::Vec3& centre = context.machine.state().tt.centre;
  return calibrate(
      context, ToolProbing::begin(context, context.arguments.number(ParameterId::WordHeight, 260)),
      {centre.x, centre.y});
}

CycleResult<void> calibrate_here(const CycleContext& context) {
  if (context.arguments.whole(536) == 0) {
    context.host.stop("position the calibrating tool over the centre of the tool touch probe");
  }
  const machine::Vec3 tip = context.machine.position(machine::CoordinateSystem::Machine).linear;
  return calibrate(context, ToolProbing::begin_here(context), {tip.x, tip.y});
}

constexpr std::string_view kSimulated =
    "Top and four sides with the tool in the spindle, whose L and R are taken as exact: centre and "
    "effective radius of the tool touch probe, for tool measurement and FN 18 ID 350.";
constexpr std::string_view kNotSimulated =
    "Runout of the calibrating tool: it is touched in one position of the spindle.";

constinit const TouchProbeCycle kCycle30 =
    cycle(30, "CALIBRATE TT", CycleKind::Tool, k30Parameters, {},
          errors::kTouching | errors::kToolMeasuring, calibrate_at_known_place, kSimulated,
          kNotSimulated);

constinit const TouchProbeCycle kCycle480 =
    cycle(480, "CALIBRATE TT", CycleKind::Tool, k480Parameters, {},
          errors::kTouching | errors::kToolMeasuring, calibrate_at_known_place, kSimulated,
          kNotSimulated);

constinit const TouchProbeCycle kCycle484 =
    cycle(484, "CALIBRATE IR TT", CycleKind::Tool, k484Parameters, {},
          errors::kTouching | errors::kToolMeasuring, calibrate_here, kSimulated, kNotSimulated);

}  // namespace fitgauge::probing::cycle_480_484
