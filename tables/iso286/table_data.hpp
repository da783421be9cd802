#pragma once

#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {

/// The three tables of the standard, as they are stored.
enum class TableId : std::uint8_t {
  ItGrades,                    ///< ISO 286-1, Table 1: 21 steps
  HoleFundamentalDeviations,   ///< Tables 2 and 3: 41 steps, with the deltas
  ShaftFundamentalDeviations,  ///< Tables 4 and 5: 41 steps
};
inline constexpr std::array kTableIds = {TableId::ItGrades, TableId::HoleFundamentalDeviations,
                                         TableId::ShaftFundamentalDeviations};

inline constexpr std::array<std::string_view, 3> kTableNames = {
    "it_grades", "hole_fundamental_deviations", "shaft_fundamental_deviations"};

/// `it_grades`, `hole_fundamental_deviations`, `shaft_fundamental_deviations`: the files' names.
constexpr std::string_view name(TableId table) {
  return kTableNames[static_cast<std::size_t>(table)];
}
constexpr std::optional<TableId> table_from_name(std::string_view name) {
  return enum_of<TableId>(name, kTableNames);
}

/// One cell; without a value the standard defines nothing there. Columns are named as in the CSV:
/// `IT7`, `EI_A`, `ES_K_le_IT8_base`, `delta_IT3`. JS and js have no column: they are ±IT/2.
struct TableCell {
  TableId table;
  NominalSizeRange range;
  std::string column;
  std::optional<Length> value;

  friend bool operator==(const TableCell&, const TableCell&) = default;
};

/// A row of a custom tolerance class.
struct CustomRow {
  NominalSizeRange range;
  LimitDeviations deviations;

  friend bool operator==(const CustomRow&, const CustomRow&) = default;
};

/// A custom tolerance class. It replaces a class of the standard with its name, for all sizes.
struct CustomColumn {
  Feature feature = Feature::Hole;
  std::string name;
  std::vector<CustomRow> rows;  ///< ascending and contiguous

  friend bool operator==(const CustomColumn&, const CustomColumn&) = default;
};

/// Plain content of one table revision, as stored and digested; not yet checked.
struct TableData {
  std::vector<TableCell> cells;
  std::vector<CustomColumn> custom_columns;
};

/// The tables of ISO 286-1:2010 from tables/data, without custom columns.
const TableData& compiled_in_tables();

/// Every finding in tables that are not consistent in themselves: contiguous ranges, no missing or
/// additional column, grades strictly increase, no tolerance decreases with size, the deltas are
/// differences of tolerances, holes mirror shafts, upper - lower = IT, JS is symmetric, and the
/// custom columns as check_custom_column.
/// @returns TablesInconsistent each, naming table, range and column; empty when all hold.
std::vector<Error> table_rules(const TableData& data);

/// Compares the standard's tables with the compiled-in ones cell by cell, because a changed cell
/// can satisfy every rule. Does not compare custom columns.
/// @returns TablesInconsistent for each difference, naming table, range, column, found and
///   expected.
std::vector<Error> compare_with_compiled_in(const TableData& data);

/// Checks a custom tolerance class: a valid name whose case matches the feature and that is not NR
/// or BEREICH, at least one row, contiguous ascending ranges within 0 to 3150 mm, and upper >=
/// lower.
/// @errors TableRowsInvalid; `details` has one entry for each finding, `where` its JSON pointer.
Result<void> check_custom_column(const CustomColumn& column);

}  // namespace fitgauge::iso286
