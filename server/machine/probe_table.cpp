#include "machine/probe_table.hpp"

namespace fitgauge::machine {

const ProbeRow* ProbeTable::find(int number) const {
  const auto row = rows_.find(number);
  return row == rows_.end() ? nullptr : &row->second;
}

void ProbeTable::write(const ProbeRow& row) { rows_.insert_or_assign(row.number, row); }

Vec3 ProbeSystem::centre_offset(Axis tool_axis) const {
  Vec3 offset;
  offset[(index(tool_axis) + 1) % 3] = data.cal_of1;
  offset[(index(tool_axis) + 2) % 3] = data.cal_of2;
  return offset;
}

}  // namespace fitgauge::machine
