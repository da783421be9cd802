#include "tables/iso286/table_data.hpp"

#include "base/text.hpp"
#include "tables/compiled_in.hpp"

namespace fitgauge::iso286 {
namespace {

constexpr std::string_view kSymmetric = "+-IT/2";

/// The files are our own: unreadable data is a bug, so value() may throw.
void append_cells(TableData& data, TableId table) {
  constexpr std::size_t kFirstColumn = 2;  // after over_mm, to_mm
  std::string_view csv = compiled_in_csv(name(table));
  const auto header = cells_of(take_field(csv, '\n'));
  while (!csv.empty()) {
    const auto fields = cells_of(take_field(csv, '\n'));
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

const TableData& compiled_in_tables() {
  static const TableData kData = [] {
    TableData data;
    for (const TableId table : kTableIds) append_cells(data, table);
    return data;
  }();
  return kData;
}

}  // namespace fitgauge::iso286
