#include "nc/program/link_check.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

struct Address {
  int id = 0;
  int nr = 0;
  std::optional<int> index;
};

NcResult<Address> read_address(Channel& channel, NodeIndex node) {
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
  if (index < 1 || index > static_cast<int>(kAxes)) return std::nullopt;
  return static_cast<Axis>(index - 1);
}

/// -1, 0, 1, 2: none, X, Y, Z (Q109).
double axis_number(const std::optional<Axis>& axis) {
  return axis ? static_cast<double>(index(*axis)) : -1;
}

using Answer = std::optional<double>;

/// Whether the file (NR 110) or directory (111) that QS IDX names exists.
Answer exists(const Channel& channel, const Address& address) {
  const auto number = address.index.value_or(-1);
  if (number < 0 || number >= parameter_count(QSpace::Qs)) return std::nullopt;
  const std::string* name = channel.parameters.string(static_cast<std::uint16_t>(number));
  if (name == nullptr) return std::nullopt;
  const bool is_directory = address.nr == 111;
  const auto path = channel.resolve(is_directory ? *name + "\\x" : *name);
  if (!path) return 0;
  return is_directory ? channel.files.has_directory(path->directory())
                      : channel.files.revision(*path).has_value();
}

/// A row of tool.t; row 0, which every table has, is the empty spindle.
const Tool* find_tool(const MachineState& state, int number) {
  static const Tool kNoTool;
  const Tool* tool = state.tools.find(number);
  return tool == nullptr && number == 0 ? &kNoTool : tool;
}

NcError no_tool(int number) { return nc_error(1092, "tool {} is not in the tool table", number); }

Answer tool_data(const MachineState& state, const Address& address) {
  const Tool* tool = find_tool(state, address.index.value_or(state.tool.number));
  if (tool == nullptr) return std::nullopt;
  if (address.nr < 24 || address.nr > 26) return tool_value(*tool, address.nr);
  // CAL_OF1, CAL_OF2, CAL_ANG: of a probe, in its row of tchprobe.tp.
  const machine::ProbeRow* probe = state.probes.find(tool->probe);
  if (probe == nullptr) return std::nullopt;
  if (address.nr == 24) return probe->cal_of1;
  return address.nr == 25 ? probe->cal_of2 : probe->cal_ang;
}

double position_data(const MachineState& state, Axis axis, CoordinateSystem system) {
  // Rounds like results of cycles to a nanometre, so that equal positions are equal (decision 21).
  const double steps = is_rotary(axis) ? 1e7 : 1e6;
  return std::round(state.position(system)[axis] * steps) / steps + 0.0;
}

