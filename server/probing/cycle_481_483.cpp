#include <algorithm>
#include <array>

#include "probing/cycles.hpp"
#include "probing/measured_value.hpp"
#include "probing/parameters.hpp"
#include "probing/probing_motion.hpp"
#include "probing/tool_measuring.hpp"

namespace fitgauge::probing {
namespace {

using namespace parameter;
using machine::Tool;

constexpr std::array kParameters{
    choice(340, "Tool measurement: 0 first, 1 check, 2 check and write nothing", 0, 2, 1),
    kClearanceHeight, choice(341, "Measure the single teeth: 0 no, 1 yes", 0, 1, 0)};

constexpr CycleOutput kLengthDeviation{115, "Deviation of the length", Unit::Length};
constexpr CycleOutput kRadiusDeviation{116, "Deviation of the radius", Unit::Length};
constexpr CycleOutput kToolStatus{199, "Tool: 0 within tolerance, 1 worn, 2 broken", Unit::None};
constexpr std::array k481Results{kLengthDeviation, kToolStatus};
constexpr std::array k482Results{kRadiusDeviation, kToolStatus};
constexpr std::array k483Results{kLengthDeviation, kRadiusDeviation, kToolStatus};

enum class Mode : std::uint8_t { First, Check, CheckOnly };
enum class Status : std::uint8_t { WithinTolerance, Worn, Broken };

/// A column of tool.t that is measured, with those that judge it.
struct Dimension {
  const CycleOutput* result;
  double Tool::*stored;
  double Tool::*delta;
  double Tool::*tolerance;
  double Tool::*breakage;
};
constexpr Dimension kLength{&kLengthDeviation, &Tool::l, &Tool::dl, &Tool::l_tolerance,
                            &Tool::l_breakage};
constexpr Dimension kRadius{&kRadiusDeviation, &Tool::r, &Tool::dr, &Tool::r_tolerance,
                            &Tool::r_breakage};

/// 0 in the tolerance switches a check off; limits are inclusive.
Status judge(Length deviation, double tolerance, double breakage) {
  const auto exceeds = [&](double limit) {
    return to_length(limit) > Length{} && magnitude(deviation) > to_length(limit);
  };
  if (exceeds(breakage)) return Status::Broken;
  return exceeds(tolerance) ? Status::Worn : Status::WithinTolerance;
}

/// How the spindle behaves for each touch: turning for the longest edge, then, with Q341, standing
/// for each tooth.
CycleResult<std::vector<Spindle>> touches_of(const CycleContext& context, bool turns) {
  std::vector<Spindle> touches{turns ? Spindle::Turns : Spindle::Stands};
  if (context.arguments.whole(341) == 0) return touches;
  const Tool& tool = *context.machine.state().active_tool();
  constexpr int kMostTeeth = 20;
  if (tool.teeth < 1 || tool.teeth > kMostTeeth) {
    return nc_error(1109, "Q341 = 1 needs 1 to 20 teeth in the column CUT");
  }
  touches.insert(touches.end(), static_cast<std::size_t>(tool.teeth), Spindle::Stands);
  return touches;
}

/// The length of the tool: the edge that R-OFFS puts over the contact plate.
CycleResult<double> measure_length(const CycleContext& context, ToolProbing& probing) {
  const machine::MachineState& state = context.machine.state();
  const Tool& tool = *state.active_tool();
  const machine::ToolTouchProbe tt = state.tt;
  const auto touches = touches_of(context, tool.r_offset != 0 || state.tool_radius() > tt.radius);
  if (!touches) return touches.error();
  double longest = 0;
  for (const Spindle spindle : *touches) {
    const auto tip = probing.touch_top({tt.centre.x + tool.r_offset, tt.centre.y}, spindle);
    if (!tip) return tip.error();
    longest = std::max(longest, state.tool_length() + *tip - tt.centre.z);
  }
  return longest;
}

CycleResult<double> measure_radius(const CycleContext& context, ToolProbing& probing) {
  const machine::MachineState& state = context.machine.state();
  const machine::ToolTouchProbe tt = state.tt;
  const auto touches = touches_of(context, true);
  if (!touches) return touches.error();
  const double height = tt.centre.z - tt_parameters::kDepth - state.active_tool()->l_offset;
  double largest = 0;
  for (const Spindle spindle : *touches) {
    const auto axis = probing.touch_side({tt.centre.x, tt.centre.y}, height, {1, 0}, spindle);
    if (!axis) return axis.error();
    largest = std::max(largest, *axis - tt.radius);
  }
  return largest;
}

/// Enters a measured value into the tool row as Q340 says, and its deviation into Q115 or Q116.
Status enter(const CycleContext& context, const Dimension& dimension, double measured, Tool& tool) {
  const auto mode = static_cast<Mode>(context.arguments.number(340));
  const Length found = to_length(measured);
  const Length deviation = found - to_length(tool.*dimension.stored);
  context.host.set_q(dimension.result->q, deviation.to_mm(), Unit::Length);
  if (mode == Mode::First) {
    tool.*dimension.stored = found.to_mm();
    tool.*dimension.delta = 0;
    return Status::WithinTolerance;
  }
  if (mode == Mode::Check) tool.*dimension.delta = deviation.to_mm();
  return judge(deviation, tool.*dimension.tolerance, tool.*dimension.breakage);
}

CycleResult<void> finish(const CycleContext& context, Tool tool, Status status) {
  context.host.set_q(kToolStatus.q, static_cast<double>(status), Unit::None);
  if (static_cast<Mode>(context.arguments.number(340)) == Mode::CheckOnly) return {};
  tool.locked = tool.locked || status != Status::WithinTolerance;
  return lift(context.machine.write_tool(tool));
}

CycleResult<void> measure(const CycleContext& context, bool length, bool radius) {
  auto probing = ToolProbing::begin(context, context.arguments.number(260));
  if (!probing) return probing.error();
  Tool tool = *context.machine.state().active_tool();
  Status status = Status::WithinTolerance;
  if (length) {
    const auto measured = measure_length(context, *probing);
    if (!measured) return measured.error();
    status = enter(context, kLength, *measured, tool);
  }
  if (radius) {
    const auto measured = measure_radius(context, *probing);
    if (!measured) return measured.error();
    status = std::max(status, enter(context, kRadius, *measured, tool));
  }
  if (auto moved = probing->retract(); !moved) return moved;
  return finish(context, tool, status);
}

constexpr std::string_view kSimulated =
    "Q340 writes L, R or DL, DR; LTOL, RTOL, LBREAK, RBREAK set Q199 and, unless nothing is to be "
    "written, lock the tool. The feed of a turning tool follows from its radius.";
constexpr std::string_view kNotSimulated =
    "The tool is a cylinder and its teeth are alike: Q341 repeats the touch for each. The state of "
    "the spindle does not change.";

}  // namespace

constinit const TouchProbeCycle kCycle481{
    {.number = 481,
     .name = "CAL. TOOL LENGTH",
     .kind = CycleKind::Tool,
     .parameters = kParameters,
     .results = k481Results,
     .simulated = kSimulated,
     .not_simulated = kNotSimulated},
    [](const CycleContext& context) { return measure(context, true, false); }};

constinit const TouchProbeCycle kCycle482{
    {.number = 482,
     .name = "CAL. TOOL RADIUS",
     .kind = CycleKind::Tool,
     .parameters = kParameters,
     .results = k482Results,
     .simulated = kSimulated,
     .not_simulated = kNotSimulated},
    [](const CycleContext& context) { return measure(context, false, true); }};

constinit const TouchProbeCycle kCycle483{
    {.number = 483,
     .name = "MEASURE TOOL",
     .kind = CycleKind::Tool,
     .parameters = kParameters,
     .results = k483Results,
     .simulated = kSimulated,
     .not_simulated = kNotSimulated},
    [](const CycleContext& context) { return measure(context, true, true); }};

}  // namespace fitgauge::probing
