#include "iso286/indexed_table.hpp"

#include <algorithm>
#include <cassert>
#include <set>

namespace fitgauge::iso286 {

IndexedTable::IndexedTable(std::span<const TableCell> cells, TableId table) {
  std::set<NominalSizeRange> ranges;
  for (const TableCell& cell : cells) {
    if (cell.table == table) ranges.insert(cell.range);
  }
  ranges_.assign(ranges.begin(), ranges.end());
  for (const TableCell& cell : cells) {
    if (cell.table != table) continue;
    auto& column = columns_[cell.column];
    column.resize(ranges_.size());
    column[index_of(cell.range)] = cell.value;
  }
}

std::span<const std::optional<Length>> IndexedTable::column(std::string_view name) const {
  const auto found = columns_.find(name);
  if (found == columns_.end()) return {};
  return found->second;
}

std::size_t IndexedTable::index_of(const NominalSizeRange& range) const {
  const auto found =
      std::find_if(ranges_.begin(), ranges_.end(),
                   [&](const NominalSizeRange& candidate) { return candidate.contains(range); });
  assert(found != ranges_.end());
  return static_cast<std::size_t>(found - ranges_.begin());
}

}  // namespace fitgauge::iso286
