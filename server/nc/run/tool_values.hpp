#pragma once

#include "nc/machine/geometry.hpp"
#include "nc/machine/tables.hpp"
#include "nc/program/code.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

/// The columns of tool.t by the NR of FN 17 and FN 18 ID50; nothing for a number without one.
std::optional<double> tool_value(const machine::Tool& tool, std::int64_t nr);
enum class ToolWrite : std::uint8_t {
  Done,
  Unknown,    ///< no column has that number
  OutOfRange  ///< the column has whole numbers, and this is not one
};
ToolWrite set_tool_value(machine::Tool& tool, std::int64_t nr, double value);

/// Returns the NR of a column by its name in tool.t, 0 if it is not a number or unknown.
std::int64_t tool_column(std::string_view name);
/// Whether the column is a length, in the unit of the table.
bool is_tool_length(std::int64_t nr);

class Channel;

/// Notes a written L, R, DL or DR of a lathe tool, which counts its lengths by toolturn.trn.
NcResult<void> note_lathe_value(Channel& channel, const machine::Tool& tool, std::int64_t nr);

/// Returns whether a cell is Q108 to Q111, Q113 or Q114, to which the control gives a value. They
/// are undefined until a program reads them or calls a tool.
constexpr bool is_preassigned(std::uint32_t cell) {
  return cell >= kFirstQ + 108 && cell <= kFirstQ + 114 && cell != kFirstQ + 112;
}

/// Sets them to the values of the active tool, spindle, coolant and unit. Call it after a change of
/// these.
void update_preassigned(Channel& channel);

/// Q120 to Q122: the rotary positions that PLANE or cycle 19 has computed, in degrees.
void set_plane_angles(Channel& channel, const machine::Vec3& rotary);

}  // namespace fitgauge::interpreter
