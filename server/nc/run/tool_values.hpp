#pragma once

#include <cstdint>
#include <optional>

#include "nc/machine/tool_table.hpp"

namespace fitgauge::interpreter {

/// The columns of tool.t by the NR of FN 17 and FN 18 ID50; nothing for a number without one.
std::optional<double> tool_value(const machine::Tool& tool, std::int64_t nr);
enum class ToolWrite : std::uint8_t {
  Done,
  Unknown,    ///< no column has that number
  OutOfRange  ///< the column takes whole numbers, and not this one
};
ToolWrite set_tool_value(machine::Tool& tool, std::int64_t nr, double value);

}  // namespace fitgauge::interpreter
