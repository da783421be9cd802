#include "nc/program/system_addresses.hpp"
#include "nc/run/channel.hpp"
#include "nc/run/tool_values.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

using machine::Axis;
using machine::CoordinateSystem;
using machine::MachineState;

struct Address {
  int id = 0;
  int nr = 0;
  std::optional<int> index;
};

NcResult<Address> read_address(Channel& channel, klartext::NodeIndex node) {
  Address address;
  const auto operands = channel.program().operands(node);
  for (std::size_t i = 0; i < operands.size(); ++i) {
    if (is_absent(operands[i])) continue;
    const auto value = TRY(whole(channel, operands[i]));
    if (i == 0) address.id = value;
    if (i == 1) address.nr = value;
    if (i == 2) address.index = value;
  }
  return address;
}

NcError unknown(const Address& address) {
  std::string text = fmt::format("ID{} NR{}", address.id, address.nr);
  if (address.index) text += fmt::format(" IDX{}", *address.index);
  return nc_error(text + " is not available");
}

/// IDX 1 to 9: X Y Z A B C U V W. None for an axis that the machine lacks.
std::optional<Axis> axis_of(const Address& address) {
  const int index = address.index.value_or(1);
  if (index < 1 || index > static_cast<int>(machine::kAxes)) return std::nullopt;
  return static_cast<Axis>(index - 1);
}

/// -1, 0, 1, 2: none, X, Y, Z (Q109).
double axis_number(const std::optional<Axis>& axis) {
  return axis ? static_cast<double>(machine::index(*axis)) : -1;
}

using Answer = std::optional<double>;

Answer program_data(const Channel& channel, const Address& address) {
  switch (address.nr) {
    case 1: return channel.calls.main_program().is_inch() ? 1 : 0;
    case 3: return channel.active_cycle.number;
    case 6: return channel.active_cycle.last_probing;
    case 103: {  // whether the block of the active cycle has the parameter Q IDX
      const auto* machining = std::get_if<MachiningDefinition>(&channel.active_cycle.definition);
      if (machining == nullptr || !address.index) return std::nullopt;
      return machining->gives(*address.index) ? 1 : 0;
    }
    case 8: {
      const LinkedProgram* caller = channel.calls.caller();
      return caller != nullptr && caller->is_inch() ? 1 : 0;
    }
    case 110:
    case 111: {
      // Whether the file (110) or directory (111) that QS IDX names exists.
      const auto number = address.index.value_or(-1);
      if (number < 0 || number >= parameter_count(klartext::QSpace::Qs)) return std::nullopt;
      const std::string* name = channel.parameters.string(static_cast<std::uint16_t>(number));
      if (name == nullptr) return std::nullopt;
      const bool is_directory = address.nr == 111;
      const auto path = channel.resolve(is_directory ? *name + "\\x" : *name);
      if (!path) return 0;
      return (is_directory ? channel.files.has_directory(path->directory())
                           : channel.files.revision(*path).has_value())
                 ? 1
                 : 0;
    }
    default: return std::nullopt;
  }
}

Answer machine_data(const Channel& channel, const Address& address) {
  const MachineState& state = channel.machine().state();
  const machine::Modes& modes = state.modes;
  switch (address.nr) {
    case 1: return state.tool.number;
    case 2: return channel.prepared_tool;
    case 3: return axis_number(state.tool.axis);
    case 4: return modes.spindle_rpm;
    case 5: return static_cast<int>(modes.spindle);
    case 8: return modes.coolant ? 1 : 0;
    case 9: return modes.feed_mm_min;
    case 11: return 0;  // no indexed tools
    default: return std::nullopt;
  }
}

/// A row of tool.t; row 0, which every table has, is the empty spindle.
const machine::Tool* find_tool(const MachineState& state, int number) {
  static const machine::Tool kNoTool;
  const machine::Tool* tool = state.tools.find(number);
  return tool == nullptr && number == 0 ? &kNoTool : tool;
}

