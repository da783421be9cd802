#include "nc/machine/control.hpp"

namespace fitgauge::machine {
Control::Control(const MachineSetup& setup, std::unique_ptr<Axes> axes, Allowance* allowance)
    : axes_(std::move(axes)), allowance_(allowance != nullptr ? *allowance : unlimited_) {
  std::vector<RotaryAxis> rotary;
  for (const Axis axis : kAllAxes) {
    const auto& known = setup.axes[index(axis)];
    if (!known) continue;
    state_.ranges[index(axis)] = AxisRange{known->min, known->max, known->hirth_grid_deg};
    if (is_rotary(axis)) rotary.push_back(known->modelled(axis));
  }
  state_.kinematics_options = setup.kinematics_options;
  state_.kinematics = Kinematics(std::move(rotary));
  for (const ToolSetup& tool : setup.tools) state_.tools.write(tool.row);
  for (const ProbeSetup& probe : setup.probes) state_.probes.write(probe.row);
  state_.tt = setup.tt.known;
  for (const Preset& preset : setup.presets) state_.presets.write(preset);
  state_.active_preset = setup.active_preset;
  if (const Preset* preset = state_.presets.find(setup.active_preset)) {
    state_.frames.set_preset(preset->frame);
  }
  state_.rapid_mm_min = setup.rapid_mm_min;
  state_.nose = axes_->nose();
}

MachineResult<void> Control::call_tool(const ToolCall& call) {
  if (!call.axis && !state_.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  TRY(require(!call.axis || !is_rotary(*call.axis), "the tool axis is X, Y or Z"));
  TRY(require(is_finite({call.dl, call.dr, call.dr2}) && call.spindle_rpm.value_or(0) >= 0,
              "S, DL, DR and DR2 of a tool call are numbers"));
  if (call.number && *call.number != 0) {
    const Tool* tool = state_.tools.find(*call.number);
    if (tool == nullptr) {
      return make_fault(FaultKind::ToolUnknown, "tool {}", *call.number);
    }
    if (tool->locked) return make_fault(FaultKind::ToolLocked, "tool {}", *call.number);
  }
  if (call.number) state_.tool = {*call.number, state_.tool.axis, call.dl, call.dr, call.dr2};
  if (call.axis) state_.tool.axis = call.axis;
  if (call.spindle_rpm) state_.modes.spindle_rpm = *call.spindle_rpm;
  return {};
}

MachineResult<void> Control::write_tool(const Tool& tool) {
  if (!is_finite({tool.l, tool.r, tool.r2}) || !is_finite({tool.dl, tool.dr, tool.dr2})) {
    return make_fault(FaultKind::ValueInvalid, "lengths of tool {}", tool.number);
  }
  state_.tools.write(tool);
  return {};
}

MachineResult<void> Control::write_probe(const ProbeRow& row) {
  if (!is_finite({row.cal_of1, row.cal_of2, row.cal_ang}) ||
      !is_finite({row.feed, row.rapid, row.distance + row.set_up})) {
    return make_fault(FaultKind::ValueInvalid, "values of probe {}", row.number);
  }
  state_.probes.write(row);
  return {};
}

MachineResult<void> Control::write_preset(const Preset& preset) {
  const auto& [origin, rotation, offsets] = preset.frame;
  if (!is_finite(origin) || !is_finite(rotation) || !is_finite(offsets) || preset.number < 0) {
    return make_fault(FaultKind::ValueInvalid, "values of preset {}", preset.number);
  }
  if (preset.number > kLastPreset) {
    return make_fault(FaultKind::ValueInvalid, "preset {}: the last row of the table is {}",
                      preset.number, kLastPreset);
  }
  const Preset* old = state_.presets.find(preset.number);
  if (old != nullptr && old->locked) {
    return make_fault(FaultKind::PresetLocked, "preset {}", preset.number);
  }
  state_.presets.write(preset);
  return {};
}

MachineResult<void> Control::write_tool_touch_probe(const ToolTouchProbe& tt) {
  TRY(require(is_finite(tt.centre) && std::isfinite(tt.radius) && tt.radius > 0,
              "centre and radius of the tool touch probe"));
  state_.tt = tt;
  return {};
}

MachineResult<void> Control::activate_preset(int number) {
  const Preset* preset = state_.presets.find(number);
  if (preset == nullptr) return make_fault(FaultKind::PresetUnknown, "row {}", number);
  state_.active_preset = number;
  state_.frames.reset_transformations();
  state_.frames.set_preset(preset->frame);
  return {};
}

MachineResult<void> Control::set_frames(const Frames& frames) {
  TRY(require(frames.is_valid(), "a frame is not finite or scales by 0"));
  state_.frames = frames;
  refresh_table();
  return {};
}

MachineResult<void> Control::set_modes(const Modes& modes) {
  if (modes.tcpm && !state_.kinematics_options.tcpm) {
    return make_fault(FaultKind::OptionMissing, "TCPM (tcpm_option of the setup)");
  }
  TRY(require(modes.spindle_rpm >= 0 && modes.feed_mm_min >= 0,
              "spindle speed and feed are 0 or more"));
  TRY(require(std::isfinite(modes.spindle_deg), "the spindle is oriented to a finite angle"));
  state_.modes = modes;
  refresh_table();
  return {};
}

MachineResult<void> Control::set_kinematics(const Kinematics& kinematics) {
  for (const RotaryAxis& axis : kinematics.axes()) {
    if (!state_.ranges[index(axis.axis)])
      return make_fault(FaultKind::AxisMissing, name(axis.axis));
    if (!is_finite(axis.centre) || !is_finite(axis.direction)) {
      return make_fault(FaultKind::ValueInvalid, "kinematics of {}", name(axis.axis));
    }
  }
  TRY(require(is_finite(kinematics.offset()), "offset of the kinematics"));
  state_.kinematics = kinematics;
  refresh_table();
  return {};
}

void Control::refresh_table() {
  state_.frames.set_table(is_following() ? table_at(state_.nose.rotary) : Transform{});
}

MachineResult<void> Control::dwell(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) {
    return make_fault(FaultKind::ValueInvalid, "a dwell of {} s", seconds);
  }
  TRY(axes_->dwell(seconds, allowance_));
  spend(seconds);
  return {};
}

}  // namespace fitgauge::machine
