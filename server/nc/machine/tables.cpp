#include "nc/machine/tables.hpp"

#include "base/text.hpp"

namespace fitgauge::machine {

int LatheTool::tip_x() const {
  return orientation >= 1 && orientation <= 3 ? -1 : orientation >= 5 && orientation <= 7 ? 1 : 0;
}

int LatheTool::tip_z() const {
  if (orientation >= 3 && orientation <= 5) return 1;
  return orientation == 1 || orientation == 7 || orientation == 8 ? -1 : 0;
}

const Tool* ToolTable::find(std::string_view name) const {
  const auto row = std::ranges::find_if(
      rows(), [name](const auto& entry) { return ascii_iequals(entry.second.name, name); });
  return row == rows().end() ? nullptr : &row->second;
}

Vec3 turned_offset(const std::array<double, 2>& offset, Axis tool_axis, double spindle_deg) {
  Vec3 straight;
  straight[(index(tool_axis) + 1) % 3] = offset[0];
  straight[(index(tool_axis) + 2) % 3] = offset[1];
  return Matrix3::rotation(unit_vector(tool_axis), spindle_deg) * straight;
}

Vec3 ProbeSystem::centre_offset(Axis tool_axis, double spindle_deg) const {
  return turned_offset({data.cal_of1, data.cal_of2}, tool_axis, spindle_deg - data.cal_ang);
}

}  // namespace fitgauge::machine