NcError no_tool(int number) {
  return nc_error(1092, fmt::format("tool {} is not in the tool table", number));
}

Answer tool_data(const MachineState& state, const Address& address) {
  const machine::Tool* tool = find_tool(state, address.index.value_or(state.tool.number));
  if (tool == nullptr) return std::nullopt;
  if (address.nr < 24 || address.nr > 26) return tool_value(*tool, address.nr);
  // CAL_OF1, CAL_OF2, CAL_ANG: of a probe, in its row of tchprobe.tp.
  const machine::ProbeRow* probe = state.probes.find(tool->probe);
  if (probe == nullptr) return std::nullopt;
  if (address.nr == 24) return probe->cal_of1;
  return address.nr == 25 ? probe->cal_of2 : probe->cal_ang;
}

Answer tool_call_data(const MachineState& state, const Address& address) {
  switch (address.nr) {
    case 1: return state.tool.number;
    case 2: return axis_number(state.tool.axis);
    case 3: return state.modes.spindle_rpm;
    case 4: return state.tool.dl;
    case 5: return state.tool.dr;
    case 6: return 0;  // automatic TOOL CALL off
    case 7: return state.tool.dr2;
    default: return std::nullopt;
  }
}

Answer active_tool_data(const MachineState& state, const Address& address) {
  switch (address.nr) {
    case 1: return state.tool_radius();
    case 2: return state.tool_length();
    default: return std::nullopt;
  }
}

Answer transformation_data(const MachineState& state, const Address& address) {
  const machine::Frames& frames = state.frames;
  const auto axis = axis_of(address);
  const bool is_linear = axis && !machine::is_rotary(*axis);
  switch (address.nr) {
    case 1: return frames.preset().basic_rotation_deg.z;
    case 2: return frames.rotation().angle_deg;
    case 3: {
      double bits = 0;
      for (std::size_t i = 0; i < 3; ++i) bits += frames.mirror()[i] ? double(1U << i) : 0;
      return bits;
    }
    case 4: return is_linear ? frames.scaling().factor[machine::index(*axis)] : 1;
    case 5: {
      if (!is_linear) return std::nullopt;
      return frames.plane() ? frames.plane()->spatial_deg[machine::index(*axis)] : 0;
    }
    case 6: return frames.is_tilted() ? -1 : 0;
    case 7: return 0;  // not tilted in Manual
    default: return std::nullopt;
  }
}

Answer shift_data(const MachineState& state, const Address& address) {
  const auto axis = axis_of(address);
  if (!axis) return std::nullopt;
  switch (address.nr) {
    case 2: return state.frames.datum_shift()[*axis];
    case 3: {
      const auto& preset = state.frames.preset();
      const std::size_t i = machine::index(*axis);
      return machine::is_rotary(*axis) ? preset.rotary_offsets_deg[i - 3] : preset.origin[i];
    }
    case 4: return 0;  // no PLC shift
    default: return std::nullopt;
  }
}

Answer limit_data(const MachineState& state, const Address& address) {
  if (address.nr == 5) return 1;  // the limits are active
  const auto axis = axis_of(address);
  if (!axis || !state.ranges[machine::index(*axis)]) return std::nullopt;
  const machine::AxisRange& range = *state.ranges[machine::index(*axis)];
  switch (address.nr) {
    case 2: return range.min;
    case 3: return range.max;
    default: return std::nullopt;
  }
}

Answer position_data(const MachineState& state, const Address& address, CoordinateSystem system) {
  const auto axis = axis_of(address);
  if (!axis) return std::nullopt;
  // Rounds like results of cycles to a nanometre, so that equal positions are equal (decision 21).
  const double steps = machine::is_rotary(*axis) ? 1e7 : 1e6;
  return std::round(state.position(system)[*axis] * steps) / steps + 0.0;
}

