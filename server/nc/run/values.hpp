#pragma once

#include "nc/run/channel.hpp"

namespace fitgauge::interpreter {

/// The values of the operands of a block, in the program that runs. Reading an undefined parameter
/// is an error that names it (decision 3); the executor adds the block.

NcResult<double> number(Channel& channel, const Expr& expr);
/// Returns a coordinate of a positioning block. An undefined parameter leaves its axis out
/// (decision 18).
NcResult<std::optional<double>> coordinate(Channel& channel, const Expr& expr);
/// A number that must be whole and between two bounds, both included. @errors 1011.
NcResult<int> whole_in(Channel& channel, const Expr& expr, int least, int most);
/// A whole number in the range of int. @errors 1011.
NcResult<int> whole(Channel& channel, const Expr& expr);

NcResult<std::string> text(Channel& channel, const Expr& expr);

/// A node of Equal, NotEqual, Greater, Less, IsDefined, IsUndefined.
NcResult<bool> condition(Channel& channel, NodeIndex index);

/// The numeric value of an inner node.
NcResult<double> evaluate(Channel& channel, NodeIndex index);

// string_functions.cpp
/// Concat, ToChar, SubString, SystemString.
NcResult<std::string> string_value(Channel& channel, NodeIndex index);
/// ToNumber, InString, StringLength, StringCompare.
NcResult<double> string_number(Channel& channel, NodeIndex index);

/// A number as TOCHAR writes it: with that many decimals, or without a number of them (-1) up to 6
/// without trailing zeros (decision 22).
std::string to_char(double value, int decimals);

/// SYSSTR( ID10321 NRn ): date and time in the formats 0 to 16 of the control, UTC.
std::optional<std::string> format_system_time(Timestamp time, std::int64_t format);

/// The three letters of a month (1 to 12) as STR_MONTH of FN 16 prints them.
std::string_view month_name(int month);

// system_data.cpp
/// FN 18: SYSREAD. Always metric, in INCH programs too.
/// @errors an ID or NR this control does not have (decision 3), no such tool, preset or axis.
NcResult<double> read_system_data(Channel& channel, NodeIndex address);

/// FN 17: SYSWRITE of ID50 (tool table), ID500 (datum table) and ID503 (preset table).
NcResult<void> write_system_data(Channel& channel, NodeIndex address, double value);

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
