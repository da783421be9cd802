#include "tables/iso286/table_comparison.hpp"

#include <fmt/format.h>

#include <map>
#include <tuple>

#include "tables/iso286/table_rules.hpp"

namespace fitgauge::iso286 {
namespace {

using CellKey = std::tuple<TableId, NominalSizeRange, std::string_view>;
using CellsByKey = std::map<CellKey, const TableCell*>;

CellKey key_of(const TableCell& cell) { return {cell.table, cell.range, cell.column}; }

const CellsByKey& compiled_in_by_key() {
  static const CellsByKey kCells = [] {
    CellsByKey cells;
    for (const TableCell& cell : compiled_in_tables().cells) cells.emplace(key_of(cell), &cell);
    return cells;
  }();
  return kCells;
}

std::string text_of(std::optional<Length> value) {
  return value ? format_um(*value) + " µm" : "nothing";
}

}  // namespace

Error finding(TableId table, const NominalSizeRange& range, std::string_view column,
              std::string_view what) {
  return {ErrorCode::TablesInconsistent,
          fmt::format("{}, {}, {}: {}", name(table), format_range(range), column, what),
          fmt::format("{}/{}-{}/{}", name(table), format_mm(range.over), format_mm(range.up_to),
                      column)};
}

std::vector<Error> compare_structure(const TableData& data) {
  std::vector<Error> findings;
  CellsByKey found;
  for (const TableCell& cell : data.cells) {
    const bool first = found.emplace(key_of(cell), &cell).second;
    const bool expected = compiled_in_by_key().contains(key_of(cell));
    if (first && expected) continue;
    findings.push_back(
        finding(cell.table, cell.range, cell.column,
                first ? "the standard has no such cell" : "the cell is there twice"));
  }
  for (const auto& [key, cell] : compiled_in_by_key()) {
    if (found.contains(key)) continue;
    findings.push_back(finding(cell->table, cell->range, cell->column, "the cell is missing"));
  }
  return findings;
}

std::vector<Error> compare_with_compiled_in(const TableData& data) {
  std::vector<Error> findings = compare_structure(data);
  for (const TableCell& cell : data.cells) {
    const auto expected = compiled_in_by_key().find(key_of(cell));
    if (expected == compiled_in_by_key().end() || expected->second->value == cell.value) continue;
    findings.push_back(finding(cell.table, cell.range, cell.column,
                               fmt::format("found {}, the standard has {}", text_of(cell.value),
                                           text_of(expected->second->value))));
  }
  return findings;
}

}  // namespace fitgauge::iso286