/// Data of the touch probe in the spindle.
Answer probe_data(const MachineState& state, const Address& address) {
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

constexpr int key(int id, int nr) { return id * 1000 + nr; }

/// Data of an axis, by IDX.
Answer axis_data(const Channel& channel, const Address& address) {
  const auto axis = axis_of(address);
  if (!axis) return std::nullopt;
  const MachineState& state = channel.state();
  const auto& frames = state.frames;
  const auto& touch = channel.last_touch;
  const auto& range = state.ranges[index(*axis)];
  const bool is_rotary = machine::is_rotary(*axis);
  const std::size_t i = index(*axis) - (is_rotary ? 3 : 0);
  const auto of_linear = [&](const Vec3& values) {
    return is_rotary ? std::nullopt : Answer(values[i]);
  };
  switch (key(address.id, address.nr)) {
    case key(210, 5): return of_linear(frames.plane() ? frames.plane()->spatial_deg : Vec3{});
    case key(220, 2): return frames.datum_shift()[*axis];
    case key(220, 3):
      return is_rotary ? frames.preset().rotary_offsets_deg[i] : frames.preset().origin[i];
    case key(220, 4): return 0;  // no PLC shift
    case key(230, 2): return range ? Answer(range->min) : std::nullopt;
    case key(230, 3): return range ? Answer(range->max) : std::nullopt;
    case key(240, 1):
    case key(240, 8): return position_data(state, *axis, CoordinateSystem::Reference);  // as M91
    case key(270, 1): return position_data(state, *axis, CoordinateSystem::Input);
    case key(350, 20): return of_linear(state.tt.centre);
    case key(360, 1): return touch ? of_linear(touch->surface) : std::nullopt;
    case key(360, 2): return touch ? Answer(touch->nose[*axis]) : std::nullopt;
    case key(360, 3): return touch ? of_linear(touch->tip) : std::nullopt;
    default: return std::nullopt;
  }
}

Answer find(const Channel& channel, const Address& address) {
  const MachineState& state = channel.state();
  const Frames& frames = state.frames;
  const Modes& modes = state.modes;
  const auto axis = axis_of(address);
  switch (key(address.id, address.nr)) {
    case key(10, 1): return channel.calls.main_program().is_inch();
    case key(10, 3): return channel.active_cycle.number;
    case key(10, 6): return channel.active_cycle.last_probing;
    case key(10, 8): return channel.calls.caller() != nullptr && channel.calls.caller()->is_inch();
    case key(10, 103): {  // whether the block of the active cycle has the parameter Q IDX
      const auto* machining = std::get_if<MachiningDefinition>(&channel.active_cycle.definition);
      if (machining == nullptr || !address.index) return std::nullopt;
      return machining->gives(*address.index);
    }
    case key(10, 110):
    case key(10, 111): return exists(channel, address);
    case key(20, 1):
    case key(60, 1): return state.tool.number;
    case key(20, 2): return channel.prepared_tool;
    case key(20, 3):
    case key(60, 2): return axis_number(state.tool.axis);
    case key(20, 4):
    case key(60, 3): return modes.spindle_rpm;
    case key(20, 5): return static_cast<int>(modes.spindle);
    case key(20, 8): return modes.coolant;
    case key(20, 9): return modes.feed_mm_min;
    case key(20, 11): return 0;  // no indexed tools
    case key(60, 4): return state.tool.dl;
    case key(60, 5): return state.tool.dr;
    case key(60, 6): return 0;  // automatic TOOL CALL off
    case key(60, 7): return state.tool.dr2;
    case key(200, 1): return state.tool_radius();
    case key(200, 2): return state.tool_length();
    case key(210, 1): return frames.preset().basic_rotation_deg.z;
    case key(210, 2): return frames.rotation().angle_deg;
    case key(210, 3):
      return (frames.mirror()[0] ? 1 : 0) + (frames.mirror()[1] ? 2 : 0) +
             (frames.mirror()[2] ? 4 : 0);
    case key(210, 4): return axis && !is_rotary(*axis) ? frames.scaling().factor[index(*axis)] : 1;
    case key(210, 6): return frames.is_tilted() ? -1 : 0;
    case key(210, 7): return 0;  // not tilted in Manual
    case key(230, 5): return 1;  // the limits are active
    case key(280, 1):
    case key(310, 128): return modes.tcpm ? -1 : 0;
    case key(280, 2): return modes.feed_mm_min;
    case key(310, 116): return modes.feed_at_circumference ? -1 : 0;
    case key(310, 144): return modes.kinematics_in_display ? -1 : 0;
    case key(320, 1): return std::floor(static_cast<double>(channel.now().nanoseconds) / 1e9);
    case key(350, 21): return state.tt.radius;
    case key(505, 1): return channel.tables.has_datum_table();
    case key(990, 6): return 0;   // cycle 3 probes with the touch probe
    case key(990, 16): return 0;  // no block scan
    default: break;
  }
  if (address.id == 50) return tool_data(state, address);
  return address.id == 350 && address.nr != 20 ? probe_data(state, address)
                                               : axis_data(channel, address);
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
  const std::size_t i = index(*axis);
  return is_rotary(*axis) ? preset->frame.rotary_offsets_deg[i - 3] : preset->frame.origin[i];
}

NcResult<void> write_tool(Channel& channel, const Address& address, double value) {
  const MachineState& state = channel.state();
  const auto number = address.index.value_or(state.tool.number);
  const Tool* found = number == 0 ? nullptr : find_tool(state, number);
  if (found == nullptr) return no_tool(number);
  Tool tool = *found;
  switch (set_tool_value(tool, address.nr, value)) {
    case ToolWrite::Done: break;
    case ToolWrite::Unknown: return unknown(address);
    case ToolWrite::OutOfRange:
      return nc_error("ID50 NR{} of tool {}: the column takes a whole number, and not {}",
                      address.nr, number, value);
  }
  TRY(note_lathe_value(channel, tool, address.nr));
  return channel.machine().write_tool(tool);
}

NcResult<void> write_preset(Channel& channel, const Address& address, double value) {
  const auto axis = axis_of(address);
  if (!axis || address.nr < 0 || address.nr > machine::kLastPreset) return unknown(address);
  const machine::Preset* found = channel.state().presets.find(address.nr);
  machine::Preset preset = found != nullptr ? *found : machine::Preset{};
  preset.number = address.nr;
  const std::size_t i = index(*axis);
  if (is_rotary(*axis)) {
    preset.frame.rotary_offsets_deg[i - 3] = value;
  } else {
    preset.frame.origin[i] = value;
  }
  return channel.machine().write_preset(preset);
}

}  // namespace

NcResult<double> read_system_data(Channel& channel, NodeIndex node) {
  const auto address = TRY(read_address(channel, node));
  if (!has_system_data(address.id, address.nr, false)) return unknown(address);
  if (address.id == 500) return datum_data(channel, address);
  if (address.id == 502 || address.id == 503) return preset_data(channel.state(), address);
  if (address.id == 50) {
    const MachineState& state = channel.state();
    const auto number = address.index.value_or(state.tool.number);
    if (find_tool(state, number) == nullptr) return no_tool(number);
  }
  const Answer answer = find(channel, address);
  if (!answer || !std::isfinite(*answer)) return unknown(address);
  return *answer;
}

NcResult<void> write_system_data(Channel& channel, NodeIndex node, double value) {
  const auto address = TRY(read_address(channel, node));
  if (!has_system_data(address.id, address.nr, true)) return unknown(address);
  switch (address.id) {
    case 50: return write_tool(channel, address, value);
    case 500: {
      const auto axis = axis_of(address);
      if (!axis) return unknown(address);
      AxisWords words;
      words[*axis] = value;
      return channel.tables.write_datum(address.nr, words);
    }
    case 503: return write_preset(channel, address, value);
    default: return unknown(address);
  }
}

}  // namespace fitgauge::interpreter
