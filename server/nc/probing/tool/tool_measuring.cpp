#include "nc/probing/tool/tool_measuring.hpp"

#include "nc/machine/tolerance.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::AxisWords;
using machine::CoordinateSystem;
using machine::FaultKind;
using machine::Feed;
using machine::MachineState;
using machine::make_fault;

enum class ToolForm : std::uint8_t { Mill, Lathe };

CycleResult<void> check(const MachineState& state, ToolForm form = ToolForm::Mill) {
  if (!state.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  const machine::Tool* tool = state.active_tool();
  if (tool == nullptr) return make_fault(FaultKind::NoTool);
  if (tool->is_probe()) return nc_error(1093, "tool {} is a touch probe", tool->number);
  if (form == ToolForm::Mill && tool->lathe)
    return nc_error(1093, "tool {} is a lathe tool: 485 measures it", tool->number);
  if (form == ToolForm::Lathe && !tool->lathe)
    return nc_error(1093, "tool {} is no lathe tool: it has no ZL and XL", tool->number);
  if (state.tool.axis != Axis::Z) return nc_error(1079, "the TT is touched along Z");
  const Vec3 up = unit_vector(Axis::Z);
  const Vec3 height = unit(state.frames.direction_to_machine(up));
  if (norm(state.tool_direction(CoordinateSystem::Machine) - up) > tolerance::kSameDirection ||
      norm(height - up) > tolerance::kSameDirection) {
    return nc_error(1075, "the tool is measured upright: reset the tilted plane");
  }
  return {};
}

/// The cuboid, and a tip that reaches it from above or from a side.
CycleResult<void> check_lathe(const MachineState& state) {
  const machine::LatheTool& lathe = *state.active_tool()->lathe;
  if (state.tt.shape != machine::ContactPlate::Cube) {
    return nc_error(1097, "a lathe tool is measured on a cuboid; the tool touch probe has a disc");
  }
  if (lathe.tip_z() <= 0) return {};
  return nc_error(1109,
                  "the tip of tool {} points up (TO {}): the tool touch probe has no side for it",
                  state.tool.number, lathe.orientation);
}

/// 0 in the tolerance switches a check off; limits are inclusive.
ToolStatus judge(Length deviation, double tolerance, double breakage) {
  const auto exceeds = [&](double limit) {
    return to_length(limit) > Length{} && magnitude(deviation) > to_length(limit);
  };
  if (exceeds(breakage)) return ToolStatus::Broken;
  return exceeds(tolerance) ? ToolStatus::Worn : ToolStatus::WithinTolerance;
}

/// The feed of a turning tool: a measuring tolerance each turn, at the speed of its edge.
double probing_feed(double tool_radius, Spindle spindle) {
  using namespace tt_parameters;
  if (spindle == Spindle::Stands) return kProbingFeed;
  constexpr double kMetresPerTurn = 0.0063;  // of a radius of 1 mm
  const double rpm = std::min(kMostRpm, kPeripheralSpeed / (tool_radius * kMetresPerTurn));
  return kMeasuringTolerance * rpm;
}

}  // namespace

ToolStatus enter(const CycleContext& context, ToolMode mode, const Dimension& dimension,
                 double measured) {
  const Length found = to_length(measured);
  const Length deviation = found - to_length(dimension.stored);
  context.host.set_q(dimension.result.q, deviation.to_mm(), Unit::Length);
  if (mode == ToolMode::First) {
    dimension.stored = found.to_mm();
    dimension.delta = 0;
    return ToolStatus::WithinTolerance;
  }
  if (mode == ToolMode::Check) dimension.delta = deviation.to_mm();
  return judge(deviation, dimension.tolerance, dimension.breakage);
}

CycleResult<void> write_measured(const CycleContext& context, ToolMode mode, machine::Tool tool,
                                 ToolStatus status) {
  context.host.set_q(kToolStatus.q, static_cast<double>(status), Unit::None);
  if (mode == ToolMode::CheckOnly) return {};
  tool.locked = tool.locked || status != ToolStatus::WithinTolerance;
  return context.machine.write_tool(tool);
}

CycleResult<ToolProbing> ToolProbing::begin(const CycleContext& context, double clearance_height) {
  const MachineState& state = context.state();
  TRY(check(state));
  const double height = state.frames.to_machine({0, 0, clearance_height}).z;
  const double start = state.tt.centre.z + tt_parameters::kSafetyDistance;
  return ToolProbing(context, std::max(height, start), start);
}

CycleResult<ToolProbing> ToolProbing::begin_lathe(const CycleContext& context,
                                                  double clearance_height) {
  const MachineState& state = context.state();
  TRY(check(state, ToolForm::Lathe));
  TRY(check_lathe(state));
  const machine::LatheTool& lathe = *state.active_tool()->lathe;
  machine::Modes modes = state.modes;
  modes.spindle_deg = lathe.ori;
  TRY(context.machine.set_modes(modes));
  const double start = state.tt.centre.z + tt_parameters::kSafetyDistance + lathe.below_tip();
  const double height = state.frames.to_machine({0, 0, clearance_height}).z;
  return ToolProbing(context, std::max(height, start), start);
}

CycleResult<ToolProbing> ToolProbing::begin_here(const CycleContext& context) {
  const MachineState& state = context.state();
  TRY(check(state));
  const double height = state.position(CoordinateSystem::Machine).linear.z;
  return ToolProbing(context, height, height);
}

CycleResult<double> ToolProbing::touch_top(const Vec3& at, Spindle spindle) {
  TRY(retract());
  TRY(move_over(at));
  TRY(move_to_height(start_height_));
  const auto tip = TRY(probe({0, 0, -1}, spindle));
  return tip.z;
}

CycleResult<double> ToolProbing::touch_side(const Vec3& centre, double tip_height,
                                            const Vec3& outwards, Spindle spindle) {
  const MachineState& state = machine_.state();
  const double away = state.tt.radius + state.tool_radius() + tt_parameters::kSafetyDistance;
  TRY(retract());
  TRY(move_over(centre + outwards * away));
  TRY(move_to_height(tip_height));
  const auto tip = TRY(probe(-outwards, spindle));
  return dot(tip - centre, outwards);
}

CycleResult<void> ToolProbing::retract() { return move_to_height(clearance_height_); }

CycleResult<void> ToolProbing::move_to_height(double height) {
  AxisWords along;
  along[Axis::Z] = height;
  return move(along);
}

CycleResult<void> ToolProbing::move_over(const Vec3& at) {
  AxisWords across;
  across[Axis::X] = at.x;
  across[Axis::Y] = at.y;
  return move(across);
}

CycleResult<void> ToolProbing::move(const AxisWords& target) {
  return machine_.move({target, Feed::rapid(), CoordinateSystem::Machine});
}

CycleResult<Vec3> ToolProbing::probe(const Vec3& direction, Spindle spindle) {
  const MachineState& state = machine_.state();
  const auto contact = machine_.probe({.direction = direction,
                                       .distance = tt_parameters::kLongestProbing,
                                       .feed = probing_feed(state.tool_radius(), spindle),
                                       .system = CoordinateSystem::Machine,
                                       .retract_feed = Feed::rapid()});
  if (contact) return contact->tip_machine;
  if (contact.error().kind != FaultKind::NoContact) return contact.error();
  return nc_error(1014, "tool {} does not reach the tool touch probe within {} mm",
                  state.tool.number, tt_parameters::kLongestProbing);
}

}  // namespace fitgauge::probing
