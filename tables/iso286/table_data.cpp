#include "tables/iso286/table_data.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fitgauge::iso286 {
namespace {

std::string text_of(const NominalSizeRange& range) {
  return fmt::format("{};{}", range.over.count(), range.up_to.count());
}

std::string text_of(const TableCell& cell) {
  return fmt::format("{};{};{};{}\n", name(cell.table), text_of(cell.range), cell.column,
                     cell.value ? std::to_string(cell.value->count()) : "");
}

std::string text_of(const CustomColumn& column, const CustomRow& row) {
  return fmt::format("custom {};{};{};{};{}\n", word(column.feature), column.name,
                     text_of(row.range), row.deviations.upper.count(),
                     row.deviations.lower.count());
}

}  // namespace

std::string_view name(TableId table) {
  switch (table) {
    case TableId::ItGrades: return "it_grades";
    case TableId::HoleFundamentalDeviations: return "hole_fundamental_deviations";
    case TableId::ShaftFundamentalDeviations: break;
  }
  return "shaft_fundamental_deviations";
}

std::optional<TableId> table_from_name(std::string_view text) {
  for (const TableId table : kTableIds) {
    if (name(table) == text) return table;
  }
  return std::nullopt;
}

std::string canonical_text(const TableData& data) {
  std::vector<std::string> lines;
  lines.reserve(data.cells.size());
  for (const TableCell& cell : data.cells) lines.push_back(text_of(cell));
  for (const CustomColumn& column : data.custom_columns) {
    for (const CustomRow& row : column.rows) lines.push_back(text_of(column, row));
  }
  std::sort(lines.begin(), lines.end());
  return fmt::format("lengths in nm: table;over;up_to;column;value\n{}", fmt::join(lines, ""));
}

}  // namespace fitgauge::iso286
