#include "machine/probe_table.hpp"

namespace fitgauge::machine {

const ProbeRow* ProbeTable::find(int number) const {
  const auto row = rows_.find(number);
  return row == rows_.end() ? nullptr : &row->second;
}

void ProbeTable::write(const ProbeRow& row) { rows_.insert_or_assign(row.number, row); }

}  // namespace fitgauge::machine