Answer tcpm_data(const MachineState& state, const Address& address) {
  switch (address.nr) {
    case 1: return state.modes.tcpm ? -1 : 0;
    case 2: return state.modes.feed_mm_min;
    default: return std::nullopt;
  }
}

/// Returns which of three M functions is on.
Answer m_function_data(const Channel& channel, const Address& address) {
  const machine::Modes& modes = channel.machine().state().modes;
  switch (address.nr) {
    case 116: return modes.feed_at_circumference ? -1 : 0;
    case 128: return modes.tcpm ? -1 : 0;
    case 144: return modes.kinematics_in_display ? -1 : 0;
    default: return std::nullopt;
  }
}

Answer probe_data(const MachineState& state, const Address& address) {
  if (address.nr == 20) {
    const auto axis = axis_of(address);
    return axis && !machine::is_rotary(*axis) ? Answer(state.tt.centre[machine::index(*axis)])
                                              : std::nullopt;
  }
  if (address.nr == 21) return state.tt.radius;
  const auto probe = state.probe_system();
  if (!probe) return std::nullopt;
  const machine::ProbeRow& row = probe->data;
  const bool is_second = address.index == 2;
  switch (address.nr) {
    case 10: return axis_number(state.tool_axis());
    case 11: return probe->radius;
    case 12: return probe->length;
    case 14: return is_second ? row.cal_of2 : row.cal_of1;
    case 15: return row.cal_ang;
    case 50:  // IDX1: the type's number, which TYPE does not give; IDX2: the row of tchprobe.tp
      return is_second ? row.number : 0;
    case 51: return probe->length;
    case 52:  // IDX2: the rounding radius, which a ball does not have
      return is_second ? 0 : probe->radius;
    case 53: return is_second ? row.cal_of2 : row.cal_of1;
    case 54: return row.cal_ang;
    case 55: return is_second ? row.feed : row.rapid;
    case 56: return is_second ? row.set_up : row.distance;
    case 57: return row.track ? 1 : 0;
    default: return std::nullopt;
  }
}

Answer touch_data(const Channel& channel, const Address& address) {
  const auto axis = axis_of(address);
  if (!axis || !channel.last_touch) return std::nullopt;
  const machine::ContactPoint& touch = *channel.last_touch;
  const bool is_linear = !machine::is_rotary(*axis);
  const std::size_t i = machine::index(*axis);
  switch (address.nr) {
    case 1: return is_linear ? Answer(touch.surface[i]) : std::nullopt;
    case 2: return touch.nose[*axis];
    case 3: return is_linear ? Answer(touch.tip[i]) : std::nullopt;
    default: return std::nullopt;
  }
}

/// ID500: the datum table, NR is the row.
NcResult<double> datum_data(const Channel& channel, const Address& address) {
  const auto values = TRY(channel.tables.datum(address.nr));
  const auto axis = axis_of(address);
  if (!axis || !values[*axis]) return unknown(address);
  return *values[*axis];
}

/// ID502 and ID503: the preset table, NR is the row. The kinematics add nothing to a preset here.
NcResult<double> preset_data(const MachineState& state, const Address& address) {
  const machine::Preset* preset = state.presets.find(address.nr);
  const auto axis = axis_of(address);
  if (preset == nullptr || !axis) return unknown(address);
  const std::size_t i = machine::index(*axis);
  return machine::is_rotary(*axis) ? preset->frame.rotary_offsets_deg[i - 3]
                                   : preset->frame.origin[i];
}

