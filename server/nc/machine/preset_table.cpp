#include "nc/machine/preset_table.hpp"

namespace fitgauge::machine {

PresetTable::PresetTable() { rows_.emplace(0, Preset{}); }

const Preset* PresetTable::find(int number) const {
  const auto row = rows_.find(number);
  return row == rows_.end() ? nullptr : &row->second;
}

void PresetTable::write(const Preset& preset) { rows_.insert_or_assign(preset.number, preset); }

}  // namespace fitgauge::machine
