#include "nc/machine/machine.hpp"

namespace fitgauge::machine {

Machine::Machine(const MachineSetup& setup, std::unique_ptr<Axes> axes, Allowance* allowance)
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
  if (const Preset* preset = state_.presets.find(setup.active_preset))
    state_.frames.set_preset(preset->frame);
  state_.rapid_mm_min = setup.rapid_mm_min;
  state_.nose = axes_->nose();
}

MachineResult<void> Machine::call_tool(const ToolCall& call) {
  if (!call.axis && !state_.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  TRY(require(!call.axis || !is_rotary(*call.axis), "the tool axis is X, Y or Z"));
  ActiveTool tool = state_.tool;
  if (call.number) tool = {*call.number, tool.axis};
  if (call.axis) tool.axis = call.axis;
  tool.dl = call.dl.value_or(tool.dl);
  tool.dr = call.dr.value_or(tool.dr);
  tool.dr2 = call.dr2.value_or(tool.dr2);
  TRY(require(is_finite({tool.dl, tool.dr, tool.dr2}) && call.spindle_rpm.value_or(0) >= 0,
              "S of a tool call is 0 or more; DL, DR and DR2 are numbers"));
  if (call.number && *call.number != 0) {
    const Tool* row = state_.tools.find(*call.number);
    if (row == nullptr) return make_fault(FaultKind::ToolUnknown, "tool {}", *call.number);
    if (row->locked) return make_fault(FaultKind::ToolLocked, "tool {}", *call.number);
  }
  state_.tool = tool;
  if (call.spindle_rpm) state_.modes.spindle_rpm = *call.spindle_rpm;
  return {};
}

MachineResult<void> Machine::write_tool(const Tool& tool) {
  if (!is_finite({tool.l, tool.r, tool.r2}) || !is_finite({tool.dl, tool.dr, tool.dr2}))
    return make_fault(FaultKind::ValueInvalid, "lengths of tool {}", tool.number);
  state_.tools.write(tool);
  return {};
}

MachineResult<void> Machine::write_probe(const ProbeRow& row) {
  if (!is_finite({row.cal_of1, row.cal_of2, row.cal_ang}) ||
      !is_finite({row.feed, row.rapid, row.distance + row.set_up})) {
    return make_fault(FaultKind::ValueInvalid, "values of probe {}", row.number);
  }
  state_.probes.write(row);
  return {};
}

MachineResult<void> Machine::write_preset(const Preset& preset) {
  const auto& [origin, rotation, offsets] = preset.frame;
  if (!is_finite(origin) || !is_finite(rotation) || !is_finite(offsets) || preset.number < 0)
    return make_fault(FaultKind::ValueInvalid, "values of preset {}", preset.number);
  if (preset.number > kLastPreset) {
    return make_fault(FaultKind::ValueInvalid, "preset {}: the last row of the table is {}",
                      preset.number, kLastPreset);
  }
  const Preset* old = state_.presets.find(preset.number);
  if (old != nullptr && old->locked)
    return make_fault(FaultKind::PresetLocked, "preset {}", preset.number);
  state_.presets.write(preset);
  return {};
}

MachineResult<void> Machine::write_tool_touch_probe(const ToolTouchProbe& tt) {
  TRY(require(is_finite(tt.centre) && std::isfinite(tt.radius) && tt.radius > 0,
              "centre and radius of the tool touch probe"));
  state_.tt = tt;
  return {};
}

MachineResult<void> Machine::activate_preset(int number) {
  const Preset* preset = state_.presets.find(number);
  if (preset == nullptr) return make_fault(FaultKind::PresetUnknown, "row {}", number);
  state_.active_preset = number;
  state_.frames.reset_transformations();
  state_.frames.set_preset(preset->frame);
  return {};
}

MachineResult<void> Machine::set_frames(const Frames& frames) {
  TRY(require(frames.is_valid(), "a frame is not finite or scales by 0"));
  state_.frames = frames;
  refresh_table();
  return {};
}

MachineResult<void> Machine::set_modes(const Modes& modes) {
  if (modes.tcpm && !state_.kinematics_options.tcpm)
    return make_fault(FaultKind::OptionMissing, "TCPM (tcpm_option of the setup)");
  TRY(require(modes.spindle_rpm >= 0 && modes.feed_mm_min >= 0,
              "spindle speed and feed are 0 or more"));
  TRY(require(std::isfinite(modes.spindle_deg), "the spindle is oriented to a finite angle"));
  state_.modes = modes;
  refresh_table();
  return {};
}

MachineResult<void> Machine::set_kinematics(const Kinematics& kinematics) {
  for (const RotaryAxis& axis : kinematics.axes()) {
    if (!state_.ranges[index(axis.axis)])
      return make_fault(FaultKind::AxisMissing, name(axis.axis));
    if (!is_finite(axis.centre) || !is_finite(axis.direction))
      return make_fault(FaultKind::ValueInvalid, "kinematics of {}", name(axis.axis));
  }
  TRY(require(is_finite(kinematics.offset()), "offset of the kinematics"));
  state_.kinematics = kinematics;
  refresh_table();
  return {};
}

void Machine::refresh_table() {
  state_.frames.set_table(is_following() ? state_.kinematics.table(state_.nose.rotary)
                                         : Transform{});
}

MachineResult<void> Machine::dwell(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0)
    return make_fault(FaultKind::ValueInvalid, "a dwell of {} s", seconds);
  TRY(axes_->dwell(seconds, allowance_));
  spend(seconds);
  return {};
}