Answer find(Channel& channel, const Address& address) {
  const MachineState& state = channel.machine().state();
  switch (address.id) {
    case 10: return program_data(channel, address);
    case 20: return machine_data(channel, address);
    case 50: return tool_data(state, address);
    case 60: return tool_call_data(state, address);
    case 200: return active_tool_data(state, address);
    case 210: return transformation_data(state, address);
    case 220: return shift_data(state, address);
    case 230: return limit_data(state, address);
    case 240:  // the spindle nose, as M91 (decision 22)
      if (address.nr != 1 && address.nr != 8) return std::nullopt;
      return position_data(state, address, CoordinateSystem::Reference);
    case 270:
      if (address.nr != 1) return std::nullopt;
      return position_data(state, address, CoordinateSystem::Input);
    case 280: return tcpm_data(state, address);
    case 310: return m_function_data(channel, address);
    case 320:
      if (address.nr != 1) return std::nullopt;
      return std::floor(static_cast<double>(channel.now().nanoseconds) / 1e9);
    case 350: return probe_data(state, address);
    case 360: return touch_data(channel, address);
    case 505:
      if (address.nr != 1) return std::nullopt;
      return channel.tables.has_datum_table() ? 1 : 0;
    case 990:  // NR 6: cycle 3 probes with the touch probe; NR 16: no block scan
      if (address.nr == 6 || address.nr == 16) return 0;
      return std::nullopt;
    default: return std::nullopt;
  }
}

NcResult<void> write_tool(Channel& channel, const Address& address, double value) {
  const MachineState& state = channel.machine().state();
  const auto number = address.index.value_or(state.tool.number);
  const machine::Tool* found = number == 0 ? nullptr : find_tool(state, number);
  if (found == nullptr) return no_tool(number);
  machine::Tool tool = *found;
  switch (set_tool_value(tool, address.nr, value)) {
    case ToolWrite::Done: break;
    case ToolWrite::Unknown: return unknown(address);
    case ToolWrite::OutOfRange:
      return nc_error(
          fmt::format("ID50 NR{} of tool {}: the column takes a whole number, and not {}",
                      address.nr, number, value));
  }
  TRY(note_lathe_value(channel, tool, address.nr));
  return checked(channel.machine().write_tool(tool));
}

NcResult<void> write_preset(Channel& channel, const Address& address, double value) {
  const auto axis = axis_of(address);
  if (!axis || address.nr < 0 || address.nr > machine::kLastPreset) return unknown(address);
  const machine::Preset* found = channel.machine().state().presets.find(address.nr);
  machine::Preset preset = found != nullptr ? *found : machine::Preset{};
  preset.number = address.nr;
  const std::size_t i = machine::index(*axis);
  if (machine::is_rotary(*axis)) {
    preset.frame.rotary_offsets_deg[i - 3] = value;
  } else {
    preset.frame.origin[i] = value;
  }
  return checked(channel.machine().write_preset(preset));
}

}  // namespace

NcResult<double> read_system_data(Channel& channel, klartext::NodeIndex node) {
  const auto address = TRY(read_address(channel, node));
  if (!has_system_data(address.id, address.nr, false)) return unknown(address);
  if (address.id == 500) return datum_data(channel, address);
  if (address.id == 502 || address.id == 503)
    return preset_data(channel.machine().state(), address);
  if (address.id == 50) {
    const machine::MachineState& state = channel.machine().state();
    const auto number = address.index.value_or(state.tool.number);
    if (find_tool(state, number) == nullptr) return no_tool(number);
  }
  const Answer answer = find(channel, address);
  if (!answer || !std::isfinite(*answer)) return unknown(address);
  return *answer;
}

NcResult<void> write_system_data(Channel& channel, klartext::NodeIndex node, double value) {
  const auto address = TRY(read_address(channel, node));
  if (!has_system_data(address.id, address.nr, true)) return unknown(address);
  switch (address.id) {
    case 50: return write_tool(channel, address, value);
    case 500: {
      const auto axis = axis_of(address);
      if (!axis) return unknown(address);
      machine::AxisWords words;
      words[*axis] = value;
      return channel.tables.write_datum(address.nr, words);
    }
    case 503: return write_preset(channel, address, value);
    default: return unknown(address);
  }
}

}  // namespace fitgauge::interpreter
