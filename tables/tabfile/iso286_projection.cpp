#include "tables/tabfile/iso286_projection.hpp"

#include "tables/iso286/tolerance_class.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::tabfile {
namespace {

using iso286::ClassId;
using iso286::Feature;
using iso286::NominalSizeRange;
using iso286::ToleranceTables;

/// The columns of the tables delivered with program 8255, in their order.
constexpr std::array<std::string_view, 24> kHoleClasses8255 = {
    "D10", "E9",  "F7",  "F8", "G7", "G9", "H6", "H7", "H8", "H9", "H11", "H12",
    "H13", "JS7", "JS9", "K6", "K7", "M6", "M7", "N7", "N9", "P7", "P9",  "R7"};
constexpr std::array<std::string_view, 23> kShaftClasses8255 = {
    "d9",   "e8",   "f7", "g6", "h5", "h6", "h7", "h8", "h9", "h11", "js5", "js6",
    "js13", "js14", "k5", "k6", "m5", "m6", "n6", "p6", "r6", "s6",  "s7"};

std::span<const std::string_view> classes_of_8255(Feature feature) {
  if (feature == Feature::Hole) return kHoleClasses8255;
  return kShaftClasses8255;
}

std::vector<ClassId> columns_in_order(const ToleranceTables& tables, Feature feature) {
  std::vector<ClassId> columns;
  for (const std::string_view name : classes_of_8255(feature)) {
    columns.push_back(tables.find_class(name).value());
  }
  const auto first = columns;
  for (const ClassId id : tables.classes(feature)) {
    if (std::ranges::find(first, id) == first.end()) columns.push_back(id);
  }
  return columns;
}

int decimals_of(std::string_view number) {
  const std::size_t point = number.find('.');
  return point == std::string_view::npos ? 0 : static_cast<int>(number.size() - point - 1);
}

/// A column and its cells, one a row.
struct FilledColumn {
  TabColumn column;
  std::vector<std::string> cells;

  void append(std::string cell) {
    column.width = std::max(column.width, count_characters(cell));
    column.decimals = std::max(column.decimals.value_or(0), decimals_of(cell));
    cells.push_back(std::move(cell));
  }
};

FilledColumn filled(std::string name) {
  const std::size_t width = name.size();
  return {{.name = std::move(name), .type = "N", .width = width}, {}};
}

FilledColumn row_numbers(std::size_t rows) {
  constexpr std::size_t kWidth = 7;  // the first column takes 8 characters
  FilledColumn column{{.name = "NR", .width = kWidth}, {}};
  for (std::size_t row = 0; row < rows; ++row) column.append(std::to_string(row));
  column.column.decimals.reset();  // as on the control, the description leaves this column out
  return column;
}

FilledColumn ends_of_ranges(std::span<const NominalSizeRange> ranges) {
  FilledColumn column = filled("BEREICH");
  for (const NominalSizeRange& range : ranges) {
    for (int copy = 0; copy < 2; ++copy) column.append(format_mm(range.up_to));
  }
  return column;
}

FilledColumn deviations_of(const ToleranceTables& tables, ClassId id) {
  FilledColumn column = filled(std::string(tables.class_name(id)));
  for (const NominalSizeRange& range : tables.ranges()) {
    const auto deviations = deviations_in_range(tables, id, range);
    column.append(deviations ? format_um(deviations->upper) : "");
    column.append(deviations ? format_um(deviations->lower) : "");
  }
  return column;
}

}  // namespace

TabTable project(const ToleranceTables& tables, Feature feature) {
  const std::size_t rows = 2 * tables.ranges().size();
  std::vector<FilledColumn> filled_columns = {row_numbers(rows), ends_of_ranges(tables.ranges())};
  for (const ClassId id : columns_in_order(tables, feature)) {
    filled_columns.push_back(deviations_of(tables, id));
  }
  std::vector<TabColumn> columns;
  columns.reserve(filled_columns.size());
  for (const FilledColumn& column : filled_columns) columns.push_back(column.column);
  const std::string name = feature == Feature::Hole ? "82553_HOLE .TAB" : "82553_SHAFT .TAB";
  TabTable table({.name = name, .unit = "MM"}, std::move(columns));
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string_view> cells;
    cells.reserve(filled_columns.size());
    for (const FilledColumn& column : filled_columns) cells.push_back(column.cells[row]);
    table.append_row(cells).value();
  }
  return table;
}

}  // namespace fitgauge::tabfile
