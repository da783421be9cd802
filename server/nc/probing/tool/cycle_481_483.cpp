#include "nc/probing/cycles.hpp"
#include "nc/probing/dotted_parameters.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/tool/tool_measuring.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::cycle_481_483 {

using namespace parameter;
using machine::Tool;

constexpr std::array kParameters{kToolMeasurement, kClearanceHeight,
                                 choice(341, "Measure the single teeth: 0 no, 1 yes", 0, 1, 0)};

/// 31 to 33: the parameters in sub-lines; CHECK is 0 or 1, and a Q for the status may follow.
constexpr CycleParameter status_parameter() {
  CycleParameter made = result_parameter(1);
  made.meaning = "Q parameter for the status";
  made.required = false;
  return made;
}
constexpr std::array kToolWords{in_part(1, {.id = ParameterId::WordCheck,
                                            .meaning = "Tool measurement: 0 first, 1 check",
                                            .kind = ValueKind::Whole,
                                            .range = {0, 1}}),
                                status_parameter(), height_parameter(2),
                                in_part(3, {.id = ParameterId::WordTeeth,
                                            .meaning = "Measure the single teeth: 0 no, 1 yes",
                                            .kind = ValueKind::Whole,
                                            .range = {0, 1},
                                            .default_value = 0})};

constexpr CycleOutput kLengthDeviation{115, "Deviation of the length", Unit::Length};
constexpr CycleOutput kRadiusDeviation{116, "Deviation of the radius", Unit::Length};
constexpr std::array k481Results{kLengthDeviation, kToolStatus};
constexpr std::array k482Results{kRadiusDeviation, kToolStatus};
constexpr std::array k483Results{kLengthDeviation, kRadiusDeviation, kToolStatus};

/// Request of the block, in both of its forms.
struct ToolOrder {
  ToolMode mode;
  double clearance_height;
  bool single_teeth;
};

ToolOrder tool_order_of(const Arguments& arguments) {
  return {static_cast<ToolMode>(arguments.number(ParameterId::WordCheck, 340)),
          arguments.number(ParameterId::WordHeight, 260),
          arguments.number(ParameterId::WordTeeth, 341) != 0};
}

Dimension length_of(Tool& tool) {
  return {kLengthDeviation, tool.l, tool.dl, tool.l_tolerance, tool.l_breakage};
}
Dimension radius_of(Tool& tool) {
  return {kRadiusDeviation, tool.r, tool.dr, tool.r_tolerance, tool.r_breakage};
}

/// Returns the spindle's behaviour for each touch. It turns for the longest edge. With Q341 it then
/// stands for each tooth.
CycleResult<std::vector<Spindle>> touches_of(const CycleContext& context, bool turns) {
  std::vector<Spindle> touches{turns ? Spindle::Turns : Spindle::Stands};
  if (!tool_order_of(context.arguments).single_teeth) return touches;
  const Tool& tool = *context.machine.state().active_tool();
  constexpr int kMostTeeth = 20;
  if (tool.teeth < 1 || tool.teeth > kMostTeeth) {
    return nc_error(1109, "single teeth are measured with 1 to 20 of them in the column CUT");
  }
  touches.insert(touches.end(), static_cast<std::size_t>(tool.teeth), Spindle::Stands);
  return touches;
}

/// The length of the tool: the edge that R-OFFS puts over the contact plate.
CycleResult<double> measure_length(const CycleContext& context, ToolProbing& probing) {
  const machine::MachineState& state = context.machine.state();
  const Tool& tool = *state.active_tool();
  const machine::ToolTouchProbe tt = state.tt;
  const auto touches =
      TRY(touches_of(context, tool.r_offset != 0 || state.tool_radius() > tt.radius));
  double longest = 0;
  for (const Spindle spindle : touches) {
    const auto tip = TRY(probing.touch_top({tt.centre.x + tool.r_offset, tt.centre.y}, spindle));
    longest = std::max(longest, state.tool_length() + tip - tt.centre.z);
  }
  return longest;
}

