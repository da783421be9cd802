#include "tables/iso286/indexed_table.hpp"

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

IndexedTable::Column IndexedTable::column(std::string_view name) const {
  const auto found = columns_.find(name);
  if (found == columns_.end()) return {};
  return found->second;
}

std::size_t IndexedTable::index_of(const NominalSizeRange& range) const {
  const auto found = std::lower_bound(
      ranges_.begin(), ranges_.end(), range.up_to,
      [](const NominalSizeRange& candidate, Length up_to) { return candidate.up_to < up_to; });
  assert(found != ranges_.end() && found->contains(range));
  return static_cast<std::size_t>(found - ranges_.begin());
}

}  // namespace fitgauge::iso286
