#include "nc/program/diagnose.hpp"
#include "nc/run/statements.hpp"

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

/// IDX 1 to 9: X Y Z A B C U V W. None for U, V, W, which no simulated machine has.
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

/// Whether the block of the active cycle has the parameter Q IDX (NR 103).
Answer gives(const Channel& channel, const Address& address) {
  const auto* machining = std::get_if<MachiningDefinition>(&channel.active_cycle.definition);
  if (machining == nullptr || !address.index) return std::nullopt;
  return machining->gives(*address.index);
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
  if (const machine::ToolColumn* column = machine::tool_column(address.nr))
    return column->whole != nullptr ? tool->*column->whole : tool->*column->number;
  const machine::ProbeRow* probe = state.probes.find(tool->probe);
  switch (address.nr) {
    case 7: return tool->locked;
    case 18: return !tool->clockwise;
    case 24: return probe == nullptr ? std::nullopt : Answer(probe->cal_of1);
    case 25: return probe == nullptr ? std::nullopt : Answer(probe->cal_of2);
    case 26: return probe == nullptr ? std::nullopt : Answer(probe->cal_ang);
    default: return std::nullopt;
  }
}

/// The offset of an axis in a preset.
decltype(auto) offset_of(auto& frame, Axis axis) {
  const std::size_t i = index(axis);
  return is_rotary(axis) ? frame.rotary_offsets_deg[i - 3] : frame.origin[i];
}

double rounded(Axis axis, double value) {
  return is_rotary(axis) ? probing::to_angle(value) + 0.0 : rounded_length(value);
}

double position_data(const MachineState& state, Axis axis, CoordinateSystem system) {
  return rounded(axis, state.position(system)[axis]);
}

constexpr std::int64_t key(int id, int nr) { return std::int64_t{id} * 1000 + nr; }

Answer find(const Channel& channel, const Address& address) {
  const MachineState& state = channel.state();
  if (address.id == 50) return tool_data(state, address);
  if (address.nr < 0 || address.nr > 999) return std::nullopt;
  const Frames& frames = state.frames;
  const Modes& modes = state.modes;
  const auto probe = address.id == 350 ? state.probe_system() : std::nullopt;
  const auto& touch = channel.last_touch;
  const bool is_second = address.index == 2;
  const auto axis = axis_of(address);
  const std::size_t i = axis ? index(*axis) : 0;
  const auto& range = state.ranges[i];
  const auto has = [&](int last, SystemNeed need) {
    const bool is_axis = last > 0 && last <= static_cast<int>(kAxes);
    // Up to 6 they are axes of the machine, which may lack a rotary one.
    const bool has_axis = axis && i < static_cast<std::size_t>(last) && (last < 6 || range);
    return (!is_axis || has_axis) && (need != SystemNeed::Probe || probe) &&
           (need != SystemNeed::Touch || touch);
  };
  switch (key(address.id, address.nr)) {
#define FITGAUGE_DATA(id, nr, last, need, value) \
  case key(id, nr):                              \
    return has(last, SystemNeed::need) ? Answer(value) : std::nullopt;
#include "nc/program/system_data.inc"
    default: return std::nullopt;
  }
}

/// ID500: the datum table, NR is the row.
NcResult<double> datum_data(const Channel& channel, const Address& address) {
  const auto axis = axis_of(address);
  if (!axis) return unknown(address);
  const auto value = TRY(channel.tables.datum(address.nr, *axis));
  if (!value) return unknown(address);
  return *value;
}

/// ID502 and ID503: the preset table, NR is the row. The kinematics add nothing to a preset here.
NcResult<double> preset_data(const MachineState& state, const Address& address) {
  const machine::Preset* preset = state.presets.find(address.nr);
  const auto axis = axis_of(address);
  if (preset == nullptr || !axis) return unknown(address);
  return offset_of(preset->frame, *axis);
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
  offset_of(preset.frame, *axis) = value;
  return channel.machine().write_preset(preset);
}

}  // namespace

NcResult<double> read_system_data(Channel& channel, NodeIndex node) {
  const auto address = TRY(read_address(channel, node));
  if (address.id == 500) return datum_data(channel, address);
  if (address.id == 502 || address.id == 503) return preset_data(channel.state(), address);
  if (address.id == 50 && has_system_data(50, address.nr, false)) {
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

ToolWrite set_tool_value(Tool& tool, std::int64_t nr, double value) {
  const machine::ToolColumn* column = machine::tool_column(nr);
  if (column != nullptr && column->whole != nullptr) {
    if (!(value >= 0 && value <= column->most) || value != std::floor(value))
      return ToolWrite::OutOfRange;
    tool.*column->whole = static_cast<int>(value);
  } else if (column != nullptr) {
    tool.*column->number = value;
  } else if (nr == 7) {
    tool.locked = value != 0;
  } else if (nr == 18) {
    tool.clockwise = value == 0;
  } else {
    return ToolWrite::Unknown;
  }
  return ToolWrite::Done;
}

NcResult<void> note_lathe_value(Channel& channel, const Tool& tool, std::int64_t nr) {
  const bool is_length = nr == 1 || nr == 2 || nr == 4 || nr == 5;
  if (!tool.lathe || !is_length) return {};
  return channel.note(
      "tool {} is a lathe tool: {} has no effect, since ZL, XL, DZL and DXL are its lengths",
      tool.number, machine::tool_column(nr)->name);
}

void update_preassigned(Channel& channel) {
  const MachineState& state = channel.state();
  QParameters& q = channel.parameters;
  q.set_q(108, state.tool_radius() / channel.length_unit());
  q.set_q(109, state.tool.axis ? static_cast<double>(index(*state.tool.axis)) : -1);
  q.set_q(110, static_cast<int>(state.modes.spindle));
  q.set_q(111, state.modes.coolant ? 1 : 0);
  q.set_q(113, channel.calls.main_program().is_inch() ? 1 : 0);
  q.set_q(114, state.tool_length() / channel.length_unit());
}

void set_plane_angles(Channel& channel, const Vec3& rotary) {
  for (std::uint16_t i = 0; i < 3; ++i)
    channel.parameters.set_q(static_cast<std::uint16_t>(120 + i), rotary[i]);
}

}  // namespace fitgauge::interpreter
