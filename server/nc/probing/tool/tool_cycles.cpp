#include "nc/probing/cycles.hpp"
#include "nc/probing/tool/tool_measuring.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::tool_cycles {

using machine::Tool;
using namespace parameter;

constexpr std::array k30Parameters{height_parameter(1)};
constexpr std::array k480Parameters{kClearanceHeight};
constexpr std::array k484Parameters{choice(536, "Stop before running: 0 stop, 1 no stop", 0, 1, 0)};

/// Two opposite sides of the contact plate.
struct Width {
  double middle;  ///< from the point they were touched around
  double half;    ///< of the way of the tool's axis between them
};

CycleResult<Width> touch_across(ToolProbing& probing, const Vec3& centre, double height,
                                const Vec3& outwards) {
  const auto near = TRY(probing.touch_side(centre, height, outwards, Spindle::Stands));
  const auto far = TRY(probing.touch_side(centre, height, -outwards, Spindle::Stands));
  return Width{(near - far) / 2, (near + far) / 2};
}

/// Touches the top, then X, Y and X again. The first pair meets a disc along a chord, because the
/// centre in Y is still unknown. It gives the centre in X, but not the width.
CycleResult<machine::ToolTouchProbe> touch_plate(ToolProbing& probing, const Vec3& near,
                                                 double tool_radius) {
  const auto top = TRY(probing.touch_top(near, Spindle::Stands));
  Vec3 centre = near;
  double half = 0;
  for (const Vec3& outwards : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 0, 0}}) {
    const auto width = TRY(touch_across(probing, centre, top - tt_parameters::kDepth, outwards));
    centre = centre + outwards * width.middle;
    half = width.half;
  }
  TRY(probing.retract());
  TRY(probing.move_over(centre));
  return machine::ToolTouchProbe{
      {to_length(centre.x).to_mm(), to_length(centre.y).to_mm(), to_length(top).to_mm()},
      to_length(half - tool_radius).to_mm()};
}

CycleResult<void> calibrate(const CycleContext& context, CycleResult<ToolProbing> probing,
                            const Vec3& near) {
  if (!probing) return probing.error();
  const machine::MachineState& state = context.state();
  auto found = TRY(touch_plate(*probing, near, state.tool_radius()));
  found.shape = state.tt.shape;
  if (found.radius <= 0)
    return nc_error(1109, "the tool table has a radius R of the calibrating tool too large");
  return context.machine.write_tool_touch_probe(found);
}

CycleResult<void> calibrate_at_known_place(const CycleContext& context) {
  return calibrate(context,
                   ToolProbing::begin(context, context.number(ParameterId::WordHeight, 260)),
                   context.state().tt.centre);
}

CycleResult<void> calibrate_here(const CycleContext& context) {
  if (context.whole(536) == 0)
    context.host.stop("position the calibrating tool over the centre of the tool touch probe");
  return calibrate(context, ToolProbing::begin_here(context),
                   context.machine.position(machine::CoordinateSystem::Machine).linear);
}

constexpr std::string_view kCalibrationSimulated =
    "Top and four sides with the tool in the spindle, whose L and R are taken as exact: centre and "
    "effective radius of the tool touch probe, for tool measurement and FN 18 ID 350.";
constexpr std::string_view kRunoutNotSimulated =
    "Runout of the calibrating tool: it is touched in one position of the spindle.";

constexpr std::array kParameters{kToolMeasurement, kClearanceHeight,
                                 choice(341, "Measure the single teeth: 0 no, 1 yes", 0, 1, 0)};

/// 31 to 33: the parameters in sub-lines; CHECK is 0 or 1, and a Q for the status may follow.
constexpr CycleParameter status_parameter() {
  CycleParameter made = result_parameter(1);
  made.meaning = "Q parameter for the status";
  made.required = false;
  return made;
}
constexpr std::array kToolWords = list(
    in_part(1, choice(ParameterId::WordCheck, "Tool measurement: 0 first, 1 check", 0, 1)),
    status_parameter(), height_parameter(2),
    in_part(3, choice(ParameterId::WordTeeth, "Measure the single teeth: 0 no, 1 yes", 0, 1, 0)));
