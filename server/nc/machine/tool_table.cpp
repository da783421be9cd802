#include "nc/machine/tool_table.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace fitgauge::machine {

const Tool* ToolTable::find(int number) const {
  const auto row = rows_.find(number);
  return row == rows_.end() ? nullptr : &row->second;
}

const Tool* ToolTable::find(std::string_view name) const {
  const auto row = std::find_if(rows_.begin(), rows_.end(), [name](const auto& entry) {
    return ascii_iequals(entry.second.name, name);
  });
  return row == rows_.end() ? nullptr : &row->second;
}

void ToolTable::write(const Tool& tool) { rows_.insert_or_assign(tool.number, tool); }

}  // namespace fitgauge::machine
