#include "nc/probing/calibration/probe_calibration.hpp"

#include "base/length.hpp"
#include "log_templates.hpp"
#include "nc/machine/tables.hpp"
#include "nc/machine/tolerance.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using namespace fmt::literals;

constexpr HtmlLog kCalibrationLog{"TCHPRAUTO.html", "Calibration log",
                                  "Calibration of the touch probe", ""};

std::string row(std::string_view label, double before, double after, bool inch) {
  const Length old_value = to_length(before);
  const Length new_value = to_length(after);
  return fmt::format(templates::calibration::row, "label"_a = label,
                     "before"_a = log_text(old_value, inch), "after"_a = log_text(new_value, inch),
                     "change"_a = log_text(new_value - old_value, inch));
}

/// Adds a calibration of the touch probe to TCHPRAUTO.html beside the program.
/// @param residual the largest distance of a touch from the fitted circle.
/// @errors when the run's output budget is used up.
CycleResult<void> log_calibration(const CycleContext& context, const machine::ProbeSystem& before,
                                  const machine::ProbeSystem& after, Length residual) {
  const CycleDescriptor& cycle = context.descriptor();
  const bool inch = context.host.is_inch();
  const std::string section = fmt::format(
      templates::calibration::section, "cycle"_a = cycle.number, "name"_a = cycle.name,
      "when"_a = date_and_time(context.host), "tool"_a = context.state().tool.number,
      "row"_a = after.data.number,
      "radius"_a = row("Effective ball radius", before.radius, after.radius, inch),
      "main"_a = row("Centre offset CAL_OF1", before.data.cal_of1, after.data.cal_of1, inch),
      "secondary"_a = row("Centre offset CAL_OF2", before.data.cal_of2, after.data.cal_of2, inch),
      "length"_a = row("Effective length", before.length, after.length, inch),
      "residual"_a = log_text(residual, inch));
  return add_section(context.host, kCalibrationLog, section);
}

using machine::MachineState;

CycleResult<void> check_straight(const MachineState& state, machine::Axis probe) {
  if (norm(state.tool_direction() - unit_vector(probe)) <= tolerance::kSameDirection) return {};
  return nc_error(1075, "the probe stands along the probe axis while it is calibrated");
}

CycleResult<double> positive(double value, std::string_view what) {
  if (value > 0) return to_length(value).to_mm();
  return nc_error(1080, fmt::format("{} of {:.4f} mm", what, value));
}

}  // namespace

ProbeCalibrator::ProbeCalibrator(const CycleContext& context, const ProbingMotion& motion)
    : context_(context),
      motion_(motion),
      start_(motion.plane().from_input(context.machine.position().linear)) {}

CycleResult<ProbeCalibrator> ProbeCalibrator::begin(const CycleContext& context) {
  const MachineState& state = context.state();
  TRY(refuse_mirror_and_scaling(state.frames));
  const auto motion = TRY(ProbingMotion::begin(context));
  TRY(check_straight(state, motion.plane().probe));
  return ProbeCalibrator(context, motion);
}

CycleResult<RoundStandard> ProbeCalibrator::touch_around(Side side, Point2 centre, double height) {
  const int points = context_.whole(423);
  constexpr double kTurn = 360;
  const auto touches =
      circle_touches({.side = side,
                      .centre = centre,
                      .diameter = 2 * context_.number(407),
                      .start_angle = context_.number(380),
                      .step = kTurn / points,
                      .points = points,
                      .height = height,
                      .start_distance = motion_.start_distance(context_.number(320)),
                      .via_clearance = context_.number_or(301, 0) == 1});
  const auto contacts = TRY(motion_.touch_all(touches, start_.z));
  const auto circle = TRY(circle_through(contacts, side, 0));
  return RoundStandard{circle.centre, height, circle.radius, circle.residual};
}

CycleResult<ReversalResult> ProbeCalibrator::measure(const Pass& pass) {
  const auto near = TRY(turned(0, pass, {start_.x, start_.y}));
  const auto first = TRY(turned(0, pass, near.centre));
  const auto second = TRY(turned(180, pass, near.centre));
  const RoundStandard mean{
      {(first.centre.x + second.centre.x) / 2, (first.centre.y + second.centre.y) / 2},
      (first.height + second.height) / 2,
      (first.radius + second.radius) / 2,
      std::max(first.residual, second.residual)};
  TRY(move_over(mean.centre));
  const Vec3 error{(second.centre.x - first.centre.x) / 2, (second.centre.y - first.centre.y) / 2,
                   0};
  return ReversalResult{
      mean, context_.state().frames.direction_to_machine(motion_.plane().to_input(error))};
}

CycleResult<RoundStandard> ProbeCalibrator::turned(double spindle_deg, const Pass& pass,
                                                   Point2 near) {
  const auto orient = [this](double degrees) {
    machine::Modes modes = context_.state().modes;
    modes.spindle_deg = degrees;
    return lift(context_.machine.set_modes(modes));
  };
  const double before = context_.state().modes.spindle_deg;
  TRY(orient(spindle_deg));
  auto found = pass(near);
  TRY(orient(before));
  return found;
}

CycleResult<void> ProbeCalibrator::move_over(Point2 centre) {
  return motion_.move_tip(
      machine::AxisWords::linear(motion_.plane().to_input({centre.x, centre.y, start_.z})));
}

std::array<double, 2> ProbeCalibrator::corrected_offset(const Vec3& error) const {
  const MachineState& state = context_.state();
  const Vec3 offset = state.probe_system()->centre_offset(state.tool_axis(), 0) + error;
  const std::size_t up = index(state.tool_axis());
  return {to_length(offset[(up + 1) % 3]).to_mm(), to_length(offset[(up + 2) % 3]).to_mm()};
}

CycleResult<void> ProbeCalibrator::finish(const ProbeCalibration& found) {
  machine::Machine& machine = context_.machine;
  const MachineState& state = machine.state();
  const machine::ProbeSystem before = *state.probe_system();
  machine::ProbeRow row = before.data;
  if (found.centre_offset) {
    row.cal_of1 = found.centre_offset->front();
    row.cal_of2 = found.centre_offset->back();
    row.cal_ang = 0;
  }
  // The effective values include DL and DR of the tool call; DL and DR of the table become zero.
  machine::Tool tool = *state.active_tool();
  if (found.radius) {
    const auto radius = TRY(positive(*found.radius, "effective ball radius"));
    tool.r = radius - state.tool.dr;
    tool.dr = 0;
  }
  if (found.length) {
    const auto length = TRY(positive(*found.length, "effective length"));
    tool.l = length - state.tool.dl;
    tool.dl = 0;
  }
  if (auto written = machine.write_probe(row); !written) return from_machine(written.error());
  if (auto written = machine.write_tool(tool); !written) return from_machine(written.error());
  return log_calibration(context_, before, *state.probe_system(), to_length(found.residual));
}

}  // namespace fitgauge::probing