MachineResult<ContactPoint> Machine::touch(const ProbeMove& move) {
  if (!state_.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  if (state_.active_tool() == nullptr) return make_fault(FaultKind::NoTool);
  TRY(check_feed(Feed::at(move.feed)));
  TRY(check_feed(move.retract_feed));
  const Vec3 along = state_.frames.direction_to_machine(move.direction, move.system);
  const double retract = move.retract.value_or(0);
  TRY(require(is_finite(along) && norm(along) != 0 && std::isfinite(move.distance) &&
                  move.distance > 0 && std::isfinite(retract) && retract >= 0,
              "a probing move needs a direction and a distance"));
  if (!axes_->capabilities().probes)
    return make_fault(FaultKind::OptionMissing, "the machine has no probe input");
  const Vec3 direction = unit(along);
  const double reachable = reach(direction, move.distance);
  const Position start = state_.nose;
  const auto contact = axes_->probe(direction, reachable, motion(Feed::at(move.feed)));
  const bool is_missed = !contact && contact.error().kind == FaultKind::NoContact;
  stand_at(contact ? *contact : axes_->nose());
  if (!contact && !is_missed) return contact.error();

  const double way = is_missed ? reachable : dot(contact->linear - start.linear, direction);
  const double seconds = seconds_of(way, Feed::at(move.feed));
  spend(seconds);
  if (is_missed && reachable < move.distance) {
    return check_range(
               {state_.nose.linear + direction * (move.distance - reachable), state_.nose.rotary})
        .error();
  }
  if (is_missed) return contact.error();

  ContactPoint point = contact_point(direction);
  point.seconds = seconds;
  TRY(go_back(start, direction, move));
  return point;
}

/// The way back, at most to the start, is free, since the ball came along it.
MachineResult<void> Machine::go_back(const Position& start, const Vec3& direction,
                                     const ProbeMove& move) {
  const Position contact = state_.nose;
  const double way = dot(contact.linear - start.linear, direction);
  const double back = move.retract.value_or(way);
  const Position free =
      back < way ? Position{contact.linear - direction * back, contact.rotary} : start;
  // The axes may have stopped beyond the contact.
  return travel(straight_path(axes_->nose(), free), move.retract_feed, true);
}

/// Returns the distance that the nose can move along `direction` inside its ranges, at most
/// `distance`.
double Machine::reach(const Vec3& direction, double distance) const {
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const auto& range = state_.ranges[index(axis)];
    const double part = direction[index(axis)];
    if (!range || part == 0) continue;
    const double end = part > 0 ? range->max : range->min;
    distance = std::min(distance, std::max((end - state_.nose[axis]) / part, 0.0));
  }
  return distance;
}

ContactPoint Machine::contact_point(const Vec3& direction) const {
  const Frames& frames = state_.frames;
  Vec3 centre = state_.ball_centre(CoordinateSystem::Machine);
  if (const auto probe = state_.probe_system())
    centre = centre + probe->centre_offset(state_.tool_axis(), state_.modes.spindle_deg);
  ContactPoint point;
  point.tip_machine =
      centre - state_.tool_direction(CoordinateSystem::Machine) * state_.tool_radius();
  point.tip = frames.from_machine(point.tip_machine);
  point.ball_centre = frames.from_machine(centre);
  point.surface = frames.from_machine(centre + direction * state_.tool_radius());
  point.nose = state_.nose;
  return point;
}

}  // namespace fitgauge::machine
