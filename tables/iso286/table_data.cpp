#include "tables/iso286/table_data.hpp"

namespace fitgauge::iso286 {
namespace {

constexpr std::string_view kSymmetric = "+-IT/2";

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// The files are our own: unreadable data is a bug, so value() may throw.
void append_cells(TableData& data, TableId table, std::string_view csv) {
  constexpr std::size_t kFirstColumn = 2;  // after over_mm, to_mm
  std::vector<std::string_view> header;
  for (const std::string_view line : split(csv, '\n')) {
    if (line.empty()) continue;
    const auto fields = split(line, ',');
    if (header.empty()) {
      header = fields;
      continue;
    }
    if (fields.size() != header.size()) {
      throw std::logic_error(std::string(name(table)) + ".csv: a row has too few or many fields");
    }
    const NominalSizeRange range{parse_length_mm(fields[0]).value(),
                                 parse_length_mm(fields[1]).value()};
    for (std::size_t i = kFirstColumn; i < fields.size(); ++i) {
      if (fields[i] == kSymmetric) continue;
      std::optional<Length> value;
      if (!fields[i].empty()) value = parse_length_um(fields[i]).value();
      data.cells.push_back({table, range, std::string(header[i]), value});
    }
  }
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

const TableData& compiled_in_tables() {
  static const TableData kData = [] {
    TableData data;
    append_cells(data, TableId::ItGrades, kItGradesCsv);
    append_cells(data, TableId::HoleFundamentalDeviations, kHoleFundamentalDeviationsCsv);
    append_cells(data, TableId::ShaftFundamentalDeviations, kShaftFundamentalDeviationsCsv);
    return data;
  }();
  return kData;
}

}  // namespace fitgauge::iso286