CycleResult<double> measure_radius(const CycleContext& context, ToolProbing& probing) {
  const machine::MachineState& state = context.machine.state();
  const machine::ToolTouchProbe tt = state.tt;
  const auto touches = TRY(touches_of(context, true));
  const double height = tt.centre.z - tt_parameters::kDepth - state.active_tool()->l_offset;
  double largest = 0;
  for (const Spindle spindle : touches) {
    const auto axis = TRY(probing.touch_side({tt.centre.x, tt.centre.y}, height, {1, 0}, spindle));
    largest = std::max(largest, axis - tt.radius);
  }
  return largest;
}

CycleResult<void> finish(const CycleContext& context, const Tool& tool, ToolStatus status) {
  const Arguments& arguments = context.arguments;
  if (arguments.descriptor().dotted && arguments.has_number(ParameterId::WordResult)) {
    context.host.set_q(static_cast<std::uint16_t>(arguments.number(ParameterId::WordResult)),
                       static_cast<double>(status), Unit::None);
  }
  return write_measured(context, tool_order_of(arguments).mode, tool, status);
}

CycleResult<void> measure(const CycleContext& context, bool length, bool radius) {
  auto probing =
      TRY(ToolProbing::begin(context, tool_order_of(context.arguments).clearance_height));
  const ToolMode mode = tool_order_of(context.arguments).mode;
  Tool tool = *context.machine.state().active_tool();
  ToolStatus status = ToolStatus::WithinTolerance;
  if (length) {
    const auto measured = TRY(measure_length(context, probing));
    status = enter(context, mode, length_of(tool), measured);
  }
  if (radius) {
    const auto measured = TRY(measure_radius(context, probing));
    status = std::max(status, enter(context, mode, radius_of(tool), measured));
  }
  TRY(probing.retract());
  return finish(context, tool, status);
}

constexpr std::string_view kSimulated =
    "A first measurement writes L and R, a check DL and DR; LTOL, RTOL, LBREAK, RBREAK set the "
    "status and, unless nothing is to be written, lock the tool. The feed of a turning tool "
    "follows from its radius.";
constexpr std::string_view kNotSimulated =
    "The tool is a cylinder and its teeth are alike: measuring single teeth repeats the touch for "
    "each. The state of the spindle does not change.";

CycleResult<void> measure_tool_length(const CycleContext& context) {
  return measure(context, true, false);
}
CycleResult<void> measure_tool_radius(const CycleContext& context) {
  return measure(context, false, true);
}
CycleResult<void> measure_tool(const CycleContext& context) { return measure(context, true, true); }

/// The cycle of a number in its Q-form or in sub-lines.
constexpr TouchProbeCycle tool_measurement(std::uint16_t number, std::string_view name,
                                           std::span<const CycleOutput> results,
                                           CycleFunction measure) {
  const std::span<const CycleParameter> words = kToolWords;
  return cycle(number, name, CycleKind::Tool, number < 100 ? words : kParameters, results,
               errors::kTouching | errors::kToolMeasuring, measure, kSimulated, kNotSimulated);
}

constinit const TouchProbeCycle kCycle31 =
    tool_measurement(31, "CAL. TOOL LENGTH", k481Results, measure_tool_length);
constinit const TouchProbeCycle kCycle32 =
    tool_measurement(32, "CAL. TOOL RADIUS", k482Results, measure_tool_radius);
constinit const TouchProbeCycle kCycle33 =
    tool_measurement(33, "MEASURE TOOL", k483Results, measure_tool);
constinit const TouchProbeCycle kCycle481 =
    tool_measurement(481, "CAL. TOOL LENGTH", k481Results, measure_tool_length);
constinit const TouchProbeCycle kCycle482 =
    tool_measurement(482, "CAL. TOOL RADIUS", k482Results, measure_tool_radius);
constinit const TouchProbeCycle kCycle483 =
    tool_measurement(483, "MEASURE TOOL", k483Results, measure_tool);

}  // namespace fitgauge::probing::cycle_481_483