constexpr CycleOutput kLengthDeviation{115, "Deviation of the length", Unit::Length};
constexpr CycleOutput kRadiusDeviation{116, "Deviation of the radius", Unit::Length};
constexpr std::array k481Results{kLengthDeviation, kToolStatus};
constexpr std::array k482Results{kRadiusDeviation, kToolStatus};
constexpr std::array k483Results{kLengthDeviation, kRadiusDeviation, kToolStatus};

ToolMode mode_of(const Arguments& arguments) {
  return static_cast<ToolMode>(arguments.number(ParameterId::WordCheck, 340));
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
  if (context.number(ParameterId::WordTeeth, 341) == 0) return touches;
  const Tool& tool = *context.state().active_tool();
  constexpr int kMostTeeth = 20;
  if (tool.teeth < 1 || tool.teeth > kMostTeeth)
    return nc_error(1109, "single teeth are measured with 1 to 20 of them in the column CUT");
  touches.insert(touches.end(), static_cast<std::size_t>(tool.teeth), Spindle::Stands);
  return touches;
}

/// The length of the tool: the edge that R-OFFS puts over the contact plate.
CycleResult<double> measure_length(const CycleContext& context, ToolProbing& probing) {
  const machine::MachineState& state = context.state();
  const Tool& tool = *state.active_tool();
  const machine::ToolTouchProbe tt = state.tt;
  const auto touches =
      TRY(touches_of(context, tool.r_offset != 0 || state.tool_radius() > tt.radius));
  double longest = 0;
  for (const Spindle spindle : touches) {
    const auto tip = TRY(probing.touch_top(tt.centre + Vec3{tool.r_offset, 0, 0}, spindle));
    longest = std::max(longest, state.tool_length() + tip - tt.centre.z);
  }
  return longest;
}

CycleResult<double> measure_radius(const CycleContext& context, ToolProbing& probing) {
  const machine::MachineState& state = context.state();
  const machine::ToolTouchProbe tt = state.tt;
  const auto touches = TRY(touches_of(context, true));
  const double height = tt.centre.z - tt_parameters::kDepth - state.active_tool()->l_offset;
  double largest = 0;
  for (const Spindle spindle : touches) {
    const auto axis = TRY(probing.touch_side(tt.centre, height, {1, 0, 0}, spindle));
    largest = std::max(largest, axis - tt.radius);
  }
  return largest;
}

CycleResult<void> finish(const CycleContext& context, const Tool& tool, ToolStatus status) {
  if (context.descriptor().dotted && context.has_number(ParameterId::WordResult)) {
    context.host.set_q(static_cast<std::uint16_t>(context.number(ParameterId::WordResult)),
                       static_cast<double>(status), Unit::None);
  }
  return write_measured(context, mode_of(context), tool, status);
}

