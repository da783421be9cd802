#include "run/tool_values.hpp"

#include <algorithm>

namespace fitgauge::interpreter {
namespace {

using machine::Tool;

/// A column that is a plain number.
struct Column {
  std::int64_t nr;
  double Tool::*value;
};

constexpr Column kColumns[] = {
    {1, &Tool::l},
    {2, &Tool::r},
    {3, &Tool::r2},
    {4, &Tool::dl},
    {5, &Tool::dr},
    {6, &Tool::dr2},
    {9, &Tool::time1},
    {10, &Tool::time2},
    {11, &Tool::current_time},
    {13, &Tool::cutting_length},
    {14, &Tool::plunge_angle},
    {16, &Tool::l_tolerance},
    {17, &Tool::r_tolerance},
    {19, &Tool::r_offset},
    {20, &Tool::l_offset},
    {21, &Tool::l_breakage},
    {22, &Tool::r_breakage},
    {28, &Tool::max_rpm},
    {32, &Tool::point_angle},
    {33, &Tool::pitch},
};

const Column* column(std::int64_t nr) {
  const auto* it = std::find_if(std::begin(kColumns), std::end(kColumns),
                                [&](const Column& entry) { return entry.nr == nr; });
  return it == std::end(kColumns) ? nullptr : it;
}

}  // namespace

std::optional<double> tool_value(const Tool& tool, std::int64_t nr) {
  if (const Column* plain = column(nr)) return tool.*plain->value;
  switch (nr) {
    case 7: return tool.locked ? 1 : 0;
    case 8: return tool.replacement;
    case 15: return tool.teeth;
    case 18: return tool.clockwise ? 0 : 1;
    case 36: return tool.type;
    default: return std::nullopt;
  }
}

bool set_tool_value(Tool& tool, std::int64_t nr, double value) {
  if (const Column* plain = column(nr)) {
    tool.*plain->value = value;
    return true;
  }
  if (nr != 7) return false;
  tool.locked = value != 0;
  return true;
}

}  // namespace fitgauge::interpreter
