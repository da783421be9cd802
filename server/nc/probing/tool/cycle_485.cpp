#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/tool/tool_measuring.hpp"

namespace fitgauge::probing::cycle_485 {

constexpr std::array kParameters{kToolMeasurement, parameter::kClearanceHeight};
constexpr CycleOutput kDeviationZ{115, "Deviation of the length in Z", Unit::Length};
constexpr CycleOutput kDeviationX{116, "Deviation of the length in X", Unit::Length};
constexpr std::array kResults{kDeviationZ, kDeviationX, kToolStatus};

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
  const auto axis = TRY(probing.touch_side({beside, tt.centre.y}, height + zl - known.zl,
                                           {static_cast<double>(-direction), 0}, Spindle::Stands));
  return Tip{zl, known.xl + direction * (axis - tt.radius)};
}

CycleResult<void> measure(const CycleContext& context) {
  auto probing = TRY(ToolProbing::begin_lathe(context, context.arguments.number(260)));
  const auto mode = static_cast<ToolMode>(context.arguments.whole(340));
  const auto tip = TRY(touch_tip(probing, context.machine.state()));
  TRY(probing.retract());
  machine::Tool tool = *context.machine.state().active_tool();
  machine::LatheTool& lathe = *tool.lathe;
  const double tolerance = tool.l_tolerance;
  const double breakage = tool.l_breakage;
  const auto z =
      enter(context, mode, {kDeviationZ, lathe.zl, lathe.dzl, tolerance, breakage}, tip.zl);
  const auto x =
      enter(context, mode, {kDeviationX, lathe.xl, lathe.dxl, tolerance, breakage}, tip.xl);
  return write_measured(context, mode, tool, std::max(z, x));
}

constexpr std::string_view kSimulated =
    "The spindle is oriented to ORI, then the round of the cutting edge touches the top of the "
    "cuboid and the side that TO names. A first measurement writes ZL and XL, a check DZL and DXL; "
    "LTOL and LBREAK set the status and, unless nothing is to be written, lock the tool.";
constexpr std::string_view kNotSimulated =
    "The holder, and the edge beside its round. XL has no effect on positioning blocks: they move "
    "the spindle axis.";

constinit const TouchProbeCycle kCycle485 =
    cycle(485, "MEASURE LATHE TOOL", CycleKind::Tool, kParameters, kResults,
          errors::kTouching | errors::kToolMeasuring | ErrorSet{1097}, measure, kSimulated,
          kNotSimulated);

}  // namespace fitgauge::probing::cycle_485