CycleResult<void> measure(const CycleContext& context, bool length, bool radius) {
  auto probing = TRY(ToolProbing::begin(context, context.number(ParameterId::WordHeight, 260)));
  const ToolMode mode = mode_of(context);
  Tool tool = *context.state().active_tool();
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

/// The cycle of a number in its Q-form or in sub-lines.
constexpr TouchProbeCycle tool_measurement(std::uint16_t number, std::string_view name,
                                           std::span<const CycleOutput> results,
                                           CycleFunction function) {
  const std::span<const CycleParameter> words = kToolWords;
  return cycle(number, name, CycleKind::Tool, number < 100 ? words : kParameters, results,
               errors::kTouching | errors::kToolMeasuring, function, kSimulated, kNotSimulated);
}

constexpr std::array k485Parameters{kToolMeasurement, parameter::kClearanceHeight};
constexpr CycleOutput kDeviationZ{115, "Deviation of the length in Z", Unit::Length};
constexpr CycleOutput kDeviationX{116, "Deviation of the length in X", Unit::Length};
constexpr std::array k485Results{kDeviationZ, kDeviationX, kToolStatus};

/// The distances of the theoretical tip from the spindle nose.
struct Tip {
  double zl;
  double xl;
};

/// Touches the top, then the side of the cuboid that the tip points to, or that X- faces when it
/// points to neither.
CycleResult<Tip> touch_tip(ToolProbing& probing, const machine::MachineState& state) {
  const machine::LatheTool lathe = *state.active_tool()->lathe;
  const machine::ToolTouchProbe tt = state.tt;
  const Tip known{state.tool_length(), lathe.xl + lathe.dxl};
  const double over = tt.centre.x - known.xl + lathe.tip_x() * lathe.rs;
  const auto top = TRY(probing.touch_top({over, tt.centre.y}, Spindle::Stands));
  const double zl = known.zl + top - tt.centre.z - lathe.below_tip();

  const int direction = lathe.tip_x() == 0 ? 1 : lathe.tip_x();
  const double beside = tt.centre.x - known.xl - lathe.beyond_tip(direction);
  const double height = tt.centre.z - tt_parameters::kDepth + lathe.tip_z() * lathe.rs;
  const auto axis =
      TRY(probing.touch_side({beside, tt.centre.y}, height + zl - known.zl,
                             {static_cast<double>(-direction), 0, 0}, Spindle::Stands));
  return Tip{zl, known.xl + direction * (axis - tt.radius)};
}

CycleResult<void> measure_lathe_tool(const CycleContext& context) {
  auto probing = TRY(ToolProbing::begin_lathe(context, context.number(260)));
  const ToolMode mode = mode_of(context);
  const auto tip = TRY(touch_tip(probing, context.state()));
  TRY(probing.retract());
  machine::Tool tool = *context.state().active_tool();
  machine::LatheTool& lathe = *tool.lathe;
  const double tolerance = tool.l_tolerance;
  const double breakage = tool.l_breakage;
  const auto z =
      enter(context, mode, {kDeviationZ, lathe.zl, lathe.dzl, tolerance, breakage}, tip.zl);
  const auto x =
      enter(context, mode, {kDeviationX, lathe.xl, lathe.dxl, tolerance, breakage}, tip.xl);
  return write_measured(context, mode, tool, std::max(z, x));
}

constexpr std::string_view k485Simulated =
    "The spindle is oriented to ORI, then the round of the cutting edge touches the top of the "
    "cuboid and the side that TO names. A first measurement writes ZL and XL, a check DZL and DXL; "
    "LTOL and LBREAK set the status and, unless nothing is to be written, lock the tool.";
constexpr std::string_view k485NotSimulated =
    "The holder, and the edge beside its round. XL has no effect on positioning blocks: they move "
    "the spindle axis.";

constexpr TouchProbeCycle kCycles[] = {
    cycle(30, "CALIBRATE TT", CycleKind::Tool, k30Parameters, {},
          errors::kTouching | errors::kToolMeasuring, calibrate_at_known_place,
          kCalibrationSimulated, kRunoutNotSimulated),
    cycle(480, "CALIBRATE TT", CycleKind::Tool, k480Parameters, {},
          errors::kTouching | errors::kToolMeasuring, calibrate_at_known_place,
          kCalibrationSimulated, kRunoutNotSimulated),
    cycle(484, "CALIBRATE IR TT", CycleKind::Tool, k484Parameters, {},
          errors::kTouching | errors::kToolMeasuring, calibrate_here, kCalibrationSimulated,
          kRunoutNotSimulated),
    tool_measurement(31, "CAL. TOOL LENGTH", k481Results, with<measure, true, false>),
    tool_measurement(32, "CAL. TOOL RADIUS", k482Results, with<measure, false, true>),
    tool_measurement(33, "MEASURE TOOL", k483Results, with<measure, true, true>),
    tool_measurement(481, "CAL. TOOL LENGTH", k481Results, with<measure, true, false>),
    tool_measurement(482, "CAL. TOOL RADIUS", k482Results, with<measure, false, true>),
    tool_measurement(483, "MEASURE TOOL", k483Results, with<measure, true, true>),
    cycle(485, "MEASURE LATHE TOOL", CycleKind::Tool, k485Parameters, k485Results,
          errors::kTouching | errors::kToolMeasuring | ErrorSet{1097}, measure_lathe_tool,
          k485Simulated, k485NotSimulated)};

}  // namespace fitgauge::probing::tool_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle> fitgauge::probing::kToolCycles =
    tool_cycles::kCycles;
